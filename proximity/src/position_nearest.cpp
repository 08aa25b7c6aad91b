// SPDX-License-Identifier: MIT
#include "position_nearest.hpp"

#include <cmath>
#include <string>

#include <dch/base/error.hpp>

#include "base/describe.hpp"
#include "geometry/space_filling_order.hpp"

namespace dch::detail {

void check(const NearestParams& params) {
  if (params.k < 1 || params.k > kMaxNearest)
    throw InvalidParameter(std::to_string(params.k) + " nearest neighbors were asked for; ask for 1 to " +
                           std::to_string(kMaxNearest));
  if (!(std::isfinite(params.epsilon) && params.epsilon >= 0))
    throw InvalidParameter("epsilon of a nearest neighbor query is " + describe(params.epsilon) +
                           "; it must be finite, and 0 for the nearest ones or more");
}

void make_rows(std::size_t rows, std::int32_t k, NearestRows& out) {
  const std::size_t entries = rows * static_cast<std::size_t>(k);
  if (out.id.capacity() < entries || out.distance2.capacity() < entries) out = NearestRows();
  out.k = k;
  out.id.resize(entries);
  out.distance2.resize(entries);
}

std::vector<std::int32_t> order_of_queries(Span<const Vec3> positions, const Structure& structure) {
  if (positions.size() == 1) return {0};
  return space_filling_order(positions, structure.box, structure.base_radius);
}

void add(const NearestWork& more, NearestWork& sum) {
  sum.nodes += more.nodes;
  sum.blocks += more.blocks;
  sum.points += more.points;
}

}  // namespace dch::detail
