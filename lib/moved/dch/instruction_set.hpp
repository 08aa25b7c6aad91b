// SPDX-License-Identifier: MIT
// Moved to <dch/base/instruction_set.hpp>; this file goes with the next version.
#pragma once

#include <dch/base/instruction_set.hpp>
