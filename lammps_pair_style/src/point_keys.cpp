// SPDX-License-Identifier: GPL-2.0-or-later
#include "point_keys.h"

#include <cmath>

namespace dch::lammps {
namespace {

constexpr int kShiftBits = 8;
constexpr int kMaxShift = 127;

std::uint64_t pack(std::int64_t tag, const ImageFlags& cell) {
  auto key = static_cast<std::uint64_t>(tag);
  for (int n : cell) key = key << kShiftBits | (static_cast<std::uint64_t>(n) & ((1u << kShiftBits) - 1));
  return key;
}

}  // namespace

void PointKeys::reset_table(std::size_t entries) {
  std::size_t slots = 16;
  while (slots < 2 * entries) slots *= 2;
  slot_tag_.assign(slots, 0);
  slot_point_.resize(slots);
}

std::int32_t PointKeys::first_with_tag(std::int64_t tag, std::int32_t candidate) {
  const std::size_t mask = slot_tag_.size() - 1;
  std::size_t slot = (static_cast<std::uint64_t>(tag) * 0x9E3779B97F4A7C15u >> 20) & mask;
  while (slot_tag_[slot] != 0) {
    if (slot_tag_[slot] == tag) return slot_point_[slot];
    slot = (slot + 1) & mask;
  }
  slot_tag_[slot] = tag;
  slot_point_[slot] = candidate;
  return candidate;
}

Span<const std::uint64_t> PointKeys::assign(Span<const Vec3> points, Span<const std::int64_t> tags,
                                            Span<const ImageFlags> images, const Lattice& lattice) {
  const std::size_t owned = images.size();
  keys_.resize(points.size());
  reset_table(points.size());
  for (std::size_t p = 0; p < owned; ++p) {
    keys_[p] = pack(tags[p], images[p]);
    first_with_tag(tags[p], static_cast<std::int32_t>(p));
  }
  for (std::size_t p = owned; p < points.size(); ++p) {
    const auto reference = static_cast<std::size_t>(first_with_tag(tags[p], static_cast<std::int32_t>(p)));
    const Vec3 offset = lattice.lamda(points[p] - points[reference]);
    const Vec3 place = lattice.lamda(points[reference] - lattice.low);
    ImageFlags cell{};
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      if (!lattice.periodic[a]) continue;
      const double shift = std::round(offset[axis]);
      const double base = reference < owned ? images[reference][a] : -std::floor(place[axis]);
      if (!(std::abs(shift) <= kMaxShift) || !(std::abs(base) <= 1e6)) return {};
      cell[a] = static_cast<int>(base) - static_cast<int>(shift);
    }
    keys_[p] = pack(tags[p], cell);
  }
  return keys_;
}

}  // namespace dch::lammps
