// SPDX-License-Identifier: MIT
// Moved to <dch/geometry/box.hpp>; this file goes with the next version.
#pragma once

#include <dch/geometry/box.hpp>
