// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <dch/pair_search.hpp>

namespace dch {

/// A neighbor list that knows when it has gone stale.
///
/// After a build at positions x0 in box H0 the list stays complete for all pairs within the cutoff as long as
///     2 max_i |u_i| + max_n |(H - H0) n| <= skin,   n in {-1, 0, 1}^3,
/// where u_i is the shortest displacement of particle i in the present box. The first term is the classical skin/2
/// rule; the second bounds what a change of the box adds, since two particles of the wrapped reference within
/// r_list differ by at most one lattice vector per axis. A box of another kind, periodicity or origin along a
/// non-periodic axis, and another number of particles, are always stale.
class VerletList {
 public:
  /// @throws InvalidParameter for params that PairSearch::list refuses.
  VerletList(std::unique_ptr<PairSearch> search, ListParams params);

  /// True if a pair within the cutoff might be missing at these positions.
  bool is_stale(Span<const Vec3> positions, const Box& box) const;

  /// Rebuilds the list if it is stale; says whether it did.
  /// @throws as PairSearch::update and PairSearch::list; the list is then stale.
  bool update(Span<const Vec3> positions, const Box& box);

  const NeighborList& list() const { return list_; }
  const PairSearch& search() const { return *search_; }
  std::int64_t rebuilds() const { return rebuilds_; }

 private:
  std::unique_ptr<PairSearch> search_;
  ListParams params_;
  NeighborList list_;
  std::vector<Vec3> reference_;  ///< wrapped positions at the last build
  Box reference_box_;
  bool valid_ = false;
  std::int64_t rebuilds_ = 0;
};

}  // namespace dch
