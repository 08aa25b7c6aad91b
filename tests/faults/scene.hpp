// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/lists/all_pairs.hpp>

#include "list_compare.hpp"
#include "listed_hierarchy.hpp"
#include "random.hpp"
#include "scenes.hpp"
#include "sweep.hpp"

namespace dch::faults {

inline constexpr double kRadius = 1.0;

/// Small enough for thousands of calls.
struct Scene {
  Box box = Box::orthorhombic({4, 4.5, 5});
  std::vector<Vec3> points;

  explicit Scene(std::size_t n, std::uint64_t seed = 1) : points(scenes::uniform_in(box, n, seed)) {}

  /// All points displaced by up to that much.
  Scene shaken(double by, std::uint64_t seed = 7) const {
    Scene moved = *this;
    scenes::Random random(seed);
    for (Vec3& p : moved.points) p = p + random.in_ball(by);
    return moved;
  }
};

/// What is asked for, and what all pairs say. Views into it stay good where it is.
struct Asked {
  ListParams request;
  std::vector<double> radii;
  std::vector<std::int32_t> types;
  Exclusions exclusions;
  NeighborList expected;

  Asked() { request.cutoffs = TypeCutoffs(kRadius); }
  Asked(const Asked&) = delete;
  Asked& operator=(const Asked&) = delete;

  void answer(const Scene& scene) {
    ListParams by_index = request;
    by_index.order = RowOrder::by_index;
    by_index.superset = false;
    by_index.shell = 0;
    expected = all_pairs(scene.points, scene.box, by_index);
  }
  /// What is wrong with a list.
  std::string difference(const NeighborList& list) const {
    if (request.order == RowOrder::by_index) return first_difference(list, expected);
    return first_difference(sorted_by_index(list, expected.size()), expected);
  }
};

inline HierarchyParams params_for(Executor* executor = nullptr) {
  HierarchyParams params;
  params.radius = kRadius;
  params.executor = executor;
  return params;
}

inline std::string after(Ending ending, const std::string& fault) {
  return fault.empty() ? fault
                       : (ending == Ending::threw ? "after a throw: " : "after it returned: ") + fault;
}

/// Empty, or why an object that threw is neither as before nor empty.
inline std::string fault_of_empty(ListedHierarchy& hierarchy) {
  if (hierarchy.size() != 0) return "the hierarchy still has " + std::to_string(hierarchy.size()) + " points";
  return hierarchy.validate();
}

inline std::string list_fault(ListedHierarchy& hierarchy, const Asked& asked) {
  const std::string invalid = hierarchy.validate();
  if (!invalid.empty()) return invalid;
  NeighborList list;
  hierarchy.list(asked.request, list);
  return asked.difference(list);
}

}  // namespace dch::faults
