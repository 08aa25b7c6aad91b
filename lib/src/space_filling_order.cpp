// SPDX-License-Identifier: MIT
#include "space_filling_order.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dch::detail {
namespace {

constexpr int kBits = 21;

std::uint64_t cell_number(double coordinate, double width) {
  const double cell = std::floor(coordinate / width);
  if (!(std::abs(cell) < 0x1p52))
    return 0;  // beyond exact integers; such a point is far from all others anyway
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(cell)) & ((1u << kBits) - 1);
}

/// Puts two zero bits between each of the low 21 bits.
std::uint64_t spread(std::uint64_t v) {
  v = (v | v << 32) & 0x001f00000000ffff;
  v = (v | v << 16) & 0x001f0000ff0000ff;
  v = (v | v << 8) & 0x100f00f00f00f00f;
  v = (v | v << 4) & 0x10c30c30c30c30c3;
  v = (v | v << 2) & 0x1249249249249249;
  return v;
}

}  // namespace

std::vector<std::int32_t> space_filling_order(Span<const Vec3> positions, const Box& box, double width) {
  std::vector<std::pair<std::uint64_t, std::int32_t>> keyed(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec3 p = box.wrap(positions[i]);
    keyed[i] = {spread(cell_number(p.x, width)) | spread(cell_number(p.y, width)) << 1 |
                    spread(cell_number(p.z, width)) << 2,
                static_cast<std::int32_t>(i)};
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::int32_t> order(keyed.size());
  std::transform(keyed.begin(), keyed.end(), order.begin(), [](const auto& entry) { return entry.second; });
  return order;
}

}  // namespace dch::detail
