// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/engines/pair_search.hpp>
#include <dch/lists/stale_test.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// When pairs that were found with a skin are stale.
enum class Expiry {
  half_skin,  ///< when a particle has moved more than half the skin: StaleTest
  /// When a pair within its cutoff is missing, or more particles than kMostFast of all (and than 16) have
  /// moved more than half the skin. The engine is asked about those as long as they are few; where it cannot
  /// tell, or the box has changed, half_skin decides. An engine that can tell has to be the owner's alone:
  /// nobody else updates it.
  exact
};

/// The share of particles that an engine is asked about at most; beyond it questions cost more than the steps
/// that they save.
inline constexpr double kMostFast = 0.01;

/// What engines have been asked, by half_skin none of it.
struct ExpiryStats {
  std::int64_t kept = 0;      ///< times that the engine found no pair missing, and pairs were kept
  std::int64_t queries = 0;   ///< particles that it was asked about, in all
  std::int64_t missing = 0;   ///< times that it found one
  std::int64_t too_many = 0;  ///< times that particles that had moved far were too many to ask about
  std::int64_t unknown = 0;   ///< times that it could not tell
};

/// In which periodic image a pair is read that has been kept.
enum class KeptImages {
  nearest,  ///< at each time: neighbor lists
  /// The one that was found: cluster pairs. Another one may come within the cutoff unseen, so in small boxes,
  /// and if particles have moved far, half_skin decides.
  as_found
};

/// Says when pairs that an engine has found are stale, by either rule.
class ExpiryTest {
 public:
  /// @throws InvalidParameter for a negative or non-finite skin [length].
  ExpiryTest(double skin, Expiry expiry, KeptImages images = KeptImages::nearest)
      : expiry_(expiry), images_(images), stale_test_(skin) {}

  /// True if a pair within the cutoff might be missing at these positions, if there is a NaN among them, and
  /// if none are remembered. Counts what it asked, so one thread at a time. O(n).
  /// @param params of the pairs
  /// @param search that found them, not updated since
  bool is_stale(Span<const Vec3> positions, const Box& box, const ListParams& params,
                PairSearch& search) const;
  /// StaleTest::allowance().
  double allowance(std::size_t particles, const Box& box) const {
    return stale_test_.allowance(particles, box);
  }
  /// is_stale(), if all but the candidates are known to be within allowance(), in the box of then.
  /// @param candidates  ascending
  bool is_stale(Span<const Vec3> positions, Span<const std::int32_t> candidates, const Box& box,
                const ListParams& params, PairSearch& search) const;
  /// Takes positions and the box that pairs have been found for. After a throw none are remembered.
  void remember(Span<const Vec3> positions, const Box& box, const ListParams& params);
  void forget() { stale_test_.forget(); }

  const ExpiryStats& stats() const { return stats_; }

 private:
  bool decide(StaleTest::Verdict verdict, Span<const Vec3> positions, const Box& box,
              const ListParams& params, PairSearch& search) const;
  bool lacks_pair(Span<const Vec3> positions, const Box& box, const ListParams& params,
                  PairSearch& search) const;
  std::size_t most_fast(std::size_t particles) const;
  bool keeps_images(const Box& box, const ListParams& params) const;

  Expiry expiry_;
  KeptImages images_;
  StaleTest stale_test_;
  RadiusRange radii_;
  mutable std::vector<MovedParticle> fast_;
  mutable ExpiryStats stats_;
};

}  // namespace dch
#pragma GCC visibility pop
