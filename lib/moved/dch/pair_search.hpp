// SPDX-License-Identifier: MIT
// Moved to <dch/engines/pair_search.hpp>; this file goes with the next version.
#pragma once

#include <dch/engines/pair_search.hpp>
