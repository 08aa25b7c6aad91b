// SPDX-License-Identifier: MIT
// Moved to <dch/lists/stale_test.hpp>; this file goes with the next version.
#pragma once

#include <dch/lists/stale_test.hpp>
