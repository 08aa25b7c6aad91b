// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <dch/clusters/cluster_pairs.hpp>

#pragma GCC visibility push(default)
namespace dch::detail {

template <class Real>
struct alignas(4 * sizeof(Real)) FourNumbers {
  Real slot[4];
};
template <class Real>
struct alignas(64) Lanes {
  Real numbers[48];
};

/// Numbers that are tallied of a cluster's four slots, as LennardJonesSums has them.
struct alignas(64) ClusterTallies {
  double number[8][4]{};
};

/// Scratch memory of forces on cluster pairs for one precision.
template <class Real>
struct ClusterScratch {
  // All 0 between calls.
  std::vector<std::vector<ClusterOfFour<Real>>> force;  ///< found by each thread for its task
  std::vector<std::vector<Lanes<Real>>> lanes;          ///< the same before it is summed up, if wanted
  std::vector<ClusterOfFour<Real>> earlier;             ///< found by tasks before that of the cluster
  std::vector<std::vector<ClusterTallies>> tallies;     ///< as force, where these are wanted
  std::vector<ClusterTallies> earlier_tallies;          ///< as earlier
  std::vector<FourNumbers<Real>> charge, dispersion, half_sigma, root_epsilon;
};

}  // namespace dch::detail
#pragma GCC visibility pop
