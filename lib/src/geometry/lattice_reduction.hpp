// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <dch/base/vec3.hpp>

namespace dch::detail {

/// Obtuse superbase of the lattice spanned by one to three vectors: one vector more than these, which sum to
/// zero.
std::vector<Vec3> obtuse_superbase(const std::vector<Vec3>& periods);

/// One of each pair +-v among the sums of proper, non-empty subsets of a superbase.
std::vector<Vec3> subset_sums(const std::vector<Vec3>& superbase);

}  // namespace dch::detail
