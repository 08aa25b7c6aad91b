// SPDX-License-Identifier: MIT
//
// Particles of different sizes: cutoffs by radii and by types, on one hierarchy and on one for each class of
// sizes, in every kind of box and scene, on every instruction set. Several lists at once.
//
// More than 300 lines: every case asks the same models of sizes of the same engines.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include <dch/base/error.hpp>
#include <dch/base/instruction_set.hpp>
#include <dch/lists/all_pairs.hpp>

#include "effort.hpp"
#include "instruction_sets.hpp"
#include "list_compare.hpp"
#include "size_models.hpp"

namespace dch {
namespace {

using namespace sizes;  // NOLINT(google-build-using-namespace)

class ListSizes : public ::testing::TestWithParam<scenes::NamedBox> {};

TEST_P(ListSizes, ListsEqualTheOracle) {
  const Box box = GetParam().box;
  for (const scenes::NamedPoints& scene : scenes::hard_point_sets(box, 300, 0.6)) {
    for (const SizeModel& model : size_models(scene.points.size())) {
      for (const ListKind kind : {ListKind::half, ListKind::full}) {
        ListParams params = model.params();
        params.kind = kind;
        const NeighborList expected = all_pairs(scene.points, box, params);
        const auto cell = make_cell_search(kReach);
        cell->update(scene.points, box);
        ASSERT_EQ(first_difference(cell->list(params), expected), "")
            << "cell, " << scene.name << ", " << model.name;
        for (const Engine engine : kEngines) {
          const auto search = search_with(engine);
          search->update(scene.points, box);
          for (const InstructionSet set : supported_sets()) {
            set_instruction_set(set);
            ASSERT_EQ(first_difference(search->list(params), expected), "")
                << scene.name << ", " << model.name << ", " << name(set) << text(engine);
          }
        }
      }
    }
  }
}

TEST_P(ListSizes, ExclusionsAndGhosts) {
  const Box box = GetParam().box;
  const std::vector<Vec3> points = scenes::clustered(box, 400, 5);
  std::vector<IndexPair> bonds;
  for (std::int32_t i = 0; i + 1 < 400; ++i) bonds.push_back({i, i + 1});
  const Exclusions exclusions = Exclusions::from_bonds(points.size(), bonds, 3);
  for (const SizeModel& model : size_models(points.size())) {
    ListParams excluded = model.params(), ghosts = model.params();
    excluded.exclusions = &exclusions;
    ghosts.first_ghost = 150;
    for (const ListParams& params : {excluded, ghosts}) {
      const NeighborList expected = all_pairs(points, box, params);
      for (const Engine engine : kEngines) {
        const auto search = search_with(engine);
        search->update(points, box);
        ASSERT_EQ(first_difference(search->list(params), expected), "") << model.name << text(engine);
        ListParams as_found = params;
        as_found.order = RowOrder::by_structure;
        const NeighborList found = search->list(as_found);
        ASSERT_EQ(first_difference(sorted_by_index(found, points.size()), expected), "") << model.name;
      }
    }
  }
}

/// What is wrong with the order of near and far neighbors in the rows of a list with a shell; empty if
/// nothing.
std::string fault_of_shell(const NeighborList& list, const std::vector<Vec3>& points, const Box& box,
                           const SizeModel& model, double shell) {
  if (list.near_end.size() != list.size()) return "no end of near ones for each row";
  const double off = 2e-3 * kReach * kReach;
  for (std::size_t row = 0; row < list.size(); ++row) {
    if (list.near_end[row] < list.first[row] || list.near_end[row] > list.first[row + 1])
      return "end outside of row";
    for (std::int64_t k = list.first[row]; k < list.first[row + 1]; ++k) {
      const auto i = static_cast<std::size_t>(list.particle[row]);
      const auto j = static_cast<std::size_t>(list.j[static_cast<std::size_t>(k)]);
      const double limit = std::max(model.reach(i, j) - shell, 0.0);
      const double beyond = box.distance2(points[i], points[j]) - limit * limit;
      if (k < list.near_end[row] ? beyond > off : beyond < -off)
        return "pair " + std::to_string(i) + ", " + std::to_string(j) + " by " + std::to_string(beyond);
    }
  }
  return "";
}

TEST_P(ListSizes, ShellComesLastOnThreadsToo) {
  const Box box = GetParam().box;
  const std::vector<Vec3> points = scenes::clustered(box, 400, 5);
  std::vector<IndexPair> bonds;
  for (std::int32_t i = 0; i + 1 < 400; ++i) bonds.push_back({i, i + 1});
  const Exclusions exclusions = Exclusions::from_bonds(points.size(), bonds, 3);
  const auto pool = make_thread_pool(3);
  for (const SizeModel& model : size_models(points.size())) {
    if (model.name == "20 types") continue;  // of which a list knows the largest cutoff alone
    for (const double shell : {0.1, kSkin}) {
      ListParams plain = model.params(), excluded = model.params(), ghosts = model.params();
      excluded.exclusions = &exclusions;
      excluded.kind = ListKind::full;
      ghosts.first_ghost = 150;
      for (ListParams params : {plain, excluded, ghosts}) {
        params.shell = shell;
        params.order = RowOrder::by_structure;
        const NeighborList expected = all_pairs(points, box, params);
        for (const Engine engine : kEngines) {
          const auto search =
              search_with(engine, engine == Engine::hierarchy_by_class ? nullptr : pool.get());
          search->update(points, box);
          const NeighborList found = search->list(params);
          ASSERT_EQ(first_difference(sorted_by_index(found, points.size()), expected), "") << model.name;
          ASSERT_EQ(fault_of_shell(found, points, box, model, shell), "")
              << model.name << ", shell " << shell;
        }
      }
    }
  }
}

// Particles move, come, go and change their sizes; named by keys or by their index.
TEST_P(ListSizes, UnderMotion) {
  const Box box = GetParam().box;
  scenes::Random random(11);
  for (const bool named : {false, true}) {
    const auto search = search_with(Engine::hierarchy_by_class);
    std::vector<Vec3> points = scenes::uniform_in(box, 500, 6);
    std::vector<std::uint64_t> keys(points.size());
    for (std::size_t i = 0; i < keys.size(); ++i) keys[i] = 10 * i;
    for (int step = 0; step < 25; ++step) {
      const double largest = step % 10 == 9 ? 3.0 : 0.05;
      for (Vec3& p : points) p = p + random.in_cube(largest);
      if (named) {
        const std::size_t lost = random.below(points.size());
        points.erase(points.begin() + static_cast<std::ptrdiff_t>(lost));
        keys.erase(keys.begin() + static_cast<std::ptrdiff_t>(lost));
        for (int k = 0; k < 2; ++k) {
          points.push_back(box.wrap(points[random.below(points.size())] + random.in_cube(1)));
          keys.push_back(1000000 + static_cast<std::uint64_t>(2 * step + k));
        }
      }
      const std::vector<SizeModel> models = size_models(points.size());
      const SizeModel& model = models[static_cast<std::size_t>(step / 4) % models.size()];
      search->update(points, box, named ? Span<const std::uint64_t>(keys) : Span<const std::uint64_t>());
      ASSERT_EQ(first_difference(search->list(model.params()), all_pairs(points, box, model.params())), "")
          << "step " << step << ", " << model.name << (named ? ", named" : "");
    }
    EXPECT_GT(search->stats().refreshes + search->stats().repairs, 0)
        << "structures survive from step to step";
  }
}

TEST(ListSizesTest, NoParticlesAndNoPairsAreNoTrouble) {
  for (const Engine engine : kEngines) {
    const auto search = search_with(engine);
    const Box box = Box::orthorhombic({kSide, kSide, kSide});
    ListParams params;
    params.cutoffs = TypeCutoffs(kReach);
    search->update({}, box);
    EXPECT_EQ(search->list(params).size(), 0u);
    const std::vector<Vec3> points = scenes::uniform_in(box, 50, 1);
    const std::vector<std::int32_t> types(points.size(), 1);
    params.cutoffs = TypeCutoffs(2, {1, 0, 0, 0});
    params.types = types;
    search->update(points, box);
    EXPECT_EQ(search->list(params).pairs(), 0);
  }
}

/// A large one must not look through as many cells of the tiny one as fit into its reach: that had no end.
TEST(ListSizesTest, OneTinyParticleBesideLargeOnes) {
  const Box box = Box::orthorhombic({4, 4.8, 3.6});
  for (const std::size_t n : {std::size_t{60}, std::size_t{3000}}) {
    const std::vector<Vec3> points = scenes::uniform_in(box, n, 17);
    for (const double tiny : {1e-2, 1e-4, 1e-5, 1e-7}) {
      std::vector<double> radii(n);
      for (std::size_t i = 0; i < n; ++i)
        radii[i] = 0.8 * static_cast<double>(n - i) / static_cast<double>(n);
      radii[1] = tiny;
      ListParams params;
      params.radii = radii;
      const NeighborList expected = all_pairs(points, box, params);
      for (const std::string engine : {"grid", "auto", "dch"}) {
        HierarchyParams by;
        by.radius = 1.6;
        by.size_classes = true;
        const auto search = make_search(engine, by);
        for (int step = 0; step < 2; ++step) {
          search->update(points, box);
          ASSERT_EQ(first_difference(search->list(params), expected), "")
              << engine << ", " << n << ", " << tiny;
        }
      }
    }
  }
}

TEST_P(ListSizes, SeveralListsAtOnce) {
  const Box box = GetParam().box;
  const std::vector<Vec3> points = scenes::uniform_in(box, static_cast<std::size_t>(effort(800)), 8);
  for (const SizeModel& model : size_models(points.size())) {
    std::vector<ListParams> requests(4, model.params());
    requests[1].skin = 0;
    requests[2].skin = 0.1;
    requests[2].kind = ListKind::full;
    requests[3].skin = 0.02;
    requests[3].order = RowOrder::by_structure;
    std::vector<ListParams> mixed = requests;  // cutoffs that depend on different things
    mixed[1] = ListParams();
    mixed[1].cutoffs = TypeCutoffs(0.5);
    for (const std::vector<ListParams>& asked : {requests, mixed})
      for (const Engine engine : kEngines) {
        const auto search = search_with(engine);
        search->update(points, box);
        const std::vector<NeighborList> lists = search->lists(asked);
        ASSERT_EQ(lists.size(), asked.size());
        for (std::size_t k = 0; k < asked.size(); ++k) {
          const NeighborList expected = all_pairs(points, box, asked[k]);
          const NeighborList& list = lists[k];
          ASSERT_EQ(first_difference(k == 3 ? sorted_by_index(list, points.size()) : list, expected), "")
              << model.name << ", list " << k << text(engine);
        }
      }
  }
}

// Each list reaches farther than the others for one of its types.
TEST_P(ListSizes, SeveralMatricesAtOnce) {
  const Box box = GetParam().box;
  const std::vector<Vec3> points = scenes::uniform_in(box, static_cast<std::size_t>(effort(800)), 18);
  std::vector<std::int32_t> types;
  for (std::size_t i = 0; i < points.size(); ++i) types.push_back(static_cast<std::int32_t>(i % 3));
  std::vector<ListParams> requests(3);
  for (int wide = 0; wide < 3; ++wide) {
    std::vector<double> matrix(9, 0.2);
    matrix[static_cast<std::size_t>(4 * wide)] = kReach * (1 - 0.1 * wide);
    requests[static_cast<std::size_t>(wide)].cutoffs = TypeCutoffs(3, matrix);
    requests[static_cast<std::size_t>(wide)].types = types;
  }
  for (const Engine engine : kEngines) {
    const auto search = search_with(engine);
    search->update(points, box);
    const std::vector<NeighborList> lists = search->lists(requests);
    for (std::size_t k = 0; k < requests.size(); ++k)
      ASSERT_EQ(first_difference(lists[k], all_pairs(points, box, requests[k])), "")
          << "list " << k << text(engine);
  }
}

TEST_P(ListSizes, ListsDoNotDependOnTheNumberOfThreads) {
  const Box box = GetParam().box;
  const std::vector<Vec3> points = scenes::uniform_in(box, 2000, 9);
  for (const SizeModel& model : size_models(points.size())) {
    ListParams params = model.params();
    params.order = RowOrder::by_structure;
    for (const Engine engine : {Engine::hierarchy_by_class, Engine::grid}) {
      NeighborList expected;
      for (const int threads : {1, 3}) {
        const auto pool = make_thread_pool(threads);
        const auto search = search_with(engine, pool.get());
        search->update(points, box);
        const NeighborList list = search->list(params);
        if (threads == 1) expected = list;
        ASSERT_EQ(list.particle, expected.particle) << model.name << text(engine);
        ASSERT_EQ(first_difference(list, expected), "") << model.name << text(engine);
      }
    }
  }
}

// Reaches up to half the box, where images tie.
TEST_P(ListSizes, InTheSmallestBox) {
  const Box box = GetParam().box;
  if (!box.any_periodic()) return;
  const double factor = box.max_cutoff() / kReach;
  for (const double share : {1.0, 1 - 1e-9, 0.9, 0.6}) {
    const std::vector<Vec3> points = scenes::uniform_in(box, 300, 10);
    for (SizeModel model : size_models(points.size())) {
      if (model.radii.empty()) continue;
      for (double& radius : model.radii) radius *= factor * share;
      ListParams params = model.params();
      params.skin *= factor * share * (1 - 1e-12);
      for (const Engine engine : {Engine::hierarchy_by_class, Engine::grid}) {
        const auto search = search_with(engine, nullptr, box.max_cutoff());
        search->update(points, box);
        ASSERT_EQ(first_difference(search->list(params), all_pairs(points, box, params)), "")
            << model.name << ", share " << share << text(engine);
      }
    }
  }
}

// What lists take from the structure is kept while it stays as it is; what requests say is not.
TEST_P(ListSizes, RequestsMayDifferWhileTheStructureStaysAsItIs) {
  const Box box = GetParam().box;
  const std::vector<Vec3> points = scenes::uniform_in(box, 400, 16);
  const std::vector<SizeModel> models = size_models(points.size());
  std::vector<double> radii = models[1].radii;
  ListParams one_cutoff, ghosts, in_place;
  ghosts.first_ghost = 150;
  in_place.radii = radii;
  in_place.skin = kSkin;
  for (const Engine engine : kEngines) {
    const auto search = search_with(engine);
    search->update(points, box);
    const auto expect_pairs_of = [&](const ListParams& params, const char* what) {
      EXPECT_EQ(first_difference(search->list(params), all_pairs(points, box, params)), "")
          << what << text(engine);
    };
    for (int round = 0; round < 2; ++round) {
      expect_pairs_of(one_cutoff, "one cutoff");
      expect_pairs_of(ghosts, "ghosts");
      for (const SizeModel& model : models) expect_pairs_of(model.params(), model.name.c_str());
      for (std::size_t turn = 0; turn < 3; ++turn) {
        for (std::size_t i = 0; i < radii.size(); ++i) radii[i] = models[1].radii[(i + turn) % radii.size()];
        expect_pairs_of(in_place, "other radii at the same address");
      }
      std::vector<NeighborList> lists;
      const std::vector<ListParams> both{in_place, models[3].params()};
      search->lists(both, lists);
      for (std::size_t r = 0; r < both.size(); ++r)
        EXPECT_EQ(first_difference(lists[r], all_pairs(points, box, both[r])), "") << "of two, " << r;
    }
  }
}

TEST_P(ListSizes, NothingIsLeftOfWhatAListHeldBefore) {
  const Box box = GetParam().box;
  const std::vector<Vec3> points = scenes::uniform_in(box, 200, 15);
  ListParams rough;
  rough.superset = true;
  rough.order = RowOrder::by_structure;
  NeighborList list;
  const auto dch = search_with(Engine::one_hierarchy), cell = make_cell_search(kReach);
  for (PairSearch* search : {dch.get(), cell.get()}) {
    dch->update(points, box);
    cell->update(points, box);
    dch->list(rough, list);
    ASSERT_GT(list.margin, 0);
    ASSERT_FALSE(list.particle.empty());
    search->list(ListParams(), list);
    EXPECT_EQ(list.margin, 0);
    EXPECT_TRUE(list.particle.empty());
    EXPECT_EQ(first_difference(list, all_pairs(points, box, ListParams())), "");
  }
}

// After an error the search holds nothing, and the next good update makes up for it.
TEST_P(ListSizes, BadInputIsRefusedAndForgotten) {
  const Box box = GetParam().box;
  const std::vector<Vec3> points = scenes::uniform_in(box, 200, 14);
  const SizeModel model = size_models(points.size())[1];
  for (const Engine engine : {Engine::hierarchy_by_class, Engine::grid}) {
    const auto search = search_with(engine);
    std::vector<Vec3> bad = points;
    bad[17].y = std::nan("");
    const std::vector<std::uint64_t> repeated(points.size(), 5), few(3, 1);
    for (int round = 0; round < 2; ++round) {
      search->update(points, box);
      ASSERT_EQ(first_difference(search->list(model.params()), all_pairs(points, box, model.params())), "");
      ListParams wider = model.params();
      wider.skin = 2 * kSkin;
      EXPECT_THROW(search->list(wider), InvalidParameter) << "beyond the radius that the search was made for";
      for (const double shell : {-0.1, std::nan(""), 1.1 * kSkin}) {
        ListParams shelled = model.params();
        shelled.shell = shell;
        EXPECT_THROW(search->list(shelled), InvalidParameter) << shell;
      }
      EXPECT_THROW(search->update(bad, box), InvalidPosition);
      EXPECT_THROW(search->list(model.params()), InvalidParameter) << "radii of particles that are not there";
      EXPECT_THROW(search->update(points, box, repeated), InvalidParameter);
      EXPECT_THROW(search->update(points, box, few), InvalidParameter);
      EXPECT_THROW(search->update(points, Box::orthorhombic({5, 5, 5})), CutoffTooLarge);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Boxes, ListSizes, ::testing::ValuesIn(scenes::all_boxes(kSide)),
                         [](const auto& p) { return p.param.name; });

}  // namespace
}  // namespace dch
