// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/engines/verlet_list.hpp>

namespace dch {
namespace {

/// Of few particles all may be asked about.
constexpr double kLeastMost = 16;

std::size_t most_fast(std::size_t particles) {
  return static_cast<std::size_t>(std::max(kLeastMost, kMostFast * static_cast<double>(particles)));
}

}  // namespace

VerletList::VerletList(std::unique_ptr<PairSearch> search, ListParams params, Expiry expiry)
    : search_(std::move(search)), params_(std::move(params)), expiry_(expiry), stale_test_(params_.skin) {
  if (!search_)
    throw InvalidParameter("no search engine given; make one with make_dch_search or make_cell_search");
}

bool VerletList::is_stale(Span<const Vec3> positions, const Box& box) const {
  if (expiry_ == Expiry::half_skin) return stale_test_.is_stale(positions, box);
  switch (stale_test_.judge(positions, box, most_fast(positions.size()), fast_)) {
    case StaleTest::Verdict::fresh:
      return false;
    case StaleTest::Verdict::some_fast:
      return lacks_pair(positions);
    case StaleTest::Verdict::too_many:
      ++expiry_stats_.too_many;
      return true;
    case StaleTest::Verdict::stale:
      break;
  }
  return true;
}

/// Or may lack one, for all that the engine knows.
bool VerletList::lacks_pair(Span<const Vec3> positions) const {
  const UnlistedPair answer = search_->unlisted_pair({params_, radii_, positions, fast_});
  ++(answer == UnlistedPair::none    ? expiry_stats_.kept
     : answer == UnlistedPair::found ? expiry_stats_.missing
                                     : expiry_stats_.unknown);
  if (answer != UnlistedPair::unknown) expiry_stats_.queries += static_cast<std::int64_t>(fast_.size());
  return answer != UnlistedPair::none;
}

bool VerletList::update(Span<const Vec3> positions, const Box& box) {
  if (!is_stale(positions, box)) return false;
  stale_test_.forget();
  search_->update(positions, box);
  search_->list(params_, list_);
  radii_ = RadiusRange(params_.radii);
  stale_test_.remember(positions, box);
  ++rebuilds_;
  return true;
}

}  // namespace dch
