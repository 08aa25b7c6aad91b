// SPDX-License-Identifier: MIT
// Moved to <dch/base/index_count.hpp>; this file goes with the next version.
#pragma once

#include <dch/base/index_count.hpp>
