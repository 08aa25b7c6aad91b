// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/base/vec3.hpp>
#include <dch/clusters/cluster_pairs.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/geometry/box.hpp>
#include <dch/lists/neighbor_list.hpp>

namespace dch::bench {

/// The Lennard-Jones melt in reduced units: density 0.8442, the potential cut off at 2.5 and shifted to 0
/// there, so that energy has no jump and its drift is that of lists, rounding and time step.
inline constexpr double kMeltDensity = 0.8442, kMeltCutoff = 2.5;

struct Melt {
  std::vector<Vec3> positions, velocities;  ///< positions are never wrapped
  Box box;

  double atoms() const { return static_cast<double>(positions.size()); }
  double kinetic_energy() const;
};

/// A face-centered cubic crystal of 4 cells^3 atoms with random velocities of temperature 1.44 and no
/// momentum.
Melt make_crystal(int cells, std::uint64_t seed);

/// What pairs within the cutoff make, found without the hierarchy and its kernels.
struct Truth {
  NeighborList pairs;        ///< half list at the cutoff, from make_cell_search()
  std::vector<Vec3> forces;  ///< summed up pair by pair in double
  double potential = 0;      ///< [energy]
};
Truth truth_of(const Melt& melt);

/// Pairs of particles, each once, to look others up in.
class HeldPairs {
 public:
  explicit HeldPairs(const NeighborList& list);
  explicit HeldPairs(const ClusterPairs& pairs);

  /// How many pairs of a list are not among these.
  std::int64_t missing_of(const NeighborList& list) const;

 private:
  void add(std::int32_t i, std::int32_t j);
  void sort();

  std::vector<std::uint64_t> pairs_;
};

/// sqrt(sum |found - expected|^2 / sum |expected|^2).
double relative_error(const std::vector<Vec3>& found, const std::vector<Vec3>& expected);

}  // namespace dch::bench
