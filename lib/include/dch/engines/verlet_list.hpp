// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include <dch/engines/pair_search.hpp>
#include <dch/lists/stale_test.hpp>

namespace dch {

/// A neighbor list that knows when it has gone stale, by StaleTest.
class VerletList {
 public:
  /// What params.types and params.exclusions refer to must outlive the list.
  /// @throws InvalidParameter without an engine, or for a negative or non-finite skin.
  VerletList(std::unique_ptr<PairSearch> search, ListParams params);

  /// True if a pair within the cutoff might be missing at these positions (and if there is a NaN among them).
  bool is_stale(Span<const Vec3> positions, const Box& box) const {
    return stale_test_.is_stale(positions, box);
  }

  /// Rebuilds the list if it is stale; says whether it did.
  /// @throws as PairSearch::update and PairSearch::list; the list is then stale, whatever it holds.
  bool update(Span<const Vec3> positions, const Box& box);

  const NeighborList& list() const { return list_; }
  const PairSearch& search() const { return *search_; }
  std::int64_t rebuilds() const { return rebuilds_; }

 private:
  std::unique_ptr<PairSearch> search_;
  ListParams params_;
  NeighborList list_;
  StaleTest stale_test_;
  std::int64_t rebuilds_ = 0;
};

}  // namespace dch
