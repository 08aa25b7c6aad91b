// SPDX-License-Identifier: MIT
// Moved to <dch/forces/lennard_jones.hpp>; this file goes with the next version.
#pragma once

#include <dch/forces/lennard_jones.hpp>
