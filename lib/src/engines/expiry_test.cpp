// SPDX-License-Identifier: MIT
#include <algorithm>

#include <dch/engines/expiry_test.hpp>

namespace dch {
namespace {

/// Of few particles all may be asked about.
constexpr double kLeastMost = 16;

}  // namespace

std::size_t ExpiryTest::most_fast(std::size_t particles) const {
  if (expiry_ == Expiry::half_skin) return 0;
  return static_cast<std::size_t>(std::max(kLeastMost, kMostFast * static_cast<double>(particles)));
}

bool ExpiryTest::is_stale(Span<const Vec3> positions, const Box& box, const ListParams& params,
                          PairSearch& search) const {
  if (expiry_ == Expiry::half_skin) return stale_test_.is_stale(positions, box);
  return decide(stale_test_.judge(positions, box, most_fast(positions.size()), fast_), positions, box, params,
                search);
}

bool ExpiryTest::is_stale(Span<const Vec3> positions, Span<const std::int32_t> candidates, const Box& box,
                          const ListParams& params, PairSearch& search) const {
  return decide(stale_test_.judge(positions, box, candidates, most_fast(positions.size()), fast_), positions,
                box, params, search);
}

bool ExpiryTest::decide(StaleTest::Verdict verdict, Span<const Vec3> positions, const Box& box,
                        const ListParams& params, PairSearch& search) const {
  switch (verdict) {
    case StaleTest::Verdict::fresh:
      return false;
    case StaleTest::Verdict::some_fast:
      return lacks_pair(positions, box, params, search);
    case StaleTest::Verdict::too_many:
      ++stats_.too_many;
      return true;
    case StaleTest::Verdict::stale:
      break;
  }
  return true;
}

/// Or may lack one, for all that the engine knows.
bool ExpiryTest::lacks_pair(Span<const Vec3> positions, const Box& box, const ListParams& params,
                            PairSearch& search) const {
  const UnlistedPair answer = keeps_images(box, params)
                                  ? search.unlisted_pair({params, radii_, positions, fast_})
                                  : UnlistedPair::unknown;
  ++(answer == UnlistedPair::none    ? stats_.kept
     : answer == UnlistedPair::found ? stats_.missing
                                     : stats_.unknown);
  if (answer != UnlistedPair::unknown) stats_.queries += static_cast<std::int64_t>(fast_.size());
  return answer != UnlistedPair::none;
}

// Two images of a pair are a period apart. One of them was found within the list radius r; so the other one
// was beyond the smallest height less r, and is still beyond the cutoff unless both particles together have
// moved by what is left.
bool ExpiryTest::keeps_images(const Box& box, const ListParams& params) const {
  if (images_ == KeptImages::nearest || !box.any_periodic()) return true;
  constexpr double kSafe = 1 - 1e-9;
  double farthest = 0;
  for (const MovedParticle& fast : fast_) farthest = std::max(farthest, fast.moved);
  return 2 * (params.list_radius() + farthest) - params.skin <= kSafe * box.min_height();
}

void ExpiryTest::remember(Span<const Vec3> positions, const Box& box, const ListParams& params) {
  radii_ = RadiusRange(params.radii);
  stale_test_.remember(positions, box, params.list_radius());
}

}  // namespace dch
