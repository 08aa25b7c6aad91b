// SPDX-License-Identifier: MIT
//
// Points that come and go: insertion, removal and hosts that rename their particles.
#include <algorithm>
#include <gtest/gtest.h>

#include <dch/base/error.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/lists/all_pairs.hpp>

#include "effort.hpp"
#include "list_compare.hpp"
#include "listed_hierarchy.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

constexpr double kChurnRadius = 1.0;

StructureParams params_with(EdgeRule rule, int max_roots) {
  StructureParams params;
  params.radius = kChurnRadius;
  params.edge_rule = rule;
  if (rule == EdgeRule::additive) params.base_radius = kChurnRadius / 2.1;  // small leaves: many levels
  params.max_roots = max_roots;
  return params;
}

ListParams whole_list() {
  ListParams params;
  params.cutoffs = TypeCutoffs(kChurnRadius);
  return params;
}

/// The oracle's list with the points' ids in the place of their positions in the array.
NeighborList oracle_by_id(ListedHierarchy& hierarchy) {
  std::vector<Vec3> points;
  std::vector<std::int32_t> ids;
  for (std::size_t id = 0; id < hierarchy.capacity(); ++id) {
    if (!hierarchy.contains(static_cast<std::int32_t>(id))) continue;
    ids.push_back(static_cast<std::int32_t>(id));
    points.push_back(hierarchy.position(ids.back()));
  }
  const NeighborList compact = all_pairs(points, hierarchy.box(), whole_list());
  NeighborList out;
  out.first.assign(hierarchy.capacity() + 1, 0);
  std::size_t k = 0;
  for (std::size_t id = 0; id < hierarchy.capacity(); ++id) {
    if (k < ids.size() && ids[k] == static_cast<std::int32_t>(id)) {
      for (const std::int32_t j : compact.row(k)) out.j.push_back(ids[j]);
      ++k;
    }
    out.first[id + 1] = static_cast<std::int64_t>(out.j.size());
  }
  return out;
}

class HierarchyChurn : public ::testing::TestWithParam<scenes::NamedBox> {};

TEST_P(HierarchyChurn, ValidUnderInsertionsAndRemovals) {
  const Box box = GetParam().box;
  const auto operations = static_cast<std::size_t>(effort(300));
  for (const auto& params : {params_with(EdgeRule::additive, 16), params_with(EdgeRule::additive, 1),
                             params_with(EdgeRule::thesis, 16), params_with(EdgeRule::thesis, 1)}) {
    scenes::Random random(3);
    const std::vector<Vec3> pool = scenes::uniform_in(box, 100 + operations, 17);
    ListedHierarchy hierarchy(params);
    hierarchy.build(Span<const Vec3>(pool.data(), 100), box);
    std::vector<std::int32_t> alive(100);
    for (std::size_t i = 0; i < alive.size(); ++i) alive[i] = static_cast<std::int32_t>(i);
    for (std::size_t next = 100; next < pool.size(); ++next) {
      const bool growing =
          next < 100 + operations * 2 / 5;  // first mostly insertions, then mostly removals, down to nothing
      if (random.uniform() < (growing ? 0.8 : 0.2) || alive.empty()) {
        const std::int32_t near =
            alive.empty() || random.uniform() < 0.5 ? -1 : alive[random.below(alive.size())];
        alive.push_back(hierarchy.insert(pool[next], near));
      } else {
        const std::size_t k = random.below(alive.size());
        hierarchy.remove(alive[k]);
        alive[k] = alive.back();
        alive.pop_back();
      }
      ASSERT_EQ(hierarchy.validate(), "") << "operation " << next;
      if (next % 50 == 0) {
        NeighborList list;
        hierarchy.list(whole_list(), list);
        ASSERT_EQ(first_difference(list, oracle_by_id(hierarchy)), "") << "operation " << next;
      }
    }
    while (!alive.empty()) {
      hierarchy.remove(alive.back());
      alive.pop_back();
      ASSERT_EQ(hierarchy.validate(), "") << alive.size() << " left";
    }
    EXPECT_EQ(hierarchy.size(), 0u);
    EXPECT_EQ(hierarchy.levels(), 2);
  }
}

TEST_P(HierarchyChurn, ValidUnderMotionBetweenInsertionsAndRemovals) {
  const Box box = GetParam().box;
  for (StructureParams params : {params_with(EdgeRule::additive, 1), params_with(EdgeRule::additive, 16),
                                 params_with(EdgeRule::thesis, 1), params_with(EdgeRule::thesis, 16)}) {
    scenes::Random random(8);
    params.policy = MaintenancePolicy::always_repair;
    ListedHierarchy hierarchy(params);
    hierarchy.build(scenes::uniform_in(box, 200, 5), box);
    for (int round = 0; round < effort(10); ++round) {
      std::vector<Vec3> points(hierarchy.capacity());
      for (std::size_t id = 0; id < points.size(); ++id)
        if (hierarchy.contains(static_cast<std::int32_t>(id)))
          points[id] = hierarchy.position(static_cast<std::int32_t>(id)) + random.in_cube(0.3);
      hierarchy.update(points, box);
      ASSERT_EQ(hierarchy.validate(), "") << "motion, round " << round;
      for (int k = 0; k < 5; ++k) {
        const auto id = static_cast<std::int32_t>(random.below(hierarchy.capacity()));
        if (hierarchy.contains(id)) hierarchy.remove(id);
      }
      for (const Vec3 p : scenes::uniform_in(box, 4, 100 + static_cast<std::uint64_t>(round)))
        hierarchy.insert(p);
      ASSERT_EQ(hierarchy.validate(), "") << "exchange, round " << round;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Boxes, HierarchyChurn, ::testing::ValuesIn(scenes::all_boxes(5.0)),
                         [](const auto& p) { return p.param.name; });

TEST(HierarchyChurn, CoincidentAndFarPointsMayComeAndGo) {
  ListedHierarchy hierarchy(params_with(EdgeRule::additive, 1));
  hierarchy.build({}, Box::none());
  std::vector<std::int32_t> ids;
  for (int k = 0; k < 40; ++k) {
    ids.push_back(hierarchy.insert(k % 10 == 9 ? Vec3{1e12, 0, static_cast<double>(k)} : Vec3{1, 1, 1}));
    ASSERT_EQ(hierarchy.validate(), "") << k;
  }
  for (const std::int32_t id : ids) {
    hierarchy.remove(id);
    ASSERT_EQ(hierarchy.validate(), "") << id;
  }
}

// Wrapping a point from many boxes away costs digits, which the thresholds have to allow for before the next
// update.
TEST(HierarchyChurn, PointsInsertedFromFarOutsideTheBoxAreListedRightly) {
  const Box box = Box::orthorhombic({5, 5.5, 6});
  ListedHierarchy hierarchy(params_with(EdgeRule::additive, 16));
  hierarchy.build(scenes::uniform_in(box, 400, 3), box);
  scenes::Random random(4);
  for (int k = 0; k < 20; ++k) hierarchy.insert(random.in_cube(1e12));
  NeighborList list;
  hierarchy.list(whole_list(), list);
  EXPECT_EQ(first_difference(list, oracle_by_id(hierarchy)), "");
  EXPECT_EQ(hierarchy.validate(), "");
}

/// A host that re-sorts, drops and adds particles at every step, naming them by key.
TEST(HierarchyChurn, KeysCarryTheStructureThroughRenumbering) {
  struct Particle {
    std::uint64_t key;
    Vec3 at;
  };
  const Box box = Box::orthorhombic({6, 6, 6});
  scenes::Random random(21);
  std::uint64_t next_key = 0;
  std::vector<Particle> particles;
  for (const Vec3 p : scenes::uniform_in(box, 600, 1)) particles.push_back({next_key++, p});
  StructureParams params = params_with(EdgeRule::additive, 16);
  params.policy = MaintenancePolicy::always_repair;
  const auto search = make_dch_search(params);
  for (int step = 0; step < 40; ++step) {
    for (std::size_t k = particles.size() - 1; k > 0; --k)
      std::swap(particles[k], particles[random.below(k + 1)]);
    particles.resize(particles.size() - 20);
    for (const Vec3 p : scenes::uniform_in(box, 20, 1000 + static_cast<std::uint64_t>(step)))
      particles.push_back({next_key++, p});
    std::vector<Vec3> positions;
    std::vector<std::uint64_t> keys;
    for (Particle& particle : particles) {
      particle.at = particle.at + random.in_cube(0.1);
      positions.push_back(particle.at);
      keys.push_back(particle.key);
    }
    search->update(positions, box, keys);
    ASSERT_EQ(first_difference(search->list(whole_list()), all_pairs(positions, box, whole_list())), "")
        << "step " << step;
  }
  EXPECT_EQ(search->stats().builds, 1);
  EXPECT_EQ(search->stats().inserted, 39 * 20);
  EXPECT_EQ(search->stats().removed, 39 * 20);
}

TEST(HierarchyChurn, RepeatedOrMissingKeysAreRefused) {
  const auto search = make_dch_search(kChurnRadius);
  const std::vector<Vec3> points = scenes::uniform(5, {6, 6, 6}, 1);
  EXPECT_THROW(search->update(points, Box::none(), std::vector<std::uint64_t>{1, 2, 3, 4, 2}),
               InvalidParameter);
  EXPECT_THROW(search->update(points, Box::none(), std::vector<std::uint64_t>{1, 2, 3}), InvalidParameter);
  EXPECT_NO_THROW(search->update(points, Box::none(), std::vector<std::uint64_t>{1, 2, 3, 4, 5}));
}

}  // namespace
}  // namespace dch
