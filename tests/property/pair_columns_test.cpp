// SPDX-License-Identifier: MIT
//
// Pairs in columns against brute force over images, in every kind of box, with cutoffs below half the cell
// and above.
#include <algorithm>
#include <array>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numeric>
#include <tuple>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/base/executor.hpp>
#include <dch/engines/pair_columns.hpp>

#include "effort.hpp"
#include "neighbor_pairs_oracle.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

using images::brute_force;
using images::displacement;
using images::Pair;
using images::Scene;
using Shift = NeighborPairs::Shift;

/// All columns, and memory behind them that nobody may touch.
struct Arrays {
  static constexpr std::int64_t kUntouched = -77;

  PairColumns columns(std::int64_t pairs) {
    ++calls;
    const auto n = static_cast<std::size_t>(pairs) + 1;
    i.assign(n, kUntouched), j.assign(n, kUntouched);
    shift.assign(n, {kUntouched, kUntouched, kUntouched});
    distance.assign(n, kUntouched), displacement.assign(n, {kUntouched, kUntouched, kUntouched});
    single_distance.assign(n, kUntouched),
        single_displacement.assign(n, {kUntouched, kUntouched, kUntouched});
    return {i.data(),
            j.data(),
            shift.data(),
            distance.data(),
            displacement.data(),
            single_distance.data(),
            single_displacement.data()};
  }
  MakeColumns maker() {
    return [this](std::int64_t pairs) { return columns(pairs); };
  }

  int calls = 0;
  std::vector<std::int64_t> i, j;
  std::vector<std::array<std::int64_t, 3>> shift;
  std::vector<double> distance;
  std::vector<Vec3> displacement;
  std::vector<float> single_distance;
  std::vector<std::array<float, 3>> single_displacement;
};

/// Every column of pair k, from the first one on.
std::vector<Pair> checked_pairs(const Arrays& a, std::int64_t count, const Scene& scene) {
  std::vector<Pair> pairs;
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    EXPECT_TRUE(k == 0 || a.i[k - 1] <= a.i[k]) << "not sorted at " << k;
    const auto i = static_cast<std::int32_t>(a.i[k]), j = static_cast<std::int32_t>(a.j[k]);
    const Shift s{static_cast<std::int32_t>(a.shift[k][0]), static_cast<std::int32_t>(a.shift[k][1]),
                  static_cast<std::int32_t>(a.shift[k][2])};
    const Vec3 d = displacement(scene.points[static_cast<std::size_t>(i)],
                                scene.points[static_cast<std::size_t>(j)], scene.box, s);
    EXPECT_EQ(a.displacement[k], d) << i << " " << j;
    EXPECT_EQ(a.distance[k], std::sqrt(norm2(d)));
    EXPECT_EQ(a.single_distance[k], static_cast<float>(a.distance[k]));
    EXPECT_EQ(
        a.single_displacement[k],
        (std::array<float, 3>{static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)}));
    pairs.push_back({i, j, s});
  }
  const auto end = static_cast<std::size_t>(count);
  EXPECT_EQ(a.i[end], Arrays::kUntouched);
  EXPECT_EQ(a.shift[end][2], Arrays::kUntouched);
  EXPECT_EQ(a.displacement[end].x, static_cast<double>(Arrays::kUntouched));
  return pairs;
}

std::vector<Pair> found_pairs(const Scene& scene, Span<const char> with_itself = {}) {
  Arrays arrays;
  const std::int64_t count =
      neighbor_columns(scene.points, scene.box, scene.params, with_itself, arrays.maker());
  EXPECT_EQ(arrays.calls, 1);
  return checked_pairs(arrays, count, scene);
}

std::vector<Pair> sorted(std::vector<Pair> pairs) {
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Points of any kind, some of them many cells away, along open axes too.
std::vector<Vec3> placed_points(const Box& box, std::size_t n, scenes::Random& random) {
  auto points = scenes::hard_point_sets(box, n, 0.3);
  std::vector<Vec3> chosen = points[random.below(points.size())].points;
  const bool is_wrapped = random.below(2) == 0;
  for (Vec3& p : chosen) {
    if (std::abs(p.x) > 1e9) p.x = 7.5;  // no image of that one has a number
    if (is_wrapped) p = box.wrap(p);
    if (is_wrapped || random.below(3) != 0) continue;
    for (int axis = 0; axis < 3; ++axis)
      if (box.periodic(axis)) p = p + (static_cast<double>(random.below(7)) - 3) * box.vector(axis);
  }
  return chosen;
}

class PairColumnsInBoxes : public testing::TestWithParam<scenes::NamedBox> {
 protected:
  double height() const { return GetParam().box.any_periodic() ? GetParam().box.min_height() : 3; }
};

TEST_P(PairColumnsInBoxes, HaveThePairsOfAllImages) {
  scenes::Random random(51);
  for (const auto& [heights, particles] : {std::pair(0.1, 200), std::pair(0.3, 80), std::pair(0.4999, 40),
                                           std::pair(0.5, 40), std::pair(1.2, 16)}) {
    for (int turn = 0; turn < effort(8); ++turn) {
      Scene scene{
          GetParam().box, placed_points(GetParam().box, static_cast<std::size_t>(particles), random), {}};
      const double cutoff = heights * height();
      scene.params.cutoffs = TypeCutoffs(cutoff);
      scene.params.kind = turn % 2 == 0 ? ListKind::full : ListKind::half;
      ASSERT_EQ(sorted(found_pairs(scene)), brute_force(scene, cutoff))
          << heights << " heights, turn " << turn;
    }
  }
}

TEST_P(PairColumnsInBoxes, HaveTheCutoffsOfTypesAndRadii) {
  scenes::Random random(52);
  const double cutoff = 0.45 * height();
  for (int turn = 0; turn < 4; ++turn) {
    Scene scene{GetParam().box, placed_points(GetParam().box, 60, random), {}};
    std::vector<std::int32_t> types;
    std::vector<double> radii;
    for (std::size_t i = 0; i < scene.points.size(); ++i) {
      types.push_back(static_cast<std::int32_t>(random.below(2)));
      radii.push_back(i == 0 ? 0.5 * cutoff : random.uniform(0, 0.5 * cutoff));
    }
    if (turn < 2) {
      scene.params.cutoffs = TypeCutoffs(2, {cutoff, 0.4 * cutoff, 0.4 * cutoff, 0});
      scene.params.types = types;
    } else {
      scene.params.radii = radii;
    }
    scene.params.kind = turn % 2 == 0 ? ListKind::full : ListKind::half;
    ASSERT_EQ(sorted(found_pairs(scene)), brute_force(scene, cutoff)) << turn;
  }
}

INSTANTIATE_TEST_SUITE_P(Boxes, PairColumnsInBoxes, testing::ValuesIn(scenes::all_boxes(4)),
                         [](const auto& box) { return box.param.name; });

class PairColumns400 : public testing::Test {
 protected:
  PairColumns400() : scene_{Box::triclinic({6, 0, 0}, {1, 6, 0}, {0, -1, 7}), {}, {}} {
    scene_.points = scenes::uniform_in(scene_.box, 400, 7);
  }
  Scene scene_;
};

/// In the same order too, with particles beside themselves.
TEST_F(PairColumns400, AreTheSameOnAnyNumberOfThreads) {
  std::vector<char> with_itself(400);
  for (std::size_t i = 0; i < 400; i += 3) with_itself[i] = 1;
  for (const double cutoff : {0.2, 1.5, 4.0})
    for (const ListKind kind : {ListKind::full, ListKind::half}) {
      scene_.params.cutoffs = TypeCutoffs(cutoff);
      scene_.params.kind = kind;
      scene_.params.executor = nullptr;
      const std::vector<Pair> expected = found_pairs(scene_, with_itself);
      for (const int count : {2, 3, 7}) {
        const auto threads = make_thread_pool(count);
        scene_.params.executor = threads.get();
        ASSERT_EQ(found_pairs(scene_, with_itself), expected) << count;
      }
    }
}

TEST_F(PairColumns400, PutParticlesBeforeTheirNeighbors) {
  scene_.params.cutoffs = TypeCutoffs(1.5);
  const std::vector<Pair> alone = found_pairs(scene_);
  std::vector<char> with_itself(400, 0);
  with_itself[0] = with_itself[17] = with_itself[399] = 1;
  std::vector<Pair> expected = alone;
  for (const std::int32_t i : {0, 17, 399})
    expected.insert(
        std::find_if(expected.begin(), expected.end(), [&](const Pair& p) { return std::get<0>(p) >= i; }),
        Pair{i, i, Shift{}});
  EXPECT_EQ(found_pairs(scene_, with_itself), expected);
}

TEST_F(PairColumns400, LeaveOutExcludedPairs) {
  scene_.params.cutoffs = TypeCutoffs(2.0);
  const std::vector<Pair> all = sorted(found_pairs(scene_));
  const std::vector<IndexPair> excluded{{std::get<0>(all[10]), std::get<1>(all[10])}, {5, 4}};
  const Exclusions exclusions = Exclusions::from_pairs(400, excluded);
  scene_.params.exclusions = &exclusions;
  std::vector<Pair> expected;
  for (const Pair& pair : all)
    if (!exclusions.excluded(std::get<0>(pair), std::get<1>(pair))) expected.push_back(pair);
  ASSERT_LT(expected.size(), all.size());
  EXPECT_EQ(sorted(found_pairs(scene_)), expected);
}

TEST_F(PairColumns400, FillNoOthersThanAreGiven) {
  scene_.params.cutoffs = TypeCutoffs(1.5);
  for (const ListKind kind : {ListKind::full, ListKind::half}) {
    scene_.params.kind = kind;
    Arrays all;
    const std::int64_t count = neighbor_columns(scene_.points, scene_.box, scene_.params, {}, all.maker());
    const auto one_of = [&](const auto& only) {
      Arrays one;
      neighbor_columns(scene_.points, scene_.box, scene_.params, {}, [&](std::int64_t pairs) {
        EXPECT_EQ(pairs, count);
        return only(one, one.columns(pairs));
      });
      return one;
    };
    const auto only_i = [](Arrays&, const PairColumns& c) { return PairColumns{c.i}; };
    const auto only_j = [](Arrays&, const PairColumns& c) { return PairColumns{nullptr, c.j}; };
    const auto only_d = [](Arrays&, const PairColumns& c) {
      return PairColumns{nullptr, nullptr, nullptr, c.distance};
    };
    EXPECT_EQ(one_of(only_i).i, all.i);
    EXPECT_EQ(one_of(only_j).j, all.j);
    EXPECT_EQ(one_of(only_d).distance, all.distance);
    EXPECT_EQ(one_of(only_d).j[0], Arrays::kUntouched);
  }
}

TEST(PairColumns, OfNoneAndOfOneParticle) {
  EXPECT_EQ(found_pairs({Box::orthorhombic({1, 1, 1}), {}, {}}).size(), 0U);
  Scene one{Box::orthorhombic({1, 1, 1}), {{0.3, 70, -2}}, {}};
  one.params.cutoffs = TypeCutoffs(1);
  EXPECT_EQ(found_pairs(one).size(), 6U);
  one.params.cutoffs = TypeCutoffs(0.4);
  const std::vector<char> with_itself{1};
  EXPECT_EQ(found_pairs(one, with_itself), (std::vector<Pair>{{0, 0, Shift{}}}));
}

TEST(PairColumns, OfAListThatIsFollowedAreThoseWithinTheCutoff) {
  Scene scene{Box::orthorhombic({6, 5, 7}), scenes::uniform_in(Box::orthorhombic({6, 5, 7}), 300, 9), {}};
  scene.params.cutoffs = TypeCutoffs(1.2);
  scene.params.skin = 0.3;
  const NeighborPairs listed = neighbor_pairs(scene.points, scene.box, scene.params);
  const auto threads = make_thread_pool(3);
  for (Executor* const executor : {static_cast<Executor*>(nullptr), threads.get()}) {
    Arrays arrays;
    const std::int64_t count =
        columns_of(listed, scene.points, NeighborPairs::Within::cutoff, {}, executor, arrays.maker());
    EXPECT_EQ(arrays.calls, 1);
    EXPECT_EQ(static_cast<std::int64_t>(arrays.i.size()), listed.listed() + 1);
    ASSERT_LT(count, listed.listed());
    arrays.i[static_cast<std::size_t>(count)] = Arrays::kUntouched;
    arrays.shift[static_cast<std::size_t>(count)][2] = Arrays::kUntouched;
    arrays.displacement[static_cast<std::size_t>(count)].x = Arrays::kUntouched;
    EXPECT_EQ(sorted(checked_pairs(arrays, count, scene)), brute_force(scene, 1.2));
  }
}

TEST(PairColumns, RefuseASkinAndTooManyPairs) {
  const std::vector<Vec3> points(50);
  NeighborPairsParams params;
  params.skin = 0.1;
  const MakeColumns never = [](std::int64_t) -> PairColumns {
    throw std::logic_error("nothing was to be filled");
  };
  EXPECT_THROW(neighbor_columns(points, Box::none(), params, {}, never), InvalidParameter);
  params.skin = 0;
  params.max_pairs = 2449;
  EXPECT_THROW(neighbor_columns(points, Box::none(), params, {}, never), TooManyPairs);
  params.max_pairs = 2450;
  EXPECT_THROW(neighbor_columns(points, Box::none(), params, {}, never), std::logic_error);
}

}  // namespace
}  // namespace dch
