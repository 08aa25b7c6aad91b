// SPDX-License-Identifier: MIT
//
// The hierarchy itself: ties, aspect ratios, determinism, and what is left of it after many repairs.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include <dch/lists/all_pairs.hpp>

#include "hard_case.hpp"
#include "list_compare.hpp"
#include "list_params.hpp"
#include "listed_hierarchy.hpp"
#include "long_double_pairs.hpp"
#include "scenes.hpp"

namespace dch::hard {
namespace {

StructureParams with(double radius, double base_radius, int max_roots = 1,
                     MaintenancePolicy policy = MaintenancePolicy::always_repair) {
  StructureParams params;
  params.radius = radius;
  params.base_radius = base_radius;
  params.max_roots = max_roots;
  params.policy = policy;
  return params;
}

std::string or_valid(const std::string& fault) { return fault.empty() ? "valid" : fault; }

Finding coincident() {
  ListedHierarchy h(with(1, 0));
  h.build(std::vector<Vec3>(40, Vec3{1, 2, 3}), Box::none());
  NeighborList list;
  h.list(within(1), list);
  const std::string fault = h.validate();
  return {std::to_string(h.level(1).nodes) + " center, " + std::to_string(h.levels()) + " levels, " +
              std::to_string(list.pairs()) + " pairs, " + or_valid(fault),
          fault.empty() && h.level(1).nodes == 1 && h.levels() == 2 && list.pairs() == 780};
}

/// Lemma 5.3.1(6), corrected: at most ceil(lg alpha) + 2 levels, with R_0 in the place of the closest pair;
/// and those that are no longer needed go.
Finding levels_of(double far) {
  ListedHierarchy h(with(1, 0.5));
  h.build(std::vector<Vec3>{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {far, 0, 0}}, Box::none());
  const int levels = h.levels(),
            limit = static_cast<int>(std::ceil(std::log2(far / h.level(0).covering_radius))) + 2;
  const std::string fault = h.validate();
  h.update(std::vector<Vec3>{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {1, 0, 0}}, Box::none());
  const std::string later = h.validate();
  return {std::to_string(levels) + " levels, " + or_valid(fault) + "; when it is back " +
              std::to_string(h.levels()) + ", " + or_valid(later),
          levels <= limit && h.levels() <= 4 && fault.empty() && later.empty()};
}

/// Back and forth over the covering radius.
Finding exactly_the_covering_radius() {
  ListedHierarchy h(with(3, 1));
  const std::vector<Vec3> at{{0, 0, 0}, {1, 0, 0}}, beyond{{0, 0, 0}, {std::nextafter(1.0, 2.0), 0, 0}};
  h.build(at, Box::none());
  std::string counts = std::to_string(h.level(1).nodes), fault = h.validate();
  for (const auto& points : {beyond, at}) {
    h.update(points, Box::none());
    counts += ", " + std::to_string(h.level(1).nodes);
    if (fault.empty()) fault = h.validate();
  }
  return {counts + " centers, " + or_valid(fault), counts == "1, 2, 1" && fault.empty()};
}

/// With the thesis's text (5.5.3) an update without motion demotes and promotes most points.
Finding no_oscillation() {
  const Box box = Box::orthorhombic({5, 5, 5});
  const std::vector<Vec3> points = scenes::fcc(box, 0.5, 500);
  ListedHierarchy h(with(1, 0.5));
  h.build(points, box);
  const SearchStats before = h.stats();
  for (int pass = 0; pass < 100; ++pass) h.update(points, box);
  const std::int64_t promoted = h.stats().promotions - before.promotions,
                     demoted = h.stats().demotions - before.demotions;
  const std::string fault = h.validate();
  return {std::to_string(h.stats().repairs) + " repairs, " + std::to_string(promoted) + " promotions, " +
              std::to_string(demoted) + " demotions, " + or_valid(fault),
          h.stats().repairs == 100 && promoted == 0 && demoted == 0 && fault.empty()};
}

bool are_same(ListedHierarchy& a, ListedHierarchy& b, std::int32_t points) {
  for (std::int32_t id = 0; id < points; ++id) {
    if (a.top_level(id) != b.top_level(id)) return false;
    for (int level = 0; level <= a.top_level(id); ++level)
      if (a.parent(id, level) != b.parent(id, level)) return false;
  }
  return a.levels() == b.levels();
}

/// Face-centered cubic sites as far apart as R_0: ties at every distance.
Finding deterministic() {
  const Box box = Box::orthorhombic({5, 5, 5});
  const std::vector<Vec3> points = scenes::fcc(box, 0.5, 500);
  ListedHierarchy a(with(1, 0.5)), b(with(1, 0.5));
  a.build(points, box);
  b.build(points, box);
  NeighborList first, second;
  a.list(within(1), first);
  b.list(within(1), second);
  const bool same = are_same(a, b, static_cast<std::int32_t>(points.size()));
  const std::string difference = first_difference(first, second), fault = a.validate();
  return {std::string(same ? "the same" : "other") + " parents in all levels, " +
              (difference.empty() ? "the same list" : difference) + ", " + or_valid(fault),
          same && difference.empty() && fault.empty()};
}

std::int64_t edges_of(ListedHierarchy& h) {
  std::int64_t edges = 0;
  for (int level = 1; level < h.levels(); ++level) edges += h.level(level).edges;
  return edges;
}

/// A random walk of all points, wrapped by nobody, with a repair at every step; then against one built anew.
Finding repaired(int repairs) {
  const Box box = Box::orthorhombic({5, 5, 5});
  std::vector<Vec3> points = scenes::uniform_in(box, 60, 21);
  scenes::Random random(22);
  ListedHierarchy kept(with(1, 0.5)), fresh(with(1, 0.5));
  kept.build(points, box);
  std::size_t most[2] = {0, 0};  // memory in the first half and in the second
  for (int k = 0; k < repairs; ++k) {
    for (Vec3& p : points) p = p + random.in_cube(k % 100 == 0 ? 1.0 : 0.02);
    kept.update(points, box);
    std::size_t& memory = most[2 * k >= repairs];
    memory = std::max(memory, kept.stats().memory_bytes);
  }
  fresh.build(points, box);
  NeighborList list;
  kept.list(within(1), list);
  const PairComparison pairs = compare_pairs(list, points, box, 1);
  const std::string fault = kept.validate();
  const double edges = static_cast<double>(edges_of(kept)) / static_cast<double>(edges_of(fresh)),
               grown = static_cast<double>(most[1]) / static_cast<double>(most[0]);
  return {std::to_string(kept.stats().repairs) + " repairs: " + or_valid(fault) + ", " + pairs.text() + ", " +
              std::to_string(kept.levels()) + " levels (built anew " + std::to_string(fresh.levels()) +
              "), " + three_digits(edges) + " times as many edges; at most " + three_digits(grown) +
              " times the memory in the second half",
          fault.empty() && pairs.is_right() && kept.stats().repairs == repairs && kept.stats().builds == 1 &&
              std::abs(kept.levels() - fresh.levels()) <= 1 && edges < 1.5 && grown < 1.1};
}

}  // namespace

std::vector<Case> structure_cases(const Effort& effort) {
  const auto grouped = [](int number) {
    std::string text = std::to_string(number);
    for (int at = static_cast<int>(text.size()) - 3; at > 0; at -= 3)
      text.insert(static_cast<std::size_t>(at), ",");
    return text;
  };
  return {
      {"structure", "40 atoms on one spot", "1 center, 780 pairs, no loop", coincident},
      {"structure", "three on one spot and one at 1e12", "at most 43 levels; when it is back at most 4",
       [] { return levels_of(1e12); }},
      {"structure", "distance exactly R_0, one rounding step more, and back", "1, 2, 1 centers",
       exactly_the_covering_radius},
      {"structure", "repairs without motion, distances of exactly R_0", "no promotion, no demotion",
       no_oscillation},
      {"structure", "face-centered cubic, neighbors at R_0", "the same every time", deterministic},
      {"structure", grouped(effort.repairs) + " repairs in a row",
       "valid, all pairs in long double, no larger than built anew",
       [effort] { return repaired(effort.repairs); }},
  };
}

}  // namespace dch::hard
