// SPDX-License-Identifier: MIT
// Moved to <dch/base/span.hpp>; this file goes with the next version.
#pragma once

#include <dch/base/span.hpp>
