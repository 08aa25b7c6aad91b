// SPDX-License-Identifier: MIT
//
// The closest pair of points of which a few move in each step, or all a little: kept up, and found anew by a
// tree that is built in each step, of this library or of nanoflann; and the tree of points itself, kept up.
#include <benchmark/benchmark.h>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include <dch/hierarchy/hierarchy.hpp>
#include <dch/proximity/kept_closest_pair.hpp>
#include <dch/proximity/nearest.hpp>

#ifdef DCH_WITH_NANOFLANN
#include <nanoflann.hpp>
#endif

namespace dch {
namespace {

/// Uniform points, one in a unit of volume, in an open box, which nanoflann knows too.
struct Scene {
  explicit Scene(std::int64_t points) : side(std::cbrt(static_cast<double>(points))) {
    for (std::int64_t k = 0; k < points; ++k) positions.push_back(somewhere());
  }
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  }
  Vec3 somewhere() { return {uniform(0, side), uniform(0, side), uniform(0, side)}; }
  std::int32_t any() { return static_cast<std::int32_t>(random() % positions.size()); }
  void move(std::int64_t points) {
    moved.clear();
    for (std::int64_t k = 0; k < points; ++k) {
      moved.push_back(any());
      positions[static_cast<std::size_t>(moved.back())] = somewhere();
    }
  }
  void shake(double most) {
    for (Vec3& p : positions) p = p + Vec3{uniform(-most, most), uniform(-most, most), uniform(-most, most)};
  }
  Hierarchy hierarchy() const {
    HierarchyParams params;
    params.radius = 1.5;
    Hierarchy made(params);
    made.build(positions, Box::none());
    return made;
  }

  std::mt19937_64 random{1};
  double side;
  std::vector<Vec3> positions;
  std::vector<std::int32_t> moved;
};

void check(benchmark::State& state, Hierarchy& hierarchy, const ClosestPoints& found) {
  const ClosestPoints expected = closest_pair(PointTree(hierarchy.view()));
  if (found.a != expected.a || found.b != expected.b || found.distance2 != expected.distance2)
    state.SkipWithError("another pair is closer");
}

void note_work(benchmark::State& state, const KeptClosestWork& work) {
  state.counters["asked"] =
      benchmark::Counter(static_cast<double>(work.asked), benchmark::Counter::kAvgIterations);
}

/// Points go and come again elsewhere, under the same ids, which are free then.
void exchange(Scene& scene, Hierarchy& hierarchy, std::int64_t points) {
  scene.move(points);
  for (const std::int32_t id : scene.moved) {
    hierarchy.remove(id);
    hierarchy.insert(scene.positions[static_cast<std::size_t>(id)]);
  }
}

void kept_exchange(benchmark::State& state) {
  Scene scene(state.range(0));
  Hierarchy hierarchy = scene.hierarchy();
  KeptClosestPair kept;
  ClosestPoints found = kept.find(hierarchy.view());
  hierarchy.kept_view();
  exchange(scene, hierarchy, 1);  // arrays grow
  kept.find(hierarchy.kept_view());
  for (auto _ : state) {
    exchange(scene, hierarchy, state.range(1));
    found = kept.find(hierarchy.kept_view(), scene.moved);
  }
  note_work(state, kept.work());
  check(state, hierarchy, found);
}
BENCHMARK(kept_exchange)
    ->ArgsProduct({{2000, 100000}, {1, 10, 100, 1000}})
    ->Args({1000000, 100})
    ->Unit(benchmark::kMicrosecond);

/// The same without questions.
void exchange_alone(benchmark::State& state) {
  Scene scene(state.range(0));
  Hierarchy hierarchy = scene.hierarchy();
  hierarchy.kept_view();
  for (auto _ : state) exchange(scene, hierarchy, state.range(1));
}
BENCHMARK(exchange_alone)->ArgsProduct({{2000, 100000}, {1, 1000}})->Unit(benchmark::kMicrosecond);

/// New positions of all are handed in, of which as many are others.
void kept_update(benchmark::State& state) {
  Scene scene(state.range(0));
  Hierarchy hierarchy = scene.hierarchy();
  KeptClosestPair kept;
  ClosestPoints found = kept.find(hierarchy.view());
  for (auto _ : state) {
    scene.move(state.range(1));
    hierarchy.update(scene.positions, Box::none());
    found = kept.find(hierarchy.view());
  }
  note_work(state, kept.work());
  check(state, hierarchy, found);
}
BENCHMARK(kept_update)->ArgsProduct({{2000, 100000}, {100, 1000, 10000}})->Unit(benchmark::kMicrosecond);

/// All points move by this many ten thousandths of the mean distance of neighbors at most.
void kept_shake(benchmark::State& state) {
  Scene scene(state.range(0));
  Hierarchy hierarchy = scene.hierarchy();
  KeptClosestPair kept;
  ClosestPoints found = kept.find(hierarchy.view());
  for (auto _ : state) {
    scene.shake(1e-4 * static_cast<double>(state.range(1)));
    hierarchy.update(scene.positions, Box::none());
    found = kept.find(hierarchy.view());
  }
  note_work(state, kept.work());
  check(state, hierarchy, found);
}
BENCHMARK(kept_shake)->ArgsProduct({{2000, 100000}, {1, 10, 100}})->Unit(benchmark::kMicrosecond);

/// The update alone, which the figures above have in them.
void update_alone(benchmark::State& state) {
  Scene scene(state.range(0));
  Hierarchy hierarchy = scene.hierarchy();
  for (auto _ : state) {
    scene.shake(1e-4 * static_cast<double>(state.range(1)));
    hierarchy.update(scene.positions, Box::none());
    benchmark::DoNotOptimize(hierarchy.view());
  }
}
BENCHMARK(update_alone)->ArgsProduct({{2000, 100000}, {10}})->Unit(benchmark::kMicrosecond);

void rebuilt_hierarchy(benchmark::State& state) {
  Scene scene(state.range(0));
  Hierarchy hierarchy = scene.hierarchy();
  for (auto _ : state) {
    scene.move(100);
    hierarchy.build(scene.positions, Box::none());
    benchmark::DoNotOptimize(closest_pair(PointTree(hierarchy.view())));
  }
}
BENCHMARK(rebuilt_hierarchy)->Arg(2000)->Arg(100000)->Unit(benchmark::kMicrosecond);

/// Of a hierarchy that is kept up: the tree of points and its search alone.
void rebuilt_tree(benchmark::State& state) {
  const Scene scene(state.range(0));
  Hierarchy hierarchy = scene.hierarchy();
  for (auto _ : state) benchmark::DoNotOptimize(PointTree(hierarchy.view()).nodes().size());
}
BENCHMARK(rebuilt_tree)->Arg(2000)->Arg(100000)->Unit(benchmark::kMicrosecond);

void check_tree(benchmark::State& state, Hierarchy& hierarchy, const PointTree& tree) {
  const ClosestPoints found = closest_pair(tree), expected = closest_pair(PointTree(hierarchy.view()));
  if (found.a != expected.a || found.b != expected.b || tree.node(0).points != state.range(0))
    state.SkipWithError("the tree is another one");
}

/// The tree kept up, told which points come and go: without the exchange.
void kept_tree_exchange(benchmark::State& state) {
  Scene scene(state.range(0));
  Hierarchy hierarchy = scene.hierarchy();
  PointTree tree(hierarchy.view());
  for (auto _ : state) {
    state.PauseTiming();
    exchange(scene, hierarchy, state.range(1));
    const HierarchyView view = hierarchy.kept_view();
    state.ResumeTiming();
    tree.update(view, scene.moved);
  }
  check_tree(state, hierarchy, tree);
}
BENCHMARK(kept_tree_exchange)
    ->ArgsProduct({{2000, 100000}, {1, 10, 100, 1000}})
    ->Unit(benchmark::kMicrosecond);

/// The same where positions of all points are looked at, and all have moved by so many ten thousandths of the
/// mean distance of neighbors at most.
void kept_tree_shake(benchmark::State& state) {
  Scene scene(state.range(0));
  Hierarchy hierarchy = scene.hierarchy();
  PointTree tree(hierarchy.view());
  for (auto _ : state) {
    state.PauseTiming();
    scene.shake(1e-4 * static_cast<double>(state.range(1)));
    hierarchy.update(scene.positions, Box::none());
    const HierarchyView view = hierarchy.view();
    state.ResumeTiming();
    tree.update(view);
  }
  state.counters["builds"] = static_cast<double>(tree.work().builds);
  check_tree(state, hierarchy, tree);
}
BENCHMARK(kept_tree_shake)->ArgsProduct({{2000, 100000}, {1, 10, 100}})->Unit(benchmark::kMicrosecond);

void search_of_tree(benchmark::State& state) {
  const Scene scene(state.range(0));
  Hierarchy hierarchy = scene.hierarchy();
  const PointTree tree(hierarchy.view());
  for (auto _ : state) benchmark::DoNotOptimize(closest_pair(tree));
}
BENCHMARK(search_of_tree)->Arg(2000)->Arg(100000)->Unit(benchmark::kMicrosecond);

#ifdef DCH_WITH_NANOFLANN
struct Cloud {
  const std::vector<Vec3>& points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t k, std::size_t axis) const { return points[k][static_cast<int>(axis)]; }
  template <class Bounds>
  bool kdtree_get_bbox(Bounds&) const {
    return false;
  }
};

/// The tree is built, and the nearest other point of each is asked for.
void rebuilt_nanoflann(benchmark::State& state) {
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3,
                                                   std::uint32_t>;
  Scene scene(state.range(0));
  double least2 = 0;
  for (auto _ : state) {
    scene.move(100);
    const Cloud cloud{scene.positions};
    const Tree tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(10));
    least2 = std::numeric_limits<double>::infinity();
    for (const Vec3& p : scene.positions) {
      std::uint32_t ids[2] = {};
      double squares[2] = {};
      tree.knnSearch(&p.x, 2, ids, squares);
      least2 = std::min(least2, squares[1]);
    }
  }
  Hierarchy hierarchy = scene.hierarchy();
  if (std::abs(closest_pair(PointTree(hierarchy.view())).distance2 / least2 - 1) > 1e-12)
    state.SkipWithError("another pair is closer");
}
BENCHMARK(rebuilt_nanoflann)->Arg(2000)->Arg(100000)->Unit(benchmark::kMicrosecond);
#endif

}  // namespace
}  // namespace dch

BENCHMARK_MAIN();
