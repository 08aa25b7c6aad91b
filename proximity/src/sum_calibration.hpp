// SPDX-License-Identifier: MIT
#pragma once

#include "far_descent.hpp"

namespace dch::detail {

/// The share of a target's potential that errors of single pairs may have for their sum to be about `most` of
/// it: found by descents to a few targets, without sums.
double share_for(SumScene scene);

}  // namespace dch::detail
