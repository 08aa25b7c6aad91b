// SPDX-License-Identifier: MIT
// Moved to <dch/base/vec3.hpp>; this file goes with the next version.
#pragma once

#include <dch/base/vec3.hpp>
