// SPDX-License-Identifier: MIT
// Moved to <dch/engines/verlet_list.hpp>; this file goes with the next version.
#pragma once

#include <dch/engines/verlet_list.hpp>
