// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_CLUSTER_PAIR_KEEPER_H_
#define OPENMM_DCH_CLUSTER_PAIR_KEEPER_H_

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/clusters/cluster_pairs.hpp>
#include <dch/engines/expiry_test.hpp>
#include <dch/engines/pair_search.hpp>

namespace OpenMMDCH {

/// Keeps cluster pairs complete while particles move and the box changes.
class ClusterPairKeeper {
 public:
  /// @param executor, exclusions  outlive this
  ClusterPairKeeper(double cutoffDistance, const dch::Exclusions& exclusions, dch::Executor& executor);

  /// Types of the particles, from 0 to count - 1. Empty for one type. Pairs are kept.
  void setTypes(std::vector<std::int32_t> types, int count);

  /// Whether pairs can be kept in this box. If not, all pairs of particles have to be looked at.
  bool fits(const dch::Box& box) const;
  /// The pairs at these positions, searched for anew if some might be missing. For a box that fits.
  /// @param order  of their entries, for kernels that are faster with one
  const dch::ClusterPairs& at(dch::Span<const dch::Vec3> positions, const dch::Box& box,
                              dch::ClusterPairs::EntryOrder order = dch::ClusterPairs::EntryOrder::as_found);
  /// How often pairs have been searched for.
  std::int64_t searches() const { return searchCount; }

 private:
  void chooseSkin(const dch::Box& box);
  void labelPairs();
  /// After a search. OpenMM lets particles wander through any number of boxes, and clusters of which each
  /// particle is in an image of its own are slow to refresh: so periods of the box bring positions there.
  void rememberPlaces(dch::Span<const dch::Vec3> positions, const dch::Box& box);
  enum class Followed { Kept, Stale, Unknown };
  /// Takes positions in the box of the search, and tells in the same pass whether pairs are kept.
  Followed follow(dch::Span<const dch::Vec3> positions, const dch::Box& box);
  /// Whether no pair can be missing, and then they have these positions.
  bool isKept(dch::Span<const dch::Vec3> positions, const dch::Box& box);
  /// Positions moved by the periods of the search, unless few were in other boxes then.
  dch::Span<const dch::Vec3> broughtNear(dch::Span<const dch::Vec3> positions, const dch::Box& box);

  double cutoff;
  dch::Executor& pool;
  dch::ListParams request;
  std::vector<std::int32_t> particleTypes;
  int typeCount = 1;
  std::unique_ptr<dch::PairSearch> search;
  std::optional<dch::ExpiryTest> expiry;
  dch::ClusterPairs pairs;
  std::int64_t searchCount = 0;
  dch::ClusterPairs::Places places;
  std::vector<std::int32_t> alone;         ///< particles that are in no cluster
  std::vector<std::int32_t> awayClusters;  ///< from their places
  std::vector<std::int32_t> candidates;    ///< particles that may be far from theirs
  std::vector<dch::Vec3> periods;          ///< in multiples of the box vectors; empty if few are not 0
  std::vector<dch::Vec3> shifts;           ///< the same as vectors
  dch::Box boxOfShifts;
  std::vector<dch::Vec3> nearPositions;
};

}  // namespace OpenMMDCH

#endif
