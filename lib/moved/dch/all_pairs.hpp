// SPDX-License-Identifier: MIT
// Moved to <dch/lists/all_pairs.hpp>; this file goes with the next version.
#pragma once

#include <dch/lists/all_pairs.hpp>
