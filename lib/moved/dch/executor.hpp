// SPDX-License-Identifier: MIT
// Moved to <dch/base/executor.hpp>; this file goes with the next version.
#pragma once

#include <dch/base/executor.hpp>
