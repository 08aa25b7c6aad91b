// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/clusters/cluster_pairs.hpp>

#include "base/describe.hpp"
#include "clusters/simd/cluster_search_kernels.hpp"
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

/// The nearest integer modulo 2^32.
std::int32_t rounded(double units) {
  if (!(std::abs(units) < 0x1p51)) units = std::remainder(units, 0x1p32);  // slow, and exact
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(std::llrint(units)));
}

/// As the kernels do.
void round_cluster(const ClusterOfFour<double>& at, Vec3 origin, double per_unit, ClusterUnits& to) {
  const auto last_bits = [](double sum) { return rounded(sum - 0x1.8p52); };
  for (int slot = 0; slot < ClusterPairs::kSlots; ++slot) {
    to.x[slot] = last_bits(per_unit * at.x[slot] + origin.x);
    to.y[slot] = last_bits(per_unit * at.y[slot] + origin.y);
    to.z[slot] = last_bits(per_unit * at.z[slot] + origin.z);
  }
}

double farthest2_of(const ClusterOfFour<double>& at) {
  double most = 0;
  for (int slot = 0; slot < ClusterPairs::kSlots; ++slot) most = std::max(most, norm2(slot_of(at, slot)));
  return most;
}

/// Of how far a particle moves less in the image that it is in.
double safe_distance2(const Box& box) {
  const double safe = 0.25 * box.min_height();
  return safe * safe;
}

detail::RefreshTask refresh_task(ClusterPairs& pairs, ClusterPairs::Range clusters,
                                 Span<const Vec3> positions, double safe2) {
  return {clusters.first,
          clusters.last,
          pairs.particle.data(),
          pairs.origin_of.data(),
          pairs.origin.data(),
          pairs.origin_in_units.data(),
          positions.data(),
          safe2,
          pairs.farthest * pairs.farthest,
          1 / pairs.unit,
          pairs.at.data(),
          pairs.at_in_units.data()};
}

/// Of clusters in an array with room for all.
void keep_numbers(std::vector<std::int32_t>& clusters) {
  clusters.erase(std::remove(clusters.begin(), clusters.end(), kPadding), clusters.end());
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
  double safe2_, farthest2_;
};

}  // namespace

/// Bits are counted by arithmetic on numbers of 16 bits, of which compilers put several into a register.
std::int64_t ClusterPairs::slot_pairs() const {
  std::int64_t pairs = 0;
  for (const Entry& entry : entries) {
    std::uint32_t bits = entry.mask;
    bits -= bits >> 1 & 0x5555;
    bits = (bits & 0x3333) + (bits >> 2 & 0x3333);
    bits = (bits + (bits >> 4)) & 0x0F0F;
    pairs += (bits + (bits >> 8)) & 0x1F;
  }
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
  take_box(now);
  refresh_clusters(positions, now, executor);
  ++refreshes;
}

void ClusterPairs::take_box(const Box& now) {
  if (has_shift_vectors && now == box) return;
  refresh_shifts(now);
  choose_unit(now);
  has_shift_vectors = true;
  box = now;
}

bool ClusterPairs::follow(const Places& places, Span<const Vec3> positions, const Box& now, double within,
                          std::vector<std::int32_t>& away, Executor* executor) {
  const auto follow = detail::cluster_search_kernels(instruction_set()).follow;
  std::atomic<bool> all_certain{true};
  take_box(now);
  away.assign(at.size(), kPadding);
  for_ranges(executor, clusters(), [&](std::int32_t first, std::int32_t last) {
    const detail::FollowTask task{refresh_task(*this, {first, last}, positions, safe_distance2(now)),
                                  places.at.data(), places.shift_of.data(), places.shift.data(),
                                  within * within};
    if (follow(task, away.data() + first).uncertain > 0) all_certain = false;
  });
  keep_numbers(away);
  if (!all_certain) return false;
  split_clusters.clear();
  ++refreshes;
  return true;
}

void ClusterPairs::refresh_clusters(Span<const Vec3> positions, const Box& now, Executor* executor) {
  const double safe2 = safe_distance2(now);
  const auto refresh = detail::cluster_search_kernels(instruction_set()).refresh;
  std::vector<std::int32_t> far(at.size(), kPadding);
  for_ranges(executor, clusters(), [&](std::int32_t first, std::int32_t last) {
    refresh(refresh_task(*this, {first, last}, positions, safe2), far.data() + first);
  });
  keep_numbers(far);
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
  if (taker.farthest2() > farthest * farthest) make_room_for(taker.farthest2(), now);
}

void ClusterPairs::refresh_shifts(const Box& now) {
  const detail::Lattice images(now);
  for (std::size_t s = 0; s < shift.size(); ++s) {
    const Vec3 between =
        origin[static_cast<std::size_t>(shift[s].to)] - origin[static_cast<std::size_t>(shift[s].from)];
    const Vec3 vector = between + images.vector(shift[s].image);
    for (int slot = 0; slot < kSlots; ++slot) put(vector, slot, shift_vector[s].whole);
  }
}

/// The finest in which no displacement of slots of an entry reaches 2^31.
void ClusterPairs::choose_unit(const Box& now) {
  double widest = 0;
  for (const ClusterShift<double>& by : shift_vector)
    widest = std::max({widest, std::abs(by.whole.x[0]), std::abs(by.whole.y[0]), std::abs(by.whole.z[0])});
  unit = std::ldexp(1, std::ilogb(widest + 2 * farthest) + 1 - 31);
  origin_in_units.resize(origin.size());
  for (std::size_t k = 0; k < origin.size(); ++k)
    for (int axis = 0; axis < 3; ++axis)
      origin_in_units[k][axis] = 0x1.8p52 + static_cast<double>(rounded(origin[k][axis] / unit));
  const detail::Lattice images(now);
  for (std::size_t s = 0; s < shift.size(); ++s) {
    const Vec3 vector = images.vector(shift[s].image);
    for (int axis = 0; axis < 3; ++axis) shift_in_units[s].axis[axis] = rounded(vector[axis] / unit);
  }
}

/// For particles that have gone far from their origins, to stay near each other all the same.
void ClusterPairs::make_room_for(double farthest2, const Box& now) {
  farthest = 2 * std::sqrt(farthest2);
  choose_unit(now);
  for (std::size_t c = 0; c < at.size(); ++c)
    round_cluster(at[c], origin_in_units[static_cast<std::size_t>(origin_of[c])], 1 / unit, at_in_units[c]);
}

std::size_t ClusterPairs::memory_bytes() const {
  const auto bytes_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  return bytes_of(rows) + bytes_of(entries) + bytes_of(particle) + bytes_of(type) + bytes_of(origin_of) +
         bytes_of(origin) + bytes_of(shift) + bytes_of(at) + bytes_of(at_in_units) + bytes_of(shift_vector) +
         bytes_of(shift_in_units) + bytes_of(origin_in_units) + bytes_of(split_clusters) + bytes_of(tasks) +
         bytes_of(ranges) + bytes_of(parts) + bytes_of(has_earlier_contributions);
}

}  // namespace dch
