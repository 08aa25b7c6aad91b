// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/clusters/cluster_pairs.hpp>

#include "base/describe.hpp"
#include "clusters/simd/cluster_search_kernels.hpp"
#include "geometry/binary_grid.hpp"
#include "geometry/lattice.hpp"

namespace dch {
namespace {

constexpr std::int32_t kPadding = -1;

Vec3 slot_of(const ClusterOfFour<double>& cluster, int slot) {
  return {cluster.x[slot], cluster.y[slot], cluster.z[slot]};
}

void put(Vec3 at, int slot, ClusterOfFour<double>& cluster) {
  cluster.x[slot] = at.x;
  cluster.y[slot] = at.y;
  cluster.z[slot] = at.z;
}

bool all_within(double distance2, const ClusterOfFour<double>& a, const ClusterOfFour<double>& b) {
  for (int slot = 0; slot < ClusterPairs::kSlots; ++slot)
    if (!(norm2(slot_of(b, slot) - slot_of(a, slot)) < distance2)) return false;
  return true;
}

void round_axis(const detail::BinaryGrid& grid, const double* from, float* to, float& center) {
  const double middle = grid(0.25 * ((from[0] + from[1]) + (from[2] + from[3])));
  center = static_cast<float>(middle);
  for (int slot = 0; slot < ClusterPairs::kSlots; ++slot) to[slot] = static_cast<float>(from[slot] - middle);
}

/// Takes new positions of clusters that the boundary of the cell splits.
class SplitClusters {
 public:
  SplitClusters(ClusterPairs& pairs, Span<const Vec3> positions, const Box& now, double safe2)
      : pairs_(pairs),
        positions_(positions),
        now_(now),
        images_(now),
        grid_(pairs.list_radius),
        safe2_(safe2) {}

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
    ClusterOfFour<float>& rounded = pairs_.at_float[c];
    round_axis(grid_, at.x, rounded.x, rounded.center[0]);
    round_axis(grid_, at.y, rounded.y, rounded.center[1]);
    round_axis(grid_, at.z, rounded.z, rounded.center[2]);
    return split;
  }

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
      put(positions_[static_cast<std::size_t>(particle(split.cluster, slot))] -
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
  detail::BinaryGrid grid_;
  double safe2_;
};

}  // namespace

std::int64_t ClusterPairs::slot_pairs() const {
  std::int64_t pairs = 0;
  for (const Entry& entry : entries) pairs += __builtin_popcount(entry.mask);
  return pairs;
}

void ClusterPairs::refresh(Span<const Vec3> positions, const Box& now, Executor* executor) {
  if (positions.size() != particles)
    throw InvalidParameter("refresh() got " + std::to_string(positions.size()) +
                           " positions for cluster pairs of " + std::to_string(particles) +
                           " particles; make the pairs anew for another number");
  if (!same_periodicity(now, box))
    throw InvalidBox("refresh() got the box " + now.description() + " for cluster pairs made in the box " +
                     box.description() + "; make the pairs anew for another periodicity");
  refresh_clusters(positions, now, executor);
  if (has_shift_vectors && now == box) return;
  refresh_shifts(now);
  has_shift_vectors = true;
  box = now;
}

void ClusterPairs::refresh_clusters(Span<const Vec3> positions, const Box& now, Executor* executor) {
  const double safe = 0.25 * now.min_height(), safe2 = safe * safe;
  const auto refresh = detail::cluster_search_kernels(instruction_set()).refresh;
  std::vector<std::int32_t> far(at.size(), kPadding);
  for_ranges(executor, clusters(), [&](std::int32_t first, std::int32_t last) {
    const detail::RefreshTask task{first,           last,
                                   particle.data(), origin_of.data(),
                                   origin.data(),   positions.data(),
                                   safe2,           detail::BinaryGrid(list_radius).addend(),
                                   at.data(),       at_float.data()};
    refresh(task, far.data() + first);
  });
  far.erase(std::remove(far.begin(), far.end(), kPadding), far.end());
  SplitClusters taker(*this, positions, now, safe2);
  std::vector<SplitCluster> split_now;
  split_now.reserve(far.size());
  auto known = split_clusters.begin();
  for (const std::int32_t cluster : far) {
    while (known != split_clusters.end() && known->cluster < cluster) ++known;
    split_now.push_back(
        taker.take(cluster, known != split_clusters.end() && known->cluster == cluster ? &*known : nullptr));
  }
  split_clusters = std::move(split_now);
}

void ClusterPairs::refresh_shifts(const Box& now) {
  const detail::Lattice images(now);
  const detail::BinaryGrid grid(list_radius);
  for (std::size_t s = 0; s < shift.size(); ++s) {
    const Vec3 between =
        origin[static_cast<std::size_t>(shift[s].to)] - origin[static_cast<std::size_t>(shift[s].from)];
    const Vec3 vector = between + images.vector(shift[s].image);
    ClusterShift<float>& rounded = shift_vector_float[s];
    for (int slot = 0; slot < kSlots; ++slot) put(vector, slot, shift_vector[s].whole);
    for (int axis = 0; axis < 3; ++axis) {
      rounded.high[axis] = static_cast<float>(grid(vector[axis]));
      rounded.low[axis] = static_cast<float>(vector[axis] - double{rounded.high[axis]});
    }
  }
}

std::size_t ClusterPairs::memory_bytes() const {
  const auto bytes_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  return bytes_of(rows) + bytes_of(entries) + bytes_of(particle) + bytes_of(type) + bytes_of(origin_of) +
         bytes_of(origin) + bytes_of(shift) + bytes_of(at) + bytes_of(at_float) + bytes_of(shift_vector) +
         bytes_of(shift_vector_float) + bytes_of(split_clusters) + bytes_of(tasks) + bytes_of(ranges) +
         bytes_of(has_earlier_contributions);
}

}  // namespace dch
