// SPDX-License-Identifier: MIT
// Moved to <dch/lists/neighbor_list.hpp>; this file goes with the next version.
#pragma once

#include <dch/lists/list_params.hpp>
#include <dch/lists/neighbor_list.hpp>
