// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <string>

#include <dch/base/error.hpp>
#include <dch/clusters/cluster_pairs.hpp>

#include "base/describe.hpp"
#include "clusters/cluster_places.hpp"
#include "clusters/simd/cluster_search_kernels.hpp"
#include "geometry/lattice.hpp"

namespace dch {
namespace {

using detail::kPadding, detail::nearest_unit, detail::put_slot, detail::round_cluster, detail::safe_distance2;

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
  take_box(now, executor);
  refresh_clusters(positions, now, executor);
  ++refreshes;
}

void ClusterPairs::take_box(const Box& now, Executor* executor) {
  if (has_shift_vectors && now == box) return;
  refresh_shifts(now, executor);
  choose_unit(now, executor);
  has_shift_vectors = true;
  box = now;
}

bool ClusterPairs::follow(const Places& places, Span<const Vec3> positions, const Box& now, double within,
                          std::vector<std::int32_t>& away, Executor* executor) {
  const auto follow = detail::cluster_search_kernels(instruction_set()).follow;
  std::atomic<bool> all_certain{true};
  take_box(now, executor);
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
  refresh_split(far, positions, now, executor);
}

void ClusterPairs::refresh_shifts(const Box& now, Executor* executor) {
  const detail::Lattice images(now);
  for_ranges(executor, shift.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t s = first; s < last; ++s) {
      const Vec3 between =
          origin[static_cast<std::size_t>(shift[s].to)] - origin[static_cast<std::size_t>(shift[s].from)];
      const Vec3 vector = between + images.vector(shift[s].image);
      for (int slot = 0; slot < kSlots; ++slot) put_slot(vector, slot, shift_vector[s].whole);
    }
  });
}

/// The finest in which no displacement of slots of an entry reaches 2^31.
void ClusterPairs::choose_unit(const Box& now, Executor* executor) {
  double widest = 0;
  std::mutex joining;
  for_ranges(executor, shift.size(), [&](std::size_t first, std::size_t last) {
    double own = 0;
    for (std::size_t s = first; s < last; ++s) {
      const ClusterOfFour<double>& by = shift_vector[s].whole;
      own = std::max({own, std::abs(by.x[0]), std::abs(by.y[0]), std::abs(by.z[0])});
    }
    const std::lock_guard lock(joining);
    widest = std::max(widest, own);
  });
  unit = std::ldexp(1, std::ilogb(widest + 2 * farthest) + 1 - 31);
  origin_in_units.resize(origin.size());
  for (std::size_t k = 0; k < origin.size(); ++k)
    for (int axis = 0; axis < 3; ++axis)
      origin_in_units[k][axis] = 0x1.8p52 + static_cast<double>(nearest_unit(origin[k][axis] / unit));
  const detail::Lattice images(now);
  for_ranges(executor, shift.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t s = first; s < last; ++s) {
      const Vec3 vector = images.vector(shift[s].image);
      for (int axis = 0; axis < 3; ++axis) shift_in_units[s].axis[axis] = nearest_unit(vector[axis] / unit);
    }
  });
}

/// For particles that have gone far from their origins, to stay near each other all the same.
void ClusterPairs::make_room_for(double farthest2, const Box& now, Executor* executor) {
  farthest = 2 * std::sqrt(farthest2);
  choose_unit(now, executor);
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
