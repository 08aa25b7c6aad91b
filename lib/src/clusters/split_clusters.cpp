// SPDX-License-Identifier: MIT
//
// ClusterPairs: new positions of clusters that the boundary of the cell splits.
#include <algorithm>
#include <cmath>
#include <exception>
#include <string>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/clusters/cluster_pairs.hpp>

#include "base/describe.hpp"
#include "clusters/cluster_places.hpp"
#include "geometry/lattice.hpp"

namespace dch {
namespace {

using detail::kPadding, detail::put_slot, detail::round_cluster, detail::slot_of;

bool all_within(double distance2, const ClusterOfFour<double>& a, const ClusterOfFour<double>& b) {
  for (int slot = 0; slot < ClusterPairs::kSlots; ++slot)
    if (!(norm2(slot_of(b, slot) - slot_of(a, slot)) < distance2)) return false;
  return true;
}

double farthest2_of(const ClusterOfFour<double>& at) {
  double most = 0;
  for (int slot = 0; slot < ClusterPairs::kSlots; ++slot) most = std::max(most, norm2(slot_of(at, slot)));
  return most;
}

/// Takes new positions of clusters that the boundary of the cell splits.
class SplitClusters {
 public:
  SplitClusters(ClusterPairs& pairs, Span<const Vec3> positions, const Box& now, double safe2)
      : pairs_(pairs),
        positions_(positions),
        now_(now),
        images_(now),
        safe2_(safe2),
        farthest2_(pairs.farthest * pairs.farthest) {}

  /// @param known what is known of it, or null
  /// @throws InvalidPosition, and then has changed nothing
  ClusterPairs::SplitCluster take(std::int32_t cluster, const ClusterPairs::SplitCluster* known) {
    const auto c = static_cast<std::size_t>(cluster);
    ClusterPairs::SplitCluster split = known ? *known : ClusterPairs::SplitCluster{cluster, {}};
    const ClusterOfFour<double>& before = pairs_.at[c];
    ClusterOfFour<double> at = place(split);
    if (!known || !all_within(safe2_, before, at)) {
      find_images(before, split);
      at = place(split);
    }
    pairs_.at[c] = at;
    farthest2_ = std::max(farthest2_, farthest2_of(at));
    const auto origin = static_cast<std::size_t>(pairs_.origin_of[c]);
    round_cluster(at, pairs_.origin_in_units[origin], 1 / pairs_.unit, pairs_.at_in_units[c]);
    return split;
  }
  /// Squared distance of the farthest particle from its origin, or what that was to be.
  double farthest2() const { return farthest2_; }

 private:
  std::int32_t particle(std::int32_t cluster, int slot) const {
    const std::int32_t* const of = &pairs_.particle[static_cast<std::size_t>(cluster) * ClusterPairs::kSlots];
    return of[of[slot] == kPadding ? 0 : slot];
  }
  Vec3 origin(std::int32_t cluster) const {
    return pairs_.origin[static_cast<std::size_t>(pairs_.origin_of[static_cast<std::size_t>(cluster)])];
  }

  /// The origin, which has few digits, is moved to each image: that does not round.
  ClusterOfFour<double> place(const ClusterPairs::SplitCluster& split) const {
    ClusterOfFour<double> at;
    for (int slot = 0; slot < ClusterPairs::kSlots; ++slot)
      put_slot(positions_[static_cast<std::size_t>(particle(split.cluster, slot))] -
                   (origin(split.cluster) - images_.vector(split.image[slot])),
               slot, at);
    return at;
  }

  /// The image of each particle is that nearest to where it was.
  void find_images(const ClusterOfFour<double>& before, ClusterPairs::SplitCluster& split) const {
    for (int slot = 0; slot < ClusterPairs::kSlots; ++slot) {
      const std::int32_t i = particle(split.cluster, slot);
      const Vec3 position = positions_[static_cast<std::size_t>(i)];
      const Vec3 moved = position - origin(split.cluster) - slot_of(before, slot);
      if (!std::isfinite(norm2(moved)))
        throw InvalidPosition("position " + std::to_string(i) + " = " + detail::describe(position) +
                              " is not finite; check the coordinates of this step");
      split.image[slot] =
          norm2(moved) < safe2_ ? Vec3{} : images_.integers(now_.nearest_image(moved) - moved);
    }
  }

  ClusterPairs& pairs_;
  Span<const Vec3> positions_;
  const Box& now_;
  detail::Lattice images_;
  double safe2_, farthest2_;
};

}  // namespace

/// Of several particles that are nowhere, the error names one of those that one thread would come to first.
void ClusterPairs::refresh_split(const std::vector<std::int32_t>& split, Span<const Vec3> positions,
                                 const Box& now, Executor* executor) {
  const double safe2 = detail::safe_distance2(now);
  std::vector<SplitCluster> split_now(split.size());
  const int shares = executor ? executor->threads() : 1;
  std::vector<double> farthest2(static_cast<std::size_t>(shares));
  std::vector<std::exception_ptr> error(static_cast<std::size_t>(shares));
  const auto take = [&](int share) {
    const std::size_t first = share_begin(split.size(), share, shares),
                      last = share_begin(split.size(), share + 1, shares);
    SplitClusters taker(*this, positions, now, safe2);
    auto known = split_clusters.begin();
    if (first < last)
      known = std::lower_bound(
          known, split_clusters.end(), split[first],
          [](const SplitCluster& before, std::int32_t cluster) { return before.cluster < cluster; });
    try {
      for (std::size_t k = first; k < last; ++k) {
        while (known != split_clusters.end() && known->cluster < split[k]) ++known;
        const bool is_known = known != split_clusters.end() && known->cluster == split[k];
        split_now[k] = taker.take(split[k], is_known ? &*known : nullptr);
      }
    } catch (...) {
      error[static_cast<std::size_t>(share)] = std::current_exception();
    }
    farthest2[static_cast<std::size_t>(share)] = taker.farthest2();
  };
  if (shares == 1) {
    take(0);
  } else {
    executor->run(shares, take);
  }
  for (const std::exception_ptr& first : error)
    if (first) std::rethrow_exception(first);
  split_clusters = std::move(split_now);
  const double most2 = *std::max_element(farthest2.begin(), farthest2.end());
  if (most2 > farthest * farthest) make_room_for(most2, now, executor);
}

}  // namespace dch
