// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <dch/clusters/cluster_pairs.hpp>
#include <dch/lists/all_pairs.hpp>

namespace dch {

/// What is wrong with cluster pairs at these positions, as a sentence; empty if nothing is: every pair of the
/// oracle's list stands in one entry, with the displacement of its nearest image; no other pair within the
/// list radius does. For positions that have moved, the request
/// must ask for no more than what was to be kept complete.
inline std::string cluster_pair_fault(const ClusterPairs& pairs, const std::vector<Vec3>& positions,
                                      const Box& box, ListParams request) {
  request.kind = ListKind::half;
  request.order = RowOrder::by_index;
  const NeighborList expected = all_pairs(positions, box, request);
  double largest = 0;
  for (const Vec3 p : positions) largest = std::max(largest, std::sqrt(norm2(p)));
  const double band = 1e-9 * request.list_radius() + 1e-13 * largest;
  const double radius = request.list_radius();

  std::vector<int> times(positions.size(), 0);
  for (const std::int32_t i : pairs.particle)
    if (i >= 0) ++times[static_cast<std::size_t>(i)];
  if (std::any_of(times.begin(), times.end(), [](int t) { return t > 1; }))
    return "a particle stands in two slots";

  std::map<std::pair<std::int32_t, std::int32_t>, int> found;  // within the radius for sure, then at it
  std::string fault;
  pairs.for_each([&](std::int32_t i, std::int32_t j, Vec3 d) {
    if (i < 0 || j < 0) {
      fault = "padding in a mask";
      return;
    }
    const Vec3 apart = positions[static_cast<std::size_t>(j)] - positions[static_cast<std::size_t>(i)];
    if (std::sqrt(norm2(box.nearest_image(d - apart))) > band)
      fault = "particles " + std::to_string(i) + " and " + std::to_string(j) + ": no image is there";
    if (std::sqrt(norm2(d)) > radius + band) return;
    found[{std::min(i, j), std::max(i, j)}] += std::sqrt(norm2(d)) < radius - band ? 1000 : 1;
  });
  if (!fault.empty()) return fault;
  std::size_t matched = 0;
  for (std::size_t i = 0; i < expected.size(); ++i)
    for (const std::int32_t j : expected.row(i)) {
      const auto at = found.find({static_cast<std::int32_t>(i), j});
      const std::string pair = "pair " + std::to_string(i) + ", " + std::to_string(j);
      if (at == found.end()) return pair + " is missing";
      if (at->second > 1000) return pair + " stands there twice";
      ++matched;
    }
  if (matched == found.size()) return {};
  // With one cutoff, what is found beyond the list lies within rounding of the radius.
  for (const auto& [pair, count] : found) {
    const auto row = expected.row(static_cast<std::size_t>(pair.first));
    if (count < 1000 || std::binary_search(row.begin(), row.end(), pair.second)) continue;
    if (request.cutoffs.types() > 1) {
      const auto type = [&](std::int32_t p) { return request.types[static_cast<std::size_t>(p)]; };
      if (request.cutoffs(type(pair.first), type(pair.second)) > 0) continue;  // within another's cutoff
    }
    return "pair " + std::to_string(pair.first) + ", " + std::to_string(pair.second) + " is too many";
  }
  return {};
}

}  // namespace dch
