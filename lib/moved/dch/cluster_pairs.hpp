// SPDX-License-Identifier: MIT
// Moved to <dch/clusters/cluster_pairs.hpp>; this file goes with the next version.
#pragma once

#include <dch/clusters/cluster_pairs.hpp>
