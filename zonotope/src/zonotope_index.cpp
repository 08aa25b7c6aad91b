// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/zonotope/membership.hpp>
#include <dch/zonotope/norm.hpp>
#include <dch/zonotope/zonotope_index.hpp>

#include "index_cells.hpp"
#include "membership_question.hpp"
#include "predicates.hpp"
#include "vectors.hpp"

namespace dch::zonotope {
namespace {

/// By angles that are no simple ones, so that hardly any generator's line is vertical or at infinity.
Vec3 turned(Vec3 v) {
  const double c = std::cos(0.9), s = std::sin(0.9), d = std::cos(1.3), t = std::sin(1.3);
  const Vec3 w{c * v.x - s * v.y, s * v.x + c * v.y, v.z};
  return {d * w.x - t * w.z, w.y, t * w.x + d * w.z};
}

}  // namespace

struct ZonotopeIndex::Impl {
  Zonotope z;
  IndexCells cells;
  mutable IndexStats stats;

  double largest_ratio(Vec3 x) const;
  double in_cell(IndexCells::Place place, Vec3 x) const;
  double search(Vec3 x) const {
    ++stats.searches;
    stats.operations += static_cast<std::int64_t>(cells.generators.size());
    return dch::zonotope::norm({{}, cells.generators}, x);
  }
};

/// The quotient at the best normal of a cell, by the search of Theorem 3.5.2 with the generators that cross
/// it; those that do not add up to one more. Outside of the cell that is less than h, so that what is found
/// there does not count.
double ZonotopeIndex::Impl::in_cell(IndexCells::Place place, Vec3 x) const {
  const IndexCells::Cell& cell = cells.cell(place);
  Question question;
  question.point = x;
  for (const std::size_t k : cell.generators) question.generators.push_back(cells.generators[k]);
  if (cell.gradient != Vec3{}) question.generators.push_back(cell.gradient);
  stats.operations += static_cast<std::int64_t>(question.generators.size());
  const MetFacet met = facet_towards(question);
  stats.operations += met.operations;
  // A reach of nothing comes from generators that do not span space, outside of the cell as well.
  Vec3 sizes;
  for (const Vec3& u : question.generators) sizes = sizes + magnitudes(u);
  const bool is_there =
      met.support > 1e-9 * dot(magnitudes(met.normal), sizes) && cells.holds(place, met.normal);
  return is_there ? met.height / met.support : -kInfinite;
}

/// max (n . x) / h(n) over the normals with positive z.
double ZonotopeIndex::Impl::largest_ratio(Vec3 x) const {
  const IndexCells::Place place = cells.find(x, stats.operations);
  return place.is_nowhere() ? -kInfinite : in_cell(place, x);
}

ZonotopeIndex::ZonotopeIndex(const Zonotope& z, std::int64_t memory) : impl_(std::make_unique<Impl>()) {
  impl_->z = z;
  std::vector<Vec3> generators;
  const std::vector<Vec3> given = canonical(z).generators;
  generators.reserve(given.size());
  for (const Vec3& v : given) generators.push_back(turned(v));
  const auto n = static_cast<std::int64_t>(generators.size());
  if (!span_space(given))
    throw InvalidParameter(
        "the " + std::to_string(n) +
        " directions of generators do not span space, so that there is no index; use contains()");
  const std::int64_t strips = std::clamp(memory / n, std::int64_t{1}, n);
  impl_->cells.build(std::move(generators), static_cast<std::size_t>(strips));
}
ZonotopeIndex::ZonotopeIndex(ZonotopeIndex&&) noexcept = default;
ZonotopeIndex& ZonotopeIndex::operator=(ZonotopeIndex&&) noexcept = default;
ZonotopeIndex::~ZonotopeIndex() = default;

double ZonotopeIndex::norm(Vec3 x) const {
  check(Zonotope{x, {}});
  if (x == Vec3{}) return 0;
  ++impl_->stats.queries;
  // A normal with negative z is the opposite of one with positive z for the opposite vector.
  const Vec3 y = turned(x);
  const double found = std::max(impl_->largest_ratio(y), impl_->largest_ratio(-1.0 * y));
  return found > 0 && std::isfinite(found) ? found : impl_->search(y);
}

bool ZonotopeIndex::contains(Vec3 point) const {
  check(Zonotope{point, {}});
  const double size = norm(point - impl_->z.center);
  if (std::abs(size - 1) > 1e-9) return size < 1;
  ++impl_->stats.searches;
  impl_->stats.operations += static_cast<std::int64_t>(impl_->cells.generators.size());
  return dch::zonotope::contains(impl_->z, point);
}

std::int64_t ZonotopeIndex::entries() const { return impl_->cells.entries; }
const IndexStats& ZonotopeIndex::stats() const { return impl_->stats; }

}  // namespace dch::zonotope
