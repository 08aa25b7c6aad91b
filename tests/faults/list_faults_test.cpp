// SPDX-License-Identifier: MIT
//
// A list that memory did not suffice for is empty, and the next one is right: what the search keeps between
// lists serves it again.
#include <functional>
#include <ostream>
#include <string>

#include "cluster_pair_check.hpp"
#include "scene.hpp"

namespace dch::faults {
namespace {

constexpr std::size_t kListPoints = 120;

struct NamedRequest {
  std::string name;
  std::function<void(Asked&)> ask;
};

std::ostream& operator<<(std::ostream& out, const NamedRequest& request) { return out << request.name; }

void with_types(Asked& asked) {
  for (std::size_t k = 0; k < kListPoints; ++k) asked.types.push_back(static_cast<std::int32_t>(k % 3));
  asked.request.cutoffs = TypeCutoffs(3, {1, 0.8, 0.6, 0.8, 0.5, 0, 0.6, 0, 0.9});
  asked.request.types = asked.types;
}

void with_radii(Asked& asked) {
  for (std::size_t k = 0; k < kListPoints; ++k) asked.radii.push_back(k % 5 == 0 ? 0.45 : 0.2);
  asked.request.radii = asked.radii;
  asked.request.skin = 0.1;
}

void with_exclusions(Asked& asked) {
  std::vector<IndexPair> bonds;
  for (std::int32_t k = 1; k < static_cast<std::int32_t>(kListPoints); ++k) bonds.push_back({k - 1, k});
  asked.exclusions = Exclusions::from_bonds(kListPoints, bonds, 2);
  asked.request.exclusions = &asked.exclusions;
}

std::vector<NamedRequest> all_requests() {
  return {
      {"half", [](Asked&) {}},
      {"full", [](Asked& a) { a.request.kind = ListKind::full; }},
      {"unsorted", [](Asked& a) { a.request.order = RowOrder::unsorted; }},
      {"full_unsorted",
       [](Asked& a) {
         a.request.kind = ListKind::full;
         a.request.order = RowOrder::unsorted;
       }},
      {"with_shell",
       [](Asked& a) {
         a.request.order = RowOrder::unsorted;
         a.request.cutoffs = TypeCutoffs(0.8);
         a.request.skin = a.request.shell = 0.2;
       }},
      {"with_ghosts", [](Asked& a) { a.request.first_ghost = static_cast<std::int32_t>(kListPoints / 2); }},
      {"with_exclusions", with_exclusions},
      {"with_types", with_types},
      {"with_radii", with_radii},
  };
}

/// Hierarchies that hold the points, one that has made no list and one that has made small ones.
struct Subject {
  ListedHierarchy hierarchy;
  NeighborList list;
};

class ListFaults : public ::testing::TestWithParam<NamedRequest> {
 protected:
  ListFaults() {
    GetParam().ask(asked_);
    asked_.answer(scene_);
  }

  Subject fresh(Executor* executor) const {
    Subject subject{ListedHierarchy(params_for(executor)), {}};
    subject.hierarchy.build(scene_.points, scene_.box);
    return subject;
  }
  Subject used(Executor* executor) const {
    Subject subject{ListedHierarchy(params_for(executor)), {}};
    const Scene thin(20);
    ListParams request;
    request.cutoffs = TypeCutoffs(0.3);
    subject.hierarchy.build(thin.points, thin.box);
    NeighborList small;
    subject.hierarchy.list(request, small);
    subject.hierarchy.build(scene_.points, scene_.box);
    return subject;
  }
  std::string fault_of(Subject& subject, Ending ending) const {
    if (ending == Ending::threw && subject.list.size() != 0) return "the list is not empty";
    if (ending == Ending::returned) {
      const std::string fault = asked_.difference(subject.list);
      if (!fault.empty()) return after(ending, fault);
    }
    for (int turn = 0; turn < 2; ++turn) {
      subject.hierarchy.list(asked_.request, subject.list);
      const std::string fault = asked_.difference(subject.list);
      if (!fault.empty()) return after(ending, "the next list: " + fault);
    }
    return after(ending, subject.hierarchy.validate());
  }
  void sweep_on(Executor* executor) const {
    const auto call = [&](Subject& subject) { subject.hierarchy.list(asked_.request, subject.list); };
    const auto fault = [&](Subject& subject, Ending ending) { return fault_of(subject, ending); };
    expect_sound(sweep([&] { return fresh(executor); }, call, fault), 60);
    expect_sound(sweep([&] { return used(executor); }, call, fault), 20);
  }

  Scene scene_{kListPoints};
  Asked asked_;
};

TEST_P(ListFaults, TheNextListIsRight) { sweep_on(nullptr); }

TEST_P(ListFaults, TheNextListOnThreadsIsRight) {
  const auto pool = make_thread_pool(2);
  sweep_on(pool.get());
}

/// The same that cluster pairs are made for.
TEST_P(ListFaults, TheNextClusterPairsAreRight) {
  struct Pairs {
    ListedHierarchy hierarchy;
    ClusterPairs pairs;
  };
  const Scene moved = scene_.shaken(0.02);
  ListParams request = asked_.request;
  request.order = RowOrder::by_index;
  request.shell = 0;
  ListParams held = request;  // whatever radii there are, all pairs within the largest list radius
  held.cutoffs = TypeCutoffs(request.radii.empty() ? request.cutoffs : TypeCutoffs(0.9));
  held.radii = {};
  const auto call = [&](Pairs& subject) { subject.hierarchy.cluster_pairs(request, subject.pairs); };
  const auto fault_of = [&](Pairs& subject, Ending ending) {
    if (ending == Ending::threw && (subject.pairs.clusters() != 0 || !subject.pairs.rows.empty()))
      return std::string("the pairs are not empty");
    if (ending == Ending::threw) call(subject);
    const std::string fault = cluster_pair_fault(subject.pairs, moved.points, moved.box, held);
    return after(ending, fault);
  };
  const auto searched_before = [&] {
    Pairs subject{ListedHierarchy(params_for()), {}};
    subject.hierarchy.build(scene_.points, scene_.box);
    call(subject);
    subject.hierarchy.update(moved.points, moved.box);
    return subject;
  };
  const auto fresh = [&] {
    Pairs subject{ListedHierarchy(params_for()), {}};
    subject.hierarchy.build(moved.points, moved.box);
    return subject;
  };
  expect_sound(sweep(fresh, call, fault_of), 60);
  expect_sound(sweep(searched_before, call, fault_of), 4);
}

INSTANTIATE_TEST_SUITE_P(Requests, ListFaults, ::testing::ValuesIn(all_requests()),
                         [](const auto& p) { return p.param.name; });

/// A host's decision that throws is no different.
TEST(ListsFaults, AListThatAHostEndedIsFollowedByARightOne) {
  struct Refusing final : TieBreaker {
    explicit Refusing(int after) : TieBreaker(0.09), left(after) {}
    bool accepts(std::int32_t, std::int32_t) const override {
      if (--left < 0) throw std::bad_alloc();
      return false;
    }
    mutable int left;
  };
  const Scene scene(kListPoints);
  Asked asked;
  asked.request.cutoffs = TypeCutoffs(0.9);
  asked.answer(scene);
  ListedHierarchy hierarchy(params_for());
  hierarchy.build(scene.points, scene.box);
  for (int turn = 0; turn < 40; ++turn) {
    const Refusing refusing(turn);
    ListParams request = asked.request;
    request.tie_breaker = &refusing;
    NeighborList list;
    EXPECT_THROW(hierarchy.list(request, list), std::bad_alloc);
    EXPECT_EQ(list.size(), 0u);
    EXPECT_EQ(list_fault(hierarchy, asked), "");
  }
}

TEST(ListsFaults, SeveralListsAreRightTheNextTime) {
  const Scene scene(kListPoints);
  Asked wide, narrow, typed;
  narrow.request.cutoffs = TypeCutoffs(0.5);
  with_types(typed);
  for (Asked* asked : {&wide, &narrow, &typed}) asked->answer(scene);
  struct Lists {
    ListedHierarchy hierarchy;
    std::vector<NeighborList> lists;
  };
  for (const auto& requests : {std::vector<ListParams>{narrow.request, wide.request},
                               std::vector<ListParams>{narrow.request, typed.request}}) {
    const Asked& last = requests[1].types.empty() ? wide : typed;
    const auto call = [&](Lists& subject) { subject.hierarchy.lists(requests, subject.lists); };
    expect_sound(sweep(
                     [&] {
                       Lists subject{ListedHierarchy(params_for()), {}};
                       subject.hierarchy.build(scene.points, scene.box);
                       return subject;
                     },
                     call,
                     [&](Lists& subject, Ending ending) {
                       for (const NeighborList& list : subject.lists)
                         if (ending == Ending::threw && list.size() != 0)
                           return std::string("a list is not empty");
                       call(subject);
                       const std::string fault = narrow.difference(subject.lists[0]);
                       return after(ending, fault.empty() ? last.difference(subject.lists[1]) : fault);
                     }),
                 60);
  }
}

}  // namespace
}  // namespace dch::faults
