// SPDX-License-Identifier: MIT
//
// The nearest other points of each of many uniform points in an open box, after a hundredth of them has moved
// and as they were, beside nanoflann's tree, built anew and asked alone. Arguments: the number of points, and
// how many nearest ones of each. A time is that of all points.
#include <algorithm>
#include <benchmark/benchmark.h>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nanoflann.hpp>
#include <optional>
#include <random>
#include <vector>

#include <dch/hierarchy/hierarchy.hpp>
#include <dch/proximity/nearest.hpp>

namespace dch::bench {
namespace {

/// One point in a unit of volume.
struct Scene {
  explicit Scene(std::int64_t points) : side(std::cbrt(static_cast<double>(points))) {
    for (std::int64_t k = 0; k < points; ++k) positions.push_back(somewhere());
  }
  Vec3 somewhere() { return {side * uniform(), side * uniform(), side * uniform()}; }
  double uniform() { return static_cast<double>(random() >> 11) * 0x1p-53; }
  void move_one_in_a_hundred() {
    for (std::size_t k = 0; k < positions.size() / 100; ++k)
      positions[random() % positions.size()] = somewhere();
  }
  std::size_t kdtree_get_point_count() const { return positions.size(); }
  double kdtree_get_pt(std::size_t k, std::size_t axis) const { return positions[k][static_cast<int>(axis)]; }
  template <class Bounds>
  bool kdtree_get_bbox(Bounds&) const {
    return false;
  }
  std::mt19937_64 random{1};
  double side;
  std::vector<Vec3> positions;
};
using Tree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Scene>, Scene, 3, std::uint32_t>;

/// Squared distances of the k nearest points of each, in order, the point itself first.
class TreeNearest {
 public:
  TreeNearest(const Scene& scene, std::size_t k) : scene_(scene), k_(k + 1), ids_(k_), distances2_(k_) {}
  void build() { tree_.emplace(3, scene_, nanoflann::KDTreeSingleIndexAdaptorParams(10)); }
  const std::vector<double>& of(std::size_t point) {
    nanoflann::KNNResultSet<double, std::uint32_t> nearest(k_);
    nearest.init(ids_.data(), distances2_.data());
    const Vec3 at = scene_.positions[point];
    const double query[3] = {at.x, at.y, at.z};
    tree_->findNeighbors(nearest, query, nanoflann::SearchParams());
    return distances2_;
  }
  void ask_all() {
    for (std::size_t point = 0; point < scene_.positions.size(); ++point)
      benchmark::DoNotOptimize(of(point).back());
  }

 private:
  const Scene& scene_;
  std::size_t k_;
  std::optional<Tree> tree_;
  std::vector<std::uint32_t> ids_;
  std::vector<double> distances2_;
};

Hierarchy hierarchy_of(const Scene& scene) {
  HierarchyParams params;
  params.radius = 1.5;
  Hierarchy made(params);
  made.build(scene.positions, Box::none());
  return made;
}

NearestParams nearest_of(const benchmark::State& state) {
  NearestParams params;
  params.k = static_cast<std::int32_t>(state.range(1));
  return params;
}

void check(benchmark::State& state, const Scene& scene, const NearestRows& rows) {
  const auto k = static_cast<std::size_t>(rows.k);
  TreeNearest tree(scene, k);
  tree.build();
  for (std::size_t point = 0; point < scene.positions.size(); point += 97) {
    const std::vector<double>& expected = tree.of(point);
    for (std::size_t j = 0; j < k; ++j)
      if (std::abs(rows.distance2[point * k + j] - expected[j + 1]) > 1e-9 * expected[j + 1])
        state.SkipWithError("another point is nearer");
  }
}

void hierarchy_after_motion(benchmark::State& state) {
  Scene scene(state.range(0));
  Hierarchy hierarchy = hierarchy_of(scene);
  NearestRows rows;
  for (auto _ : state) {
    state.PauseTiming();
    scene.move_one_in_a_hundred();
    state.ResumeTiming();
    hierarchy.update(scene.positions, Box::none());
    Nearest(hierarchy.view()).of_points(nearest_of(state), rows);
  }
  check(state, scene, rows);
}

void hierarchy_alone(benchmark::State& state) {
  const Scene scene(state.range(0));
  Hierarchy hierarchy = hierarchy_of(scene);
  NearestRows rows;
  for (auto _ : state) Nearest(hierarchy.view()).of_points(nearest_of(state), rows);
  check(state, scene, rows);
}

void nanoflann_built_anew(benchmark::State& state) {
  Scene scene(state.range(0));
  TreeNearest tree(scene, static_cast<std::size_t>(state.range(1)));
  for (auto _ : state) {
    tree.build();
    tree.ask_all();
  }
}

void nanoflann_alone(benchmark::State& state) {
  const Scene scene(state.range(0));
  TreeNearest tree(scene, static_cast<std::size_t>(state.range(1)));
  tree.build();
  for (auto _ : state) tree.ask_all();
}

#define DCH_RUNS ArgsProduct({{2000, 1000000}, {1, 12}})->Unit(benchmark::kMillisecond)
BENCHMARK(hierarchy_after_motion)->DCH_RUNS;
BENCHMARK(nanoflann_built_anew)->DCH_RUNS;
BENCHMARK(hierarchy_alone)->DCH_RUNS;
BENCHMARK(nanoflann_alone)->DCH_RUNS;

}  // namespace
}  // namespace dch::bench

BENCHMARK_MAIN();
