// SPDX-License-Identifier: MIT
// Moved to <dch/base/error.hpp>; this file goes with the next version.
#pragma once

#include <dch/base/error.hpp>
