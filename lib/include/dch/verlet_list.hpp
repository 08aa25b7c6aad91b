// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <dch/pair_search.hpp>

namespace dch {

/// A neighbor list that knows when it has gone stale.
///
/// After a build at positions x0 in box H0 the list holds every pair within its cutoff as long as
///     2 max_i |u_i| + max_n |(H - H0) n| <= skin,   n in {-1, 0, 1}^3,
/// where u_i is the shortest displacement of particle i in the present box H. The first term is the classical
/// skin/2 rule. The second bounds what a change of the box adds: H0 is the reduced basis of the periodic
/// vectors, H the same integer combinations of the present vectors, and since the heights of H0 are at least
/// 2 (cutoff + skin), the images of two wrapped particles that come within the cutoff differ by at most one
/// vector of each. Changes of the origin and of open axes move no pair. Another periodicity and another
/// number of particles are always stale.
class VerletList {
 public:
  /// What params.types and params.exclusions refer to must outlive the list.
  /// @throws InvalidParameter without an engine, or for a negative or non-finite skin.
  VerletList(std::unique_ptr<PairSearch> search, ListParams params);

  /// True if a pair within the cutoff might be missing at these positions (and if there is a NaN among them).
  bool is_stale(Span<const Vec3> positions, const Box& box) const;

  /// Rebuilds the list if it is stale; says whether it did.
  /// @throws as PairSearch::update and PairSearch::list; the list is then stale.
  bool update(Span<const Vec3> positions, const Box& box);

  const NeighborList& list() const { return list_; }
  const PairSearch& search() const { return *search_; }
  std::int64_t rebuilds() const { return rebuilds_; }

 private:
  void remember(Span<const Vec3> positions, const Box& box);
  std::array<Vec3, 3> periods(const Box& box) const;
  double strain(const Box& box) const;

  std::unique_ptr<PairSearch> search_;
  ListParams params_;
  NeighborList list_;
  std::vector<Vec3> reference_;  ///< wrapped positions at the last build
  Box reference_box_;
  /// Reduced periodic vectors of the reference box as integer combinations of its cell vectors.
  std::array<std::array<double, 3>, 3> combinations_{};
  bool valid_ = false;
  std::int64_t rebuilds_ = 0;
};

}  // namespace dch
