// SPDX-License-Identifier: MIT
// Moved to <dch/lists/exclusions.hpp>; this file goes with the next version.
#pragma once

#include <dch/lists/exclusions.hpp>
