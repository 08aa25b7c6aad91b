// SPDX-License-Identifier: MIT
#include "geometry/space_filling_order.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/metric.hpp"

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

struct Keyed {
  std::uint64_t key;
  std::int32_t index;
};

/// Sorts by key, stably: by one digit after the other, from the least, leaving out those that all keys share.
void sort_by_key(std::vector<Keyed>& keyed) {
  constexpr int kDigit = 11;
  constexpr std::size_t kValues = std::size_t{1} << kDigit;
  std::uint64_t differing = 0;
  for (const Keyed& k : keyed) differing |= k.key ^ keyed[0].key;
  std::vector<Keyed> sorted(keyed.size());
  std::vector<std::uint32_t> first(kValues);
  for (int shift = 0; shift < 64; shift += kDigit) {
    if ((differing >> shift & (kValues - 1)) == 0) continue;
    const auto digit = [shift](const Keyed& k) { return k.key >> shift & (kValues - 1); };
    std::fill(first.begin(), first.end(), 0);
    for (const Keyed& k : keyed) ++first[digit(k)];
    std::uint32_t sum = 0;
    for (std::uint32_t& count : first) sum += std::exchange(count, sum);
    for (const Keyed& k : keyed) sorted[first[digit(k)]++] = k;
    keyed.swap(sorted);
  }
}

}  // namespace

std::vector<std::int32_t> space_filling_order(Span<const Vec3> positions, const Box& box, double width) {
  std::vector<Keyed> keyed(positions.size());
  with_metric(box, [&](const auto& metric) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const Vec3 p = metric.wrap(positions[i]);
      keyed[i] = {spread(cell_number(p.x, width)) | spread(cell_number(p.y, width)) << 1 |
                      spread(cell_number(p.z, width)) << 2,
                  static_cast<std::int32_t>(i)};
    }
  });
  sort_by_key(keyed);
  std::vector<std::int32_t> order(keyed.size());
  std::transform(keyed.begin(), keyed.end(), order.begin(), [](const Keyed& entry) { return entry.index; });
  return order;
}

}  // namespace dch::detail
