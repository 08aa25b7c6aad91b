// SPDX-License-Identifier: MIT
// Moved to <dch/hierarchy/hierarchy.hpp>; this file goes with the next version.
#pragma once

#include <dch/engines/pair_search.hpp>
#include <dch/hierarchy/hierarchy.hpp>
