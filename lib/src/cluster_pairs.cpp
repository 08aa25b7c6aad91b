// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>

#include <dch/cluster_pairs.hpp>
#include <dch/error.hpp>

#include "binary_grid.hpp"
#include "cell_images.hpp"
#include "describe.hpp"

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

/// Whether every slot has moved by less than a distance; false too if a number is not finite.
bool all_within(double distance2, const ClusterOfFour<double>& a, const ClusterOfFour<double>& b) {
  bool all = true;
  for (int slot = 0; slot < ClusterPairs::kSlots; ++slot) {
    const double x = b.x[slot] - a.x[slot], y = b.y[slot] - a.y[slot], z = b.z[slot] - a.z[slot];
    const double moved2 = x * x + y * y + z * z;
    all &= moved2 < distance2;
  }
  return all;
}

void round_axis(const detail::BinaryGrid& grid, const double* from, float* to, float& center) {
  const double middle = grid(0.25 * ((from[0] + from[1]) + (from[2] + from[3])));
  center = static_cast<float>(middle);
  for (int slot = 0; slot < ClusterPairs::kSlots; ++slot) to[slot] = static_cast<float>(from[slot] - middle);
}

}  // namespace

std::int64_t ClusterPairs::slot_pairs() const {
  std::int64_t pairs = 0;
  for (const Entry& entry : entries) pairs += __builtin_popcount(entry.mask);
  return pairs;
}

void ClusterPairs::refresh(Span<const Vec3> positions, const Box& now) {
  if (positions.size() != particles)
    throw InvalidParameter("refresh() got " + std::to_string(positions.size()) +
                           " positions for cluster pairs of " + std::to_string(particles) +
                           " particles; make the pairs anew for another number");
  if (!same_periodicity(now, box))
    throw InvalidBox("refresh() got the box " + now.description() + " for cluster pairs made in the box " +
                     box.description() + "; make the pairs anew for another periodicity");
  const detail::CellImages images(now);
  const detail::BinaryGrid grid(list_radius);
  const double safe = 0.25 * now.min_height(), safe2 = safe * safe;
  for (std::size_t c = 0; c < at.size(); ++c) {
    const Vec3 center = origin[static_cast<std::size_t>(origin_of[c])];
    const std::int32_t* const particles_of = &particle[c * kSlots];
    const ClusterOfFour<double>& before = at[c];
    ClusterOfFour<double> now_at;  // taken straight from the new positions, so that rounding does not add up
    for (int slot = 0; slot < kSlots; ++slot) {
      const std::int32_t i = particles_of[particles_of[slot] == kPadding ? 0 : slot];
      put(positions[static_cast<std::size_t>(i)] - center, slot, now_at);
    }
    if (!all_within(safe2, before, now_at)) {
      for (int slot = 0; slot < kSlots; ++slot) {
        const std::int32_t i = particles_of[particles_of[slot] == kPadding ? 0 : slot];
        const Vec3 moved = slot_of(now_at, slot) - slot_of(before, slot);
        if (!std::isfinite(norm2(moved)))
          throw InvalidPosition("position " + std::to_string(i) + " = " +
                                detail::describe(positions[static_cast<std::size_t>(i)]) +
                                " is not finite; check the coordinates of this step");
        if (norm2(moved) < safe2) continue;
        // The image is that nearest to where the particle was. The origin, which has few digits, is first
        // moved to it: that does not round.
        put(positions[static_cast<std::size_t>(i)] -
                (center - images.vector(images.integers(now.nearest_image(moved) - moved))),
            slot, now_at);
      }
    }
    at[c] = now_at;
    ClusterOfFour<float>& rounded = at_float[c];
    round_axis(grid, now_at.x, rounded.x, rounded.center[0]);
    round_axis(grid, now_at.y, rounded.y, rounded.center[1]);
    round_axis(grid, now_at.z, rounded.z, rounded.center[2]);
  }
  for (std::size_t s = 0; s < shift.size(); ++s) {
    const Vec3 between =
        origin[static_cast<std::size_t>(shift[s].to)] - origin[static_cast<std::size_t>(shift[s].from)];
    const Vec3 vector = between + images.vector(shift[s].image);
    ClusterShift<float>& parts = shift_vector_float[s];
    for (int slot = 0; slot < kSlots; ++slot) put(vector, slot, shift_vector[s].whole);
    for (int axis = 0; axis < 3; ++axis) {
      parts.high[axis] = static_cast<float>(grid(vector[axis]));
      parts.low[axis] = static_cast<float>(vector[axis] - double{parts.high[axis]});
    }
  }
  box = now;
}

std::size_t ClusterPairs::memory_bytes() const {
  const auto bytes_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  return bytes_of(rows) + bytes_of(entries) + bytes_of(particle) + bytes_of(type) + bytes_of(origin_of) +
         bytes_of(origin) + bytes_of(shift) + bytes_of(at) + bytes_of(at_float) + bytes_of(shift_vector) +
         bytes_of(shift_vector_float);
}

}  // namespace dch
