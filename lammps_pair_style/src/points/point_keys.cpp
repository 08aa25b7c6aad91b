// SPDX-License-Identifier: GPL-2.0-or-later
#include "point_keys.h"

#include <algorithm>
#include <cmath>

namespace dch::lammps {
namespace {

constexpr int kShiftBits = 8;
constexpr int kMaxShift = 127;
constexpr std::int64_t kTags = std::int64_t{1} << (64 - 3 * kShiftBits);

std::uint64_t pack(std::int64_t tag, const ImageFlags& cell) {
  auto key = static_cast<std::uint64_t>(tag);
  for (int n : cell) key = key << kShiftBits | (static_cast<std::uint64_t>(n) & ((1u << kShiftBits) - 1));
  return key;
}

}  // namespace

Span<const std::uint64_t> PointKeys::assign(Span<const Vec3> points, Span<const std::int64_t> tags,
                                            Span<const ImageFlags> images, const Lattice& lattice) {
  const std::size_t owned = images.size();
  const std::int64_t largest = tags.empty() ? 0 : *std::max_element(tags.begin(), tags.end());
  if (largest >= kTags) return {};
  keys_.resize(points.size());
  by_tag_.reset(points.size(), largest);
  for (std::size_t p = 0; p < owned; ++p) {
    keys_[p] = pack(tags[p], images[p]);
    by_tag_.find_or_add(tags[p], static_cast<std::int32_t>(p));
  }
  for (std::size_t p = owned; p < points.size(); ++p) {
    const auto reference =
        static_cast<std::size_t>(by_tag_.find_or_add(tags[p], static_cast<std::int32_t>(p)));
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
