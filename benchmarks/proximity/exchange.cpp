// SPDX-License-Identifier: MIT
//
// Insertion, removal and nearest point in turn, at random places of a cube of uniform points, beside
// nanoflann's dynamic adaptor. Arguments: the number of points, and how often each of the three is done. An
// item is one of the three. Counters of hierarchies: what queries looked at in the last tenth.
#include <algorithm>
#include <benchmark/benchmark.h>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <nanoflann.hpp>
#include <random>
#include <vector>

#include <dch/hierarchy/hierarchy.hpp>
#include <dch/proximity/kept_nearest.hpp>
#include <dch/proximity/nearest.hpp>

namespace dch::bench {
namespace {

struct Cloud {
  std::vector<Vec3> points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t k, std::size_t axis) const { return points[k][static_cast<int>(axis)]; }
  template <class Bounds>
  bool kdtree_get_bbox(Bounds&) const {
    return false;
  }
};
using DynamicTree = nanoflann::KDTreeSingleIndexDynamicAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>,
                                                               Cloud, 3, std::uint32_t>;

/// The same places and the same removals for both, drawn before.
struct Course {
  Course(std::int64_t points, std::int64_t times) {
    std::mt19937_64 engine(1);
    const double side = std::cbrt(static_cast<double>(points));
    const auto uniform = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
    const auto somewhere = [&] { return Vec3{side * uniform(), side * uniform(), side * uniform()}; };
    for (std::int64_t k = 0; k < points; ++k) start.push_back(somewhere());
    for (std::int64_t k = 0; k < times; ++k) {
      added.push_back(somewhere());
      asked.push_back(somewhere());
      removed.push_back(static_cast<std::size_t>(uniform() * static_cast<double>(points + 1)));
    }
  }
  std::vector<Vec3> start, added, asked;
  std::vector<std::size_t> removed;  ///< places in the list of the points that there are
};

/// Calls insert(k), remove(name) and query(k) in turn. Names are what insert() returns, first those of the
/// start.
template <class Name, class Insert, class Remove, class Query>
void follow(const Course& course, const Insert& insert, const Remove& remove, const Query& query) {
  std::vector<Name> there(course.start.size());
  for (std::size_t k = 0; k < there.size(); ++k) there[k] = static_cast<Name>(k);
  for (std::size_t k = 0; k < course.added.size(); ++k) {
    there.push_back(insert(k));
    std::swap(there[course.removed[k]], there.back());
    remove(there.back());
    there.pop_back();
    query(k);
  }
}

Hierarchy hierarchy_of(const Course& course) {
  HierarchyParams params;
  params.radius = 1.5;
  Hierarchy points(params);
  points.build(course.start, Box::none());
  return points;
}

void hierarchy(benchmark::State& state) {
  const Course course(state.range(0), state.range(1));
  double sum = 0;
  NearestWork work;
  const std::size_t late = course.asked.size() - course.asked.size() / 10;
  for (auto _ : state) {
    state.PauseTiming();
    Hierarchy points = hierarchy_of(course);
    points.kept_view();
    NearestRows row;
    work = {};
    state.ResumeTiming();
    follow<std::int32_t>(
        course, [&](std::size_t k) { return points.insert(course.added[k]); },
        [&](std::int32_t id) { points.remove(id); },
        [&](std::size_t k) {
          Nearest(points.kept_view()).of_positions({&course.asked[k], 1}, {}, row);
          sum += row.distance2[0];
          if (k < late) return;
          work.nodes += row.work.nodes;
          work.blocks += row.work.blocks;
          work.points += row.work.points;
        });
  }
  const auto queries = static_cast<double>(course.asked.size() - late);
  state.counters["balls"] = static_cast<double>(work.nodes) / queries;
  state.counters["boxes"] = static_cast<double>(work.blocks) / queries;
  state.counters["points"] = static_cast<double>(work.points) / queries;
  state.counters["sum"] = sum / static_cast<double>(state.iterations());
  state.SetItemsProcessed(3 * state.iterations() * state.range(1));
}

/// The same with a grid, whose upkeep is part of the time.
void kept_nearest(benchmark::State& state) {
  const Course course(state.range(0), state.range(1));
  double sum = 0;
  KeptNearestWork work;
  for (auto _ : state) {
    state.PauseTiming();
    Hierarchy points = hierarchy_of(course);
    KeptNearest kept;
    kept.update(points.kept_view());
    NearestRows row;
    std::int32_t changed[2] = {};
    state.ResumeTiming();
    follow<std::int32_t>(
        course, [&](std::size_t k) { return changed[0] = points.insert(course.added[k]); },
        [&](std::int32_t id) { points.remove(changed[1] = id); },
        [&](std::size_t k) {
          kept.update(points.kept_view(), {changed, 2});
          kept.of_positions({&course.asked[k], 1}, {}, row);
          sum += row.distance2[0];
        });
    work = kept.work();
  }
  state.counters["descents"] = static_cast<double>(work.descents);
  state.counters["grids"] = static_cast<double>(work.grids);
  state.counters["sum"] = sum / static_cast<double>(state.iterations());
  state.SetItemsProcessed(3 * state.iterations() * state.range(1));
}

void nanoflann_dynamic(benchmark::State& state) {
  const Course course(state.range(0), state.range(1));
  double sum = 0;
  for (auto _ : state) {
    state.PauseTiming();
    Cloud cloud{course.start};
    cloud.points.reserve(course.start.size() + course.added.size());
    auto tree = std::make_unique<DynamicTree>(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(10),
                                              course.start.size() + course.added.size());
    state.ResumeTiming();
    follow<std::uint32_t>(
        course,
        [&](std::size_t k) {
          const auto name = static_cast<std::uint32_t>(cloud.points.size());
          cloud.points.push_back(course.added[k]);
          tree->addPoints(name, name);
          return name;
        },
        [&](std::uint32_t name) { tree->removePoint(name); },
        [&](std::size_t k) {
          std::size_t index = 0;
          double distance2 = 0;
          nanoflann::KNNResultSet<double> nearest(1);
          nearest.init(&index, &distance2);
          const Vec3 at = course.asked[k];
          const double query[3] = {at.x, at.y, at.z};
          tree->findNeighbors(nearest, query, nanoflann::SearchParams());
          sum += distance2;
        });
  }
  state.counters["sum"] = sum / static_cast<double>(state.iterations());
  state.SetItemsProcessed(3 * state.iterations() * state.range(1));
}

#define DCH_RUNS                 \
  Args({2000, 2000})             \
      ->Args({1000000, 100000})  \
      ->Args({1000000, 300000})  \
      ->Args({1000000, 1000000}) \
      ->Unit(benchmark::kMillisecond)
BENCHMARK(hierarchy)->DCH_RUNS;
BENCHMARK(kept_nearest)->DCH_RUNS;
BENCHMARK(nanoflann_dynamic)->DCH_RUNS;

}  // namespace
}  // namespace dch::bench

BENCHMARK_MAIN();
