// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include <dch/engines/expiry_test.hpp>
#include <dch/engines/pair_search.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// A neighbor list that knows when it has gone stale.
class VerletList {
 public:
  /// What params.types, params.radii and params.exclusions refer to must outlive the list, which does not
  /// notice if it changes: make another list then.
  /// @throws InvalidParameter without an engine, or for a negative or non-finite skin.
  VerletList(std::unique_ptr<PairSearch> search, ListParams params, Expiry expiry = Expiry::exact);

  /// True if a pair within the cutoff might be missing at these positions (and if there is a NaN among them).
  /// Counts what it asked in expiry(), so one thread at a time. O(n).
  bool is_stale(Span<const Vec3> positions, const Box& box) const;

  /// Rebuilds the list if it is stale; says whether it did.
  /// @throws as PairSearch::update and PairSearch::list; the list is then stale, whatever it holds.
  bool update(Span<const Vec3> positions, const Box& box);

  const NeighborList& list() const { return list_; }
  const PairSearch& search() const { return *search_; }
  std::int64_t rebuilds() const { return rebuilds_; }
  const ExpiryStats& expiry() const { return expiry_.stats(); }

 private:
  std::unique_ptr<PairSearch> search_;
  ListParams params_;
  NeighborList list_;
  ExpiryTest expiry_;
  std::int64_t rebuilds_ = 0;
};

}  // namespace dch
#pragma GCC visibility pop
