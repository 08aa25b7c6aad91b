// SPDX-License-Identifier: MIT
//
// What changes a hierarchy leaves an empty one if memory runs out; renumber() leaves it as it was.
#include <numeric>

#include "listed_hierarchy.hpp"
#include "scene.hpp"

namespace dch::faults {
namespace {

constexpr std::size_t kHierarchyPoints = 80;

/// A hierarchy that has its points, and the list of other ones.
struct Changes {
  explicit Changes(const StructureParams& with, double shake = 0.3)
      : params(with), first(kHierarchyPoints), next(first.shaken(shake)) {
    asked_first.answer(first);
    asked_next.answer(next);
  }
  ListedHierarchy empty() const { return ListedHierarchy(params); }
  /// Moved before, so that scratch space is there or not, as it comes.
  ListedHierarchy built() const {
    ListedHierarchy hierarchy(params);
    hierarchy.build(first.points, first.box);
    return hierarchy;
  }
  /// Whether a hierarchy is empty after a throw, and takes points again.
  std::string fault_of_next(ListedHierarchy& hierarchy, Ending ending) const {
    if (ending == Ending::threw) {
      std::string fault = fault_of_empty(hierarchy);
      if (!fault.empty()) return after(ending, fault);
      hierarchy.build(first.points, first.box);
      fault = list_fault(hierarchy, asked_first);
      if (!fault.empty()) return after(ending, fault);
      hierarchy.update(next.points, next.box);
    }
    return after(ending, list_fault(hierarchy, asked_next));
  }

  StructureParams params;
  Scene first, next;
  Asked asked_first, asked_next;
};

TEST(HierarchyFaults, AHierarchyIsMadeOrNot) {
  const SweepResult result = sweep([] { return 0; }, [](int) { ListedHierarchy hierarchy(params_for()); },
                                   [](int, Ending) { return std::string(); });
  expect_sound(result, 4);
}

std::string build_fault(const Changes& changes, ListedHierarchy& hierarchy, Ending ending) {
  if (ending == Ending::threw) {
    const std::string fault = fault_of_empty(hierarchy);
    if (!fault.empty()) return fault;
    hierarchy.build(changes.next.points, changes.next.box);
  }
  return after(ending, list_fault(hierarchy, changes.asked_next));
}

TEST(HierarchyFaults, BuildLeavesItEmpty) {
  for (const EdgeRule rule : {EdgeRule::additive, EdgeRule::thesis}) {
    StructureParams params = params_for();
    params.edge_rule = rule;
    params.max_roots = 1;
    const Changes changes(params);
    const auto call = [&](ListedHierarchy& hierarchy) {
      hierarchy.build(changes.next.points, changes.next.box);
    };
    const auto fault_of = [&](ListedHierarchy& hierarchy, Ending ending) {
      return build_fault(changes, hierarchy, ending);
    };
    expect_sound(sweep([&] { return changes.empty(); }, call, fault_of), 150);
    expect_sound(sweep([&] { return changes.built(); }, call, fault_of), 100);
  }
}

void sweep_updates(MaintenancePolicy policy, double shake, Executor* executor, long least_allocations) {
  StructureParams params = params_for(executor);
  params.policy = policy;
  params.base_radius = 0.6;
  const Changes changes(params, shake);
  expect_sound(
      sweep([&] { return changes.built(); },
            [&](ListedHierarchy& hierarchy) { hierarchy.update(changes.next.points, changes.next.box); },
            [&](ListedHierarchy& hierarchy, Ending ending) {
              return changes.fault_of_next(hierarchy, ending);
            }),
      least_allocations);
}

TEST(HierarchyFaults, PutOffRepairLeavesItEmpty) {
  sweep_updates(MaintenancePolicy::automatic, 0.02, nullptr, 10);
}
TEST(HierarchyFaults, RepairLeavesItEmpty) {
  sweep_updates(MaintenancePolicy::always_repair, 0.3, nullptr, 100);
}
TEST(HierarchyFaults, RebuildLeavesItEmpty) {
  sweep_updates(MaintenancePolicy::always_rebuild, 0.3, nullptr, 100);
}
TEST(HierarchyFaults, RepairOnThreadsLeavesItEmpty) {
  const auto pool = make_thread_pool(3);
  sweep_updates(MaintenancePolicy::always_repair, 0.3, pool.get(), 100);
}

/// Gas, most of whose points stand on their own.
TEST(HierarchyFaults, SingletonsLeaveItEmpty) {
  StructureParams params = params_for();
  params.policy = MaintenancePolicy::always_repair;
  params.max_roots = 2;
  Scene gas(40), later(40);
  gas.box = later.box = Box::orthorhombic({60, 60, 60});
  gas.points = scenes::uniform_in(gas.box, 40, 3);
  later.points = gas.shaken(8).points;
  Asked asked;
  asked.answer(later);
  expect_sound(sweep(
                   [&] {
                     ListedHierarchy hierarchy(params);
                     hierarchy.build(gas.points, gas.box);
                     return hierarchy;
                   },
                   [&](ListedHierarchy& hierarchy) { hierarchy.update(later.points, later.box); },
                   [&](ListedHierarchy& hierarchy, Ending ending) {
                     if (ending == Ending::threw) {
                       const std::string fault = fault_of_empty(hierarchy);
                       if (!fault.empty()) return fault;
                       hierarchy.build(later.points, later.box);
                     }
                     return after(ending, list_fault(hierarchy, asked));
                   }),
               50);
}

TEST(HierarchyFaults, RepairThatWasPutOffLeavesItEmpty) {
  StructureParams params = params_for();
  params.base_radius = 0.6;
  const Changes changes(params, 0.05);
  expect_sound(sweep(
                   [&] {
                     ListedHierarchy hierarchy = changes.built();
                     hierarchy.update(changes.next.points, changes.next.box);
                     EXPECT_TRUE(hierarchy.repair_pending());
                     return hierarchy;
                   },
                   [](ListedHierarchy& hierarchy) { hierarchy.repair(); },
                   [&](ListedHierarchy& hierarchy, Ending ending) {
                     return changes.fault_of_next(hierarchy, ending);
                   }),
               20);
}

/// Some points come or go, in a hierarchy of `all` but these, which may keep up what queries need.
template <class Change>
void sweep_exchange(bool keeps_up, const Change& change, const std::vector<Vec3>& expected,
                    long least_allocations) {
  StructureParams params = params_for();
  params.base_radius = 0.6;
  const Changes changes(params);
  Scene other = changes.first;
  other.points = expected;
  Asked asked;
  asked.answer(other);
  const auto built = [&] {
    ListedHierarchy hierarchy = changes.built();
    if (keeps_up) hierarchy.kept_view();
    return hierarchy;
  };
  expect_sound(sweep(built, change,
                     [&](ListedHierarchy& hierarchy, Ending ending) {
                       if (ending == Ending::threw) {
                         const std::string fault = fault_of_empty(hierarchy);
                         if (!fault.empty()) return after(ending, fault);
                         hierarchy.build(other.points, other.box);
                       }
                       std::vector<std::int32_t> ids(other.points.size());
                       std::iota(ids.begin(), ids.end(), 0);
                       hierarchy.renumber(ids);  // without those that were removed
                       return after(ending, list_fault(hierarchy, asked));
                     }),
               least_allocations);
}

TEST(HierarchyFaults, InsertLeavesItEmpty) {
  const Scene scene(kHierarchyPoints), more(30, 5);
  std::vector<Vec3> expected = scene.points;
  expected.insert(expected.end(), more.points.begin(), more.points.end());
  for (const bool keeps_up : {false, true})
    sweep_exchange(
        keeps_up,
        [&](ListedHierarchy& hierarchy) {
          for (const Vec3 p : more.points) hierarchy.insert(p);
        },
        expected, 30);
}

TEST(HierarchyFaults, RemoveLeavesItEmpty) {
  const Scene scene(kHierarchyPoints);
  constexpr std::size_t kLeft = 10;
  for (const bool keeps_up : {false, true})
    sweep_exchange(
        keeps_up,
        [&](ListedHierarchy& hierarchy) {
          for (std::size_t id = kLeft; id < kHierarchyPoints; ++id)
            hierarchy.remove(static_cast<std::int32_t>(id));
        },
        {scene.points.begin(), scene.points.begin() + kLeft}, 50);
}

TEST(HierarchyFaults, RenumberLeavesItAsItWas) {
  const Changes changes(params_for());
  std::vector<std::int32_t> reversed;
  for (std::size_t k = kHierarchyPoints; k-- > 0;) reversed.push_back(static_cast<std::int32_t>(k));
  Scene turned = changes.first;
  turned.points.assign(changes.first.points.rbegin(), changes.first.points.rend());
  Asked asked;
  asked.answer(turned);
  expect_sound(sweep([&] { return changes.built(); },
                     [&](ListedHierarchy& hierarchy) { hierarchy.renumber(reversed); },
                     [&](ListedHierarchy& hierarchy, Ending ending) {
                       if (ending == Ending::threw) {
                         const std::string fault = list_fault(hierarchy, changes.asked_first);
                         if (!fault.empty()) return fault;
                         hierarchy.renumber(reversed);
                       }
                       return after(ending, list_fault(hierarchy, asked));
                     }),
               5);
}

}  // namespace
}  // namespace dch::faults
