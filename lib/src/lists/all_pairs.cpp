// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/lists/all_pairs.hpp>

#include "geometry/position_check.hpp"
#include "lists/list_check.hpp"

namespace dch {
namespace {

using Integer = std::int64_t;

/// Largest integer <= x, for |x| < 2^63.
Integer floor_to_integer(double x) {
  const auto n = static_cast<Integer>(x);
  return n - (x < static_cast<double>(n));
}

/// The definition of ListParams, pair by pair.
class Oracle {
 public:
  Oracle(Span<const Vec3> positions, const Box& box, const ListParams& params)
      : positions_(positions), params_(params), types_(params.cutoffs.types()) {
    detail::check_list_params(params, positions.size(), params.list_radius() + params.cutoff_error());
    detail::check_radius(params.list_radius(), box);
    detail::check_positions(positions, box);
    for (int a = 0; a < types_; ++a) {
      for (int b = 0; b < types_; ++b) {
        const double reach = params.cutoffs(a, b) + params.skin;
        limit2_.push_back(params.cutoffs(a, b) > 0 ? reach * reach : -1);
      }
    }
    for (int axis = 0; axis < 3; ++axis) cell_[axis] = box.vector(axis);
    for (int axis = 0; axis < 3; ++axis) {
      if (box.periodic(axis)) add_period(axis, box);
    }
  }

  bool contains(std::int32_t i, std::int32_t j) const {
    if (i > j) std::swap(i, j);
    return is_near(i, j) && !(is_ghost(i) && is_ghost(j)) && !is_excluded(i, j);
  }
  bool is_ghost(std::int32_t i) const { return params_.first_ghost >= 0 && i >= params_.first_ghost; }

 private:
  /// A periodic axis. For a displacement with the component f along it, all images within the list radius
  /// have |f + n| <= reach, since images with equal n lie in planes whose distance is the perpendicular
  /// height of the cell.
  struct Period {
    int axis;
    double reach;                    ///< list radius / height, and room for the rounding of f
    std::vector<double> fractional;  ///< of each particle, along this axis
  };

  void add_period(int axis, const Box& box) {
    const Vec3 g = plane_normal(axis, box);
    double largest = 0;
    Period period{axis, 0, {}};
    for (const Vec3 p : positions_) {
      period.fractional.push_back(dot(g, p));
      largest = std::max(largest, std::abs(g.x * p.x) + std::abs(g.y * p.y) + std::abs(g.z * p.z));
    }
    const double rounding = 1e-9 + 16 * std::numeric_limits<double>::epsilon() * largest;
    period.reach = (params_.list_radius() + params_.cutoff_error()) * std::sqrt(norm2(g)) + rounding;
    periods_.push_back(std::move(period));
  }

  /// The vector g with g . a_axis = 1 that is normal to the other periodic vectors, and has no component
  /// outside the span of the periodic vectors: g . x is the fractional coordinate and 1/|g| the height.
  static Vec3 plane_normal(int axis, const Box& box) {
    const int second = (axis + 1) % 3, third = (axis + 2) % 3;
    // Of unit length, whose products double precision holds whatever the unit of length.
    const auto direction = [&](int k) { return (1 / std::sqrt(norm2(box.vector(k)))) * box.vector(k); };
    const Vec3 a = direction(axis), b = direction(second), c = direction(third);
    Vec3 g = a;
    if (box.periodic(second) && box.periodic(third)) g = cross(b, c);
    if (box.periodic(second) && !box.periodic(third)) g = cross(b, cross(a, b));
    if (!box.periodic(second) && box.periodic(third)) g = cross(c, cross(a, c));
    return (1 / dot(g, box.vector(axis))) * g;
  }

  double limit2_of(std::int32_t i, std::int32_t j) const {
    if (!params_.radii.empty()) {
      const double reach = params_.radii[i] + params_.radii[j] + params_.skin;
      return reach * reach;
    }
    return types_ == 1 ? limit2_[0] : limit2_[std::size_t{1} * params_.types[i] * types_ + params_.types[j]];
  }

  bool is_near(std::int32_t i, std::int32_t j) const {
    std::array<Integer, 3> low{0, 0, 0}, high{0, 0, 0};
    for (const Period& period : periods_) {
      const double f = period.fractional[j] - period.fractional[i];
      low[period.axis] = -floor_to_integer(period.reach + f);
      high[period.axis] = floor_to_integer(period.reach - f);
      if (low[period.axis] > high[period.axis]) return false;
    }
    double nearest2 = std::numeric_limits<double>::infinity();
    const Vec3 d = positions_[j] - positions_[i];
    for (Integer a = low[0]; a <= high[0]; ++a) {
      for (Integer b = low[1]; b <= high[1]; ++b) {
        for (Integer c = low[2]; c <= high[2]; ++c) {
          const Vec3 image = ((d + static_cast<double>(a) * cell_[0]) + static_cast<double>(b) * cell_[1]) +
                             static_cast<double>(c) * cell_[2];
          nearest2 = std::min(nearest2, norm2(image));
        }
      }
    }
    return is_within(i, j, nearest2);
  }

  bool is_within(std::int32_t i, std::int32_t j, double distance2) const {
    const double limit2 = limit2_of(i, j), error = params_.cutoff_error();
    if (params_.tie_breaker == nullptr || limit2 < 0) return distance2 <= limit2;
    const double off = std::sqrt(distance2) - std::sqrt(limit2);
    return std::abs(off) <= error ? params_.tie_breaker->accepts(i, j) : off < 0;
  }

  bool is_excluded(std::int32_t i, std::int32_t j) const {
    return params_.exclusions != nullptr && params_.exclusions->excluded(i, j);
  }

  Span<const Vec3> positions_;
  const ListParams& params_;
  int types_;
  std::vector<double> limit2_;  ///< (cutoff + skin)^2 by pair of types; -1 where the cutoff is 0
  std::array<Vec3, 3> cell_;    ///< as given
  std::vector<Period> periods_;
};

}  // namespace

NeighborList all_pairs(Span<const Vec3> positions, const Box& box, const ListParams& params) {
  const Oracle oracle(positions, box, params);
  const auto n = static_cast<std::int32_t>(positions.size());
  std::vector<std::vector<std::int32_t>> rows(positions.size());
  for (std::int32_t i = 0; i < n; ++i) {
    for (std::int32_t j = i + 1; j < n; ++j) {
      if (!oracle.contains(i, j)) continue;
      rows[i].push_back(j);
      if (params.kind == ListKind::full && !oracle.is_ghost(j)) rows[j].push_back(i);
    }
  }
  NeighborList list;
  list.kind = params.kind;
  for (const auto& row : rows) {  // ascending: smaller neighbors came first, in order
    list.j.insert(list.j.end(), row.begin(), row.end());
    list.first.push_back(static_cast<std::int64_t>(list.j.size()));
  }
  return list;
}

std::vector<std::int32_t> all_neighbors(std::int32_t i, Span<const Vec3> positions, const Box& box,
                                        const ListParams& params) {
  const Oracle oracle(positions, box, params);
  if (i < 0 || static_cast<std::size_t>(i) >= positions.size()) {
    throw InvalidParameter("there is no particle " + std::to_string(i) + " among " +
                           std::to_string(positions.size()));
  }
  std::vector<std::int32_t> row;
  if (oracle.is_ghost(i)) return row;
  for (std::int32_t j = 0; j < static_cast<std::int32_t>(positions.size()); ++j) {
    if (j != i && oracle.contains(i, j)) row.push_back(j);
  }
  return row;
}

}  // namespace dch
