// SPDX-License-Identifier: MIT
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/geometry/box.hpp>
#include <dch/power_diagram/power_diagram.hpp>

namespace dch::necklace {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase =
    CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel,
                                                CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
/// Hidden balls are kept by us, not in cells: after motion those would hold old places.
using CellBase = CGAL::Regular_triangulation_cell_base_3<Kernel, CGAL::Triangulation_cell_base_3<Kernel>,
                                                         CGAL::Discard_hidden_points>;
using Triangulation =
    CGAL::Regular_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;
using Vertex = Triangulation::Vertex_handle;
using Cell = Triangulation::Cell_handle;
using WeightedPoint = Triangulation::Weighted_point;

WeightedPoint weighted(const Ball& ball) {
  return {Kernel::Point_3(ball.center.x, ball.center.y, ball.center.z), ball.radius * ball.radius};
}

bool same(const Ball& a, const Ball& b) { return a.center == b.center && a.radius == b.radius; }

/// Finite vertices that something wrong rests on.
using Blamed = std::vector<Vertex>;

}  // namespace

struct PowerDiagram::Impl {
  PowerDiagramParams params;
  PowerDiagramStats stats;
  Triangulation triangulation;
  std::vector<Ball> balls;
  std::vector<Vertex> vertex;  ///< by ball; null for a hidden one

  void build(Span<const Ball> to);
  bool repair(Span<const Ball> to);
  void put_vertices(Span<const Ball> at);
  std::vector<Blamed> faults() const;
  bool turned_over(Cell cell) const;
  bool irregular(Cell cell, int facet) const;
  std::vector<Blamed> faults_of_cells() const;
  std::vector<Blamed> faults_of_facets() const;
  std::vector<Blamed> faults_of_hull() const;
  Blamed blame(Cell cell, Vertex other) const;
  std::vector<std::int32_t> choose(std::vector<Blamed> faults) const;
  void insert(const std::vector<std::int32_t>& indices, Span<const Ball> at);
  void find_vertices();
};

void PowerDiagram::Impl::find_vertices() {
  std::fill(vertex.begin(), vertex.end(), Vertex());
  for (const Vertex v : triangulation.finite_vertex_handles()) {
    vertex[static_cast<std::size_t>(v->info())] = v;
  }
  stats.hidden = static_cast<std::int64_t>(vertex.size() - triangulation.number_of_vertices());
}

void PowerDiagram::Impl::insert(const std::vector<std::int32_t>& indices, Span<const Ball> at) {
  std::vector<std::pair<WeightedPoint, std::int32_t>> points;
  points.reserve(indices.size());
  for (const std::int32_t k : indices) points.emplace_back(weighted(at[static_cast<std::size_t>(k)]), k);
  triangulation.insert(points.begin(), points.end());
}

void PowerDiagram::Impl::build(Span<const Ball> to) {
  ++stats.builds;
  triangulation.clear();
  vertex.assign(to.size(), Vertex());
  std::vector<std::int32_t> all(to.size());
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<std::int32_t>(k);
  insert(all, to);
  find_vertices();
}

/// Moves vertices without a look at the triangulation.
void PowerDiagram::Impl::put_vertices(Span<const Ball> at) {
  for (std::size_t k = 0; k < vertex.size(); ++k) {
    if (vertex[k] != Vertex()) vertex[k]->set_point(weighted(at[k]));
  }
}

bool PowerDiagram::Impl::turned_over(Cell cell) const {
  if (triangulation.is_infinite(cell)) return false;
  return triangulation.geom_traits().orientation_3_object()(
             cell->vertex(0)->point().point(), cell->vertex(1)->point().point(),
             cell->vertex(2)->point().point(), cell->vertex(3)->point().point()) != CGAL::POSITIVE;
}

/// Whether the ball on the other side of a facet intersects that of the cell more than orthogonally. On the
/// hull, where both cells are infinite: whether it is not convex there.
bool PowerDiagram::Impl::irregular(Cell cell, int facet) const {
  const Vertex other = triangulation.tds().mirror_vertex(cell, facet);
  if (triangulation.is_infinite(other)) return false;
  return triangulation.side_of_power_sphere(cell, other->point()) == CGAL::ON_BOUNDED_SIDE;
}

/// The finite vertices of a cell, and another one unless it is null or infinite; in the order of their balls.
Blamed PowerDiagram::Impl::blame(Cell cell, Vertex other) const {
  Blamed blamed;
  for (int k = 0; k < 4; ++k) blamed.push_back(cell->vertex(k));
  if (other != Vertex()) blamed.push_back(other);
  blamed.erase(std::remove(blamed.begin(), blamed.end(), triangulation.infinite_vertex()), blamed.end());
  std::sort(blamed.begin(), blamed.end(), [](Vertex a, Vertex b) { return a->info() < b->info(); });
  return blamed;
}

std::vector<Blamed> PowerDiagram::Impl::faults_of_cells() const {
  std::vector<Blamed> result;
  for (const Cell cell : triangulation.all_cell_handles()) {
    if (turned_over(cell)) result.push_back(blame(cell, Vertex()));
  }
  return result;
}

std::vector<Blamed> PowerDiagram::Impl::faults_of_facets() const {
  std::vector<Blamed> result;
  for (const auto& [cell, facet] : triangulation.all_facets()) {
    const Cell next = cell->neighbor(facet);
    // From a finite cell, if there is one.
    const bool from_next = triangulation.is_infinite(cell) && !triangulation.is_infinite(next);
    const Cell from = from_next ? next : cell;
    const int side = from_next ? next->index(cell) : facet;
    if (irregular(from, side)) result.push_back(blame(from, triangulation.tds().mirror_vertex(from, side)));
  }
  return result;
}

/// A hull that is convex at each edge may still go around a vertex, or around itself, more than once, as a
/// pentagram does, and the tetrahedra with it. Seen from a point that all facets turn the same side to, a
/// closed surface covers each direction equally often; so the hull is that of a convex body if it covers one
/// direction once (Mehlhorn et al., Checking geometric programs or verification of geometric structures,
/// Comput. Geom. 12:85, 1999). Then no point inside is covered twice either.
std::vector<Blamed> PowerDiagram::Impl::faults_of_hull() const {
  const auto orientation = triangulation.geom_traits().orientation_3_object();
  std::vector<Cell> outside;
  triangulation.incident_cells(triangulation.infinite_vertex(), std::back_inserter(outside));
  CGAL::Vector_3<Kernel> sum = CGAL::NULL_VECTOR;
  for (const Vertex v : triangulation.finite_vertex_handles())
    sum = sum + (v->point().point() - CGAL::ORIGIN);
  const auto center = CGAL::ORIGIN + sum / static_cast<double>(triangulation.number_of_vertices());
  std::vector<Blamed> turned_away, covering;
  std::optional<Kernel::Point_3> target;  // of the ray from the center
  for (const Cell cell : outside) {
    const int infinite = cell->index(triangulation.infinite_vertex());
    std::array<Kernel::Point_3, 3> corner;
    for (int k = 0; k < 3; ++k) {
      corner[static_cast<std::size_t>(k)] =
          cell->vertex(Triangulation::vertex_triple_index(infinite, k))->point().point();
    }
    const auto& [p, q, r] = corner;
    const CGAL::Sign inside =
        orientation(p, q, r, triangulation.tds().mirror_vertex(cell, infinite)->point().point());
    if (orientation(p, q, r, center) != inside) turned_away.push_back(blame(cell, Vertex()));
    if (!target) target = CGAL::centroid(p, q, r);
    const auto turns_away = [&](const Kernel::Point_3& a, const Kernel::Point_3& b) {
      return orientation(a, b, *target, center) == -inside;
    };
    if (!turns_away(p, q) && !turns_away(q, r) && !turns_away(r, p))
      covering.push_back(blame(cell, Vertex()));
  }
  if (!turned_away.empty()) return turned_away;
  return covering.size() == 1 ? std::vector<Blamed>() : covering;
}

/// What keeps the triangulation, with its vertices where they are now, from being regular. The tests of
/// facets take all tetrahedra for well oriented, and that of the hull takes all facets for regular.
std::vector<Blamed> PowerDiagram::Impl::faults() const {
  std::vector<Blamed> result = faults_of_cells();
  if (result.empty()) result = faults_of_facets();
  if (result.empty()) result = faults_of_hull();
  return result;
}

/// Indices of few balls that are part of all faults: greedily those that most faults blame. The choice goes
/// by the balls' indices, since the order of faults is that of addresses.
std::vector<std::int32_t> PowerDiagram::Impl::choose(std::vector<Blamed> faults) const {
  std::vector<int> blame(vertex.size(), 0);
  std::vector<char> chosen(vertex.size(), 0);
  const auto slot = [](Vertex v) { return static_cast<std::size_t>(v->info()); };
  std::sort(faults.begin(), faults.end(), [](const Blamed& a, const Blamed& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(),
                                        [](Vertex u, Vertex v) { return u->info() < v->info(); });
  });
  for (const Blamed& fault : faults) {
    for (const Vertex v : fault) ++blame[slot(v)];
  }
  std::vector<std::int32_t> result;
  for (const Blamed& fault : faults) {
    if (std::any_of(fault.begin(), fault.end(), [&](Vertex v) { return chosen[slot(v)] != 0; })) continue;
    const Vertex worst = *std::max_element(
        fault.begin(), fault.end(), [&](Vertex a, Vertex b) { return blame[slot(a)] < blame[slot(b)]; });
    chosen[slot(worst)] = 1;
    result.push_back(worst->info());
  }
  return result;
}

/// False if that is not worth while; the triangulation is of no use then.
bool PowerDiagram::Impl::repair(Span<const Ball> to) {
  std::vector<std::int32_t> outside;
  for (std::size_t k = 0; k < vertex.size(); ++k) {
    if (vertex[k] == Vertex()) outside.push_back(static_cast<std::int32_t>(k));
  }
  const double most = params.most_removed * static_cast<double>(vertex.size());
  std::size_t removed = 0;
  for (;;) {
    put_vertices(to);
    auto wrong = faults();
    if (wrong.empty()) break;
    const auto chosen = choose(std::move(wrong));
    removed += chosen.size();
    if (static_cast<double>(removed) > most) return false;
    put_vertices(balls);
    for (const std::int32_t k : chosen) {
      triangulation.remove(vertex[static_cast<std::size_t>(k)]);
      vertex[static_cast<std::size_t>(k)] = Vertex();
      outside.push_back(k);
    }
    if (triangulation.dimension() < 3) return false;
  }
  insert(outside, to);
  find_vertices();
  ++stats.repairs;
  stats.removed += static_cast<std::int64_t>(removed);
  return true;
}

PowerDiagram::PowerDiagram(const PowerDiagramParams& params) : impl_(std::make_unique<Impl>()) {
  if (!(params.most_removed >= 0 && params.most_removed <= 1)) {
    throw InvalidParameter("most_removed is " + std::to_string(params.most_removed) +
                           "; it is a share of the balls, 0 .. 1");
  }
  impl_->params = params;
}

PowerDiagram::~PowerDiagram() = default;
PowerDiagram::PowerDiagram(PowerDiagram&&) noexcept = default;
PowerDiagram& PowerDiagram::operator=(PowerDiagram&&) noexcept = default;

void PowerDiagram::update(Span<const Ball> balls) {
  for (std::size_t k = 0; k < balls.size(); ++k) {
    const Ball& ball = balls[k];
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(ball.center[axis]) <= kMaxCoordinate) continue;
      throw InvalidPosition("ball " + std::to_string(k) + " has the coordinate " +
                            std::to_string(ball.center[axis]) + ", which is not finite or beyond " +
                            std::to_string(kMaxCoordinate));
    }
  }
  ++impl_->stats.updates;
  const bool kept = balls.size() == impl_->balls.size() && impl_->triangulation.dimension() == 3;
  if (!kept || !impl_->repair(balls)) impl_->build(balls);
  impl_->balls.assign(balls.begin(), balls.end());
}

std::vector<IndexPair> PowerDiagram::edges() const {
  std::vector<IndexPair> result;
  for (const auto& [cell, i, j] : impl_->triangulation.finite_edges()) {
    const std::int32_t a = cell->vertex(i)->info(), b = cell->vertex(j)->info();
    result.push_back({std::min(a, b), std::max(a, b)});
  }
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<IndexPair> PowerDiagram::coincident() const {
  std::vector<IndexPair> result;
  if (impl_->stats.hidden == 0) return result;
  for (std::size_t k = 0; k < impl_->balls.size(); ++k) {
    if (impl_->vertex[k] != Vertex()) continue;
    const Ball& ball = impl_->balls[k];
    const Vertex nearest = impl_->triangulation.nearest_power_vertex(weighted(ball).point());
    if (nearest == Vertex() || !same(ball, impl_->balls[static_cast<std::size_t>(nearest->info())])) continue;
    result.push_back({static_cast<std::int32_t>(k), nearest->info()});
  }
  return result;
}

const PowerDiagramStats& PowerDiagram::stats() const { return impl_->stats; }

bool PowerDiagram::is_valid() const { return impl_->triangulation.is_valid(); }

}  // namespace dch::necklace
