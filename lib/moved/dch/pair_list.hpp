// SPDX-License-Identifier: MIT
// Moved to <dch/lists/pair_list.hpp>; this file goes with the next version.
#pragma once

#include <dch/lists/pair_list.hpp>
