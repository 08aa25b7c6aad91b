// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/base/span.hpp>
#include <dch/clusters/cluster_pairs.hpp>

namespace dch::detail {

/// What is the same for all pairs of a generalized Born sum.
struct BornConstants {
  float cutoff2 = 0;
  float far2 = 0;           ///< no pair overlaps from this squared distance on: series serve both particles
  float counts_inside = 0;  ///< 1 if a particle inside another one gets what it is inside of, else 0
  float neck_scale = 0, neck_reach = 0;  ///< necks act up to radius_i + radius_j + neck_reach
  float neck_far2 = 0;                   ///< and none from this squared distance on
  float over_solute = 0, over_solvent = 0, kappa = 0, shift = 0, factor = 0;  ///< of energies
};

/// One pass over cluster pairs, in single precision: arrays are by slot, aligned, and null where the pass
/// does not read them.
struct BornTask {
  const ClusterPairs::Row* rows;  ///< and one more
  std::int64_t row_count;
  const ClusterPairs::Entry* entries;
  const ClusterUnits* at;
  const ClusterShift<float>* shift;
  double unit;                             ///< what displacements are in, hence forces [length]
  const float *radius, *scaled;            ///< of integrals and the chain
  const float *charge, *born, *half_over;  ///< of energies: Born radii and a half over them
  const float* slope;                      ///< of the chain: dE/dI
  const std::int32_t* kind;                ///< of necks
  std::int32_t kinds;
  const float *neck_at, *neck_height;            ///< by kinds of i and j; the particle that has the neck is i
  const float *neck_at_of_j, *neck_height_of_j;  ///< transposed: it is j
  BornConstants constants;
  ClusterOfFour<float>* force;            ///< by cluster; added to
  ClusterOfFour<float>* scalar;           ///< the same, numbers in x
  float* lanes;                           ///< kBornLanes by cluster, aligned, 0 before and after
  ClusterPairs::Range own;                ///< clusters of the rows
  Span<const ClusterPairs::Range> later;  ///< others that the rows name
};

/// The largest s^2/r^2 that series serve for.
inline constexpr double kBornFarRatio2 = 0.2;

/// Numbers of the 16 pairs of two clusters, not yet summed up to those of a cluster's four slots: forces
/// along x, y and z, and the scalars.
inline constexpr std::ptrdiff_t kBornLanes = 64;

/// The passes. Which terms there are is decided when this is compiled.
struct BornKernels {
  void (*integrals[2])(const BornTask&);             ///< without necks and with them
  void (*energies[2][2])(const BornTask&, double&);  ///< with an energy or not; without salt and with it
  void (*chain[2])(const BornTask&);                 ///< without necks and with them
};

}  // namespace dch::detail
