// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <dch/engines/pair_search.hpp>
#include <dch/lists/stale_test.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// When a list is stale.
enum class Expiry {
  half_skin,  ///< when a particle has moved more than half the skin: StaleTest
  /// When a pair within its cutoff is not in the list, or more particles than kMostFast of all (and than
  /// 16) have moved more than half the skin. The engine is asked about those as long as they are few; where
  /// it cannot tell, or the box has changed, half_skin decides. An engine that can tell has to be the list's
  /// own: nobody else updates it.
  exact
};

/// The share of particles that an engine is asked about at most; beyond it questions cost more than the steps
/// that they save.
inline constexpr double kMostFast = 0.01;

/// What VerletList has been asked, by half_skin none of it.
struct ExpiryStats {
  std::int64_t kept = 0;      ///< times that the engine found no pair missing, and the list was kept
  std::int64_t queries = 0;   ///< particles that it was asked about, in all
  std::int64_t missing = 0;   ///< times that it found one
  std::int64_t too_many = 0;  ///< times that particles that had moved far were too many to ask about
  std::int64_t unknown = 0;   ///< times that it could not tell
};

/// A neighbor list that knows when it has gone stale.
class VerletList {
 public:
  /// What params.types, params.radii and params.exclusions refer to must outlive the list.
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
  const ExpiryStats& expiry() const { return expiry_stats_; }

 private:
  bool lacks_pair(Span<const Vec3> positions) const;

  std::unique_ptr<PairSearch> search_;
  ListParams params_;
  Expiry expiry_;
  RadiusRange radii_;
  NeighborList list_;
  StaleTest stale_test_;
  std::int64_t rebuilds_ = 0;
  mutable std::vector<MovedParticle> fast_;
  mutable ExpiryStats expiry_stats_;
};

}  // namespace dch
#pragma GCC visibility pop
