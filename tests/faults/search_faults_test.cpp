// SPDX-License-Identifier: MIT
//
// Engines hold nothing after an update that memory did not suffice for, and everything after the next good
// one; a list that threw is followed by a right one.
//
// More than 300 lines: one sweep a public function of the engines, all from the same frames.
#include <functional>
#include <numeric>
#include <ostream>
#include <string>

#include <dch/engines/pair_search.hpp>
#include <dch/engines/verlet_list.hpp>
#include <dch/lists/stale_test.hpp>

#include "scene.hpp"

namespace dch::faults {
namespace {

constexpr std::size_t kSearchPoints = 100;

struct NamedEngine {
  std::string name;
  std::function<std::unique_ptr<PairSearch>()> make;
  bool only_notes_updates = false;  ///< until a list is asked for; that takes no memory for as many particles
};

std::ostream& operator<<(std::ostream& out, const NamedEngine& engine) { return out << engine.name; }

std::vector<NamedEngine> engines() {
  return {
      {"cell", [] { return make_cell_search(kRadius); }},
      {"fine_cell", [] { return make_cell_search(kRadius, 3); }},
      {"dch", [] { return make_dch_search(kRadius); }},
      {"dch_size_classes",
       [] {
         HierarchyParams params = params_for();
         params.size_classes = true;
         return make_dch_search(params);
       },
       true},
      {"grid", [] { return make_grid_search(kRadius); }, true},
      {"auto", [] { return make_auto_search(params_for()); }},
  };
}

/// Particles of two sizes at one time; they move and change places in memory until the next, and some change
/// their size.
struct Frame {
  Scene scene;
  Asked asked;
  std::vector<std::uint64_t> keys;

  Frame(std::size_t first, double shake) : scene(Scene(kSearchPoints).shaken(shake)) {
    for (std::size_t k = 0; k < kSearchPoints; ++k) {
      keys.push_back(first + k);
      asked.radii.push_back((first + k) % 4 == 0 ? 0.45 : 0.15);
    }
    asked.request.radii = asked.radii;
    asked.answer(scene);
  }
};

class SearchFaults : public ::testing::TestWithParam<NamedEngine> {
 protected:
  void take(PairSearch& search, const Frame& frame, bool by_key) const {
    Span<const std::uint64_t> keys;
    if (by_key) keys = frame.keys;
    search.update(frame.scene.points, frame.scene.box, keys);
  }
  static std::string difference(PairSearch& search, const Frame& frame) {
    return frame.asked.difference(search.list(frame.asked.request));
  }
  /// A search that holds the first frame, and has listed it.
  std::unique_ptr<PairSearch> used(bool by_key) const {
    auto search = GetParam().make();
    take(*search, first_, by_key);
    EXPECT_EQ(difference(*search, first_), "");
    return search;
  }
  /// Whether a search is empty after a throw and takes both frames again.
  std::string fault_of_update(PairSearch& search, Ending ending, bool by_key) const {
    if (ending == Ending::threw) {
      const NeighborList list = search.list(ListParams{TypeCutoffs(kRadius)});
      if (list.size() != 0) return "the search still has particles";
      take(search, first_, by_key);
      const std::string fault = difference(search, first_);
      if (!fault.empty()) return after(ending, fault);
      take(search, next_, by_key);
    }
    return after(ending, difference(search, next_));
  }
  void sweep_updates(bool by_key) const {
    const auto call = [&](const std::unique_ptr<PairSearch>& search) { take(*search, next_, by_key); };
    const auto fault_of = [&](const std::unique_ptr<PairSearch>& search, Ending ending) {
      return fault_of_update(*search, ending, by_key);
    };
    expect_sound(sweep([&] { return GetParam().make(); }, call, fault_of), 2);
    const SweepResult again = sweep([&] { return used(by_key); }, call, fault_of);
    if (GetParam().only_notes_updates) {
      expect_no_memory(again);
    } else {
      expect_sound(again, 2);
    }
  }

  Frame first_{0, 0}, next_{30, 0.3};  // 30 particles leave and 30 come, where they have keys
};

TEST_P(SearchFaults, UpdateLeavesItEmpty) { sweep_updates(false); }
/// What refuses an update takes memory for its message; to become empty then, none.
TEST(SearchPartsFaults, ARefusedUpdateIsGivenUpWithoutMemory) {
  const Scene scene(kSearchPoints);
  std::vector<Vec3> broken = scene.points;
  broken[3].y = std::numeric_limits<double>::quiet_NaN();
  const auto update = [&](auto& subject) {
    try {
      subject->update(broken, scene.box);
    } catch (const InvalidPosition&) {
    }
  };
  const auto no_fault = [](const auto&, Ending) { return std::string(); };
  const SweepResult of_search = sweep(
      [&] {
        auto search = make_dch_search(kRadius);
        search->update(scene.points, scene.box);
        return search;
      },
      update, no_fault);
  const SweepResult of_hierarchy = sweep(
      [&] {
        auto hierarchy = std::make_unique<Hierarchy>(params_for());
        hierarchy->build(scene.points, scene.box);
        return hierarchy;
      },
      update, no_fault);
  expect_sound(of_search, 2);
  EXPECT_EQ(of_search.failures, of_hierarchy.failures);
}

TEST_P(SearchFaults, UpdateByKeyLeavesItEmpty) { sweep_updates(true); }

/// With size classes this is where the hierarchies are made.
TEST_P(SearchFaults, TheNextListIsRight) {
  for (const bool by_key : {false, true}) {
    const auto call = [&](const std::unique_ptr<PairSearch>& search) {
      NeighborList list;
      search->list(next_.asked.request, list);
    };
    const auto fault_of = [&](const std::unique_ptr<PairSearch>& search, Ending ending) -> std::string {
      if (search->stats().updates == 0) return "it has forgotten its updates";
      return after(ending, difference(*search, next_));
    };
    const auto with_next = [&](std::unique_ptr<PairSearch> search) {
      take(*search, next_, by_key);
      return search;
    };
    expect_sound(sweep([&] { return with_next(GetParam().make()); }, call, fault_of), 10);
    expect_sound(sweep([&] { return with_next(used(by_key)); }, call, fault_of), 4);
  }
}

/// Pieces that memory did not suffice for leave the particles as they were, for the next list.
TEST_P(SearchFaults, AListAfterPiecesThatThrewIsRight) {
  expect_sound(sweep([&] { return used(false); },
                     [&](const std::unique_ptr<PairSearch>& search) {
                       search->list_in_pieces(first_.asked.request, [](const NeighborList&) {});
                     },
                     [&](const std::unique_ptr<PairSearch>& search, Ending ending) {
                       return after(ending, difference(*search, first_));
                     }),
               1);
}

/// A list for other sizes that threw must not be taken for one that was made.
TEST_P(SearchFaults, AnUpdateAfterAListThatThrewIsRight) {
  Asked even;
  even.answer(first_.scene);
  const auto fault_of = [&](const std::unique_ptr<PairSearch>& search, Ending ending) {
    std::string fault = even.difference(search->list(even.request));
    if (!fault.empty()) return after(ending, "of other sizes: " + fault);
    take(*search, next_, false);
    fault = difference(*search, next_);
    if (!fault.empty()) return after(ending, "updated: " + fault);
    search->stats();
    return after(ending, difference(*search, next_));
  };
  expect_sound(
      sweep(
          [&] {
            auto search = GetParam().make();
            take(*search, first_, false);
            search->list(even.request);
            return search;
          },
          [&](const std::unique_ptr<PairSearch>& search) { search->list(first_.asked.request); }, fault_of),
      4);
}

/// Classes stay the same then, and their hierarchies get another radius.
TEST_P(SearchFaults, AListWithAnotherSkinIsRightTheNextTime) {
  Asked wider;
  wider.radii = first_.asked.radii;
  wider.request.radii = wider.radii;
  wider.request.skin = 0.05;
  wider.answer(first_.scene);
  expect_sound(sweep([&] { return used(false); },
                     [&](const std::unique_ptr<PairSearch>& search) { search->list(wider.request); },
                     [&](const std::unique_ptr<PairSearch>& search, Ending ending) {
                       return after(ending, wider.difference(search->list(wider.request)));
                     }),
               4);
}

/// Both kinds of requests in one call, which memory did not suffice for, and then the first of them alone.
TEST_P(SearchFaults, AListAfterSeveralThatThrewIsRight) {
  Asked narrow;
  narrow.request.cutoffs = TypeCutoffs(0.6);
  narrow.answer(first_.scene);
  const std::vector<ListParams> both{narrow.request, first_.asked.request};
  for (const bool narrow_first : {true, false}) {
    expect_sound(sweep(
                     [&] {
                       auto search = GetParam().make();
                       take(*search, first_, false);
                       return search;
                     },
                     [&](const std::unique_ptr<PairSearch>& search) { search->lists(both); },
                     [&](const std::unique_ptr<PairSearch>& search, Ending ending) {
                       const std::string fault =
                           narrow_first ? narrow.difference(search->list(narrow.request)) : "";
                       if (!fault.empty()) return after(ending, fault);
                       return after(ending, difference(*search, first_));
                     }),
                 10);
  }
}

TEST_P(SearchFaults, AVerletListIsStale) {
  Asked asked;
  asked.request.cutoffs = TypeCutoffs(0.8);
  asked.request.skin = 0.2;
  asked.answer(next_.scene);
  struct Kept {
    VerletList list;
    bool is_stale = false;
  };
  expect_sound(sweep(
                   [&] {
                     Kept kept{VerletList(GetParam().make(), asked.request)};
                     kept.list.update(first_.scene.points, first_.scene.box);
                     return kept;
                   },
                   [&](Kept& kept) { kept.list.update(next_.scene.points, next_.scene.box); },
                   [&](Kept& kept, Ending ending) {
                     const Scene& now = next_.scene;
                     if (kept.list.is_stale(now.points, now.box) != (ending == Ending::threw))
                       return std::string("it is stale if it should not be, or the other way round");
                     kept.list.update(now.points, now.box);
                     return after(ending, asked.difference(kept.list.list()));
                   }),
               4);
}

TEST_P(SearchFaults, AnUnlistedPairIsToldTheNextTime) {
  std::vector<MovedParticle> fast;
  std::vector<Vec3> points = first_.scene.points;
  for (const std::int32_t i : {3, 40, 77}) {
    points[static_cast<std::size_t>(i)].x += 0.3;
    fast.push_back({i, 0.31});
  }
  const UnlistedQuestion question{first_.asked.request, RadiusRange(first_.asked.radii), points, fast};
  const UnlistedPair expected = used(false)->unlisted_pair(question);
  const SweepResult result =
      sweep([&] { return used(false); }, [&](const auto& search) { search->unlisted_pair(question); },
            [&](const auto& search, Ending ending) -> std::string {
              if (search->unlisted_pair(question) != expected) return "another answer";
              return after(ending, difference(*search, first_));
            });
  if (expected == UnlistedPair::unknown) {
    expect_no_memory(result);
  } else {
    expect_sound(result, 2);
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, SearchFaults, ::testing::ValuesIn(engines()),
                         [](const auto& p) { return p.param.name; });

TEST(SearchPartsFaults, ASearchIsMadeOrNot) {
  for (const NamedEngine& engine : engines())
    expect_sound(
        sweep([] { return 0; }, [&](int) { engine.make(); }, [](int, Ending) { return std::string(); }), 2);
}

TEST(SearchPartsFaults, AStaleTestThatThrewIsStale) {
  const Scene before(kSearchPoints), now(2 * kSearchPoints, 3);
  expect_sound(sweep(
                   [&] {
                     StaleTest test(0.2);
                     test.remember(before.points, before.box);
                     return test;
                   },
                   [&](StaleTest& test) { test.remember(now.points, now.box); },
                   [&](StaleTest& test, Ending ending) -> std::string {
                     const bool threw = ending == Ending::threw;
                     if (threw && !test.is_stale(before.points, before.box))
                       return "it knows the old positions";
                     if (test.is_stale(now.points, now.box) != threw) return "it is wrong about the new ones";
                     return "";
                   }),
               2);
}

TEST(SearchPartsFaults, ExclusionsAreMadeOrNot) {
  std::vector<IndexPair> bonds;
  for (std::int32_t k = 1; k < 30; ++k) bonds.push_back({k - 1, k});
  const Exclusions expected = Exclusions::from_bonds(30, bonds, 3);
  expect_sound(sweep([] { return Exclusions(); },
                     [&](Exclusions& exclusions) { exclusions = Exclusions::from_bonds(30, bonds, 3); },
                     [&](const Exclusions& exclusions, Ending ending) -> std::string {
                       const std::int64_t pairs = ending == Ending::threw ? 0 : expected.pairs();
                       return exclusions.pairs() == pairs ? "" : "there are other pairs";
                     }),
               10);
}

TEST(SearchPartsFaults, AllPairsLeavesNoHalfList) {
  const Scene scene(40);
  Asked asked;
  asked.answer(scene);
  expect_sound(sweep([] { return NeighborList(); },
                     [&](NeighborList& list) { list = all_pairs(scene.points, scene.box, asked.request); },
                     [&](const NeighborList& list, Ending ending) {
                       return ending == Ending::threw ? std::string() : asked.difference(list);
                     }),
               10);
}

}  // namespace
}  // namespace dch::faults
