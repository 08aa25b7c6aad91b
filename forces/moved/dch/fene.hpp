// SPDX-License-Identifier: MIT
// Moved to <dch/forces/fene.hpp>; this file goes with the next version.
#pragma once

#include <dch/forces/fene.hpp>
