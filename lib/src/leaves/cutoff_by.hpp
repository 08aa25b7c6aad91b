// SPDX-License-Identifier: MIT
#pragma once

namespace dch::detail {

/// What the cutoff of a pair depends on.
enum class CutoffBy { one_cutoff, radii, types };

}  // namespace dch::detail
