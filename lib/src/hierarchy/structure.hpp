// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <dch/geometry/box.hpp>
#include <dch/hierarchy/search_stats.hpp>

#include "geometry/tolerance.hpp"
#include "hierarchy/leaf_blocks.hpp"
#include "hierarchy/level.hpp"
#include "hierarchy/measured_leaves.hpp"
#include "hierarchy/structure_params.hpp"
#include "hierarchy/subtree_balls.hpp"

namespace dch::detail {

/// The data of a hierarchy: points, levels, edges, and what is certified of them while a repair is put off.
/// The stages that change it are in hierarchy_impl.hpp; all others take it constant, by a HierarchyView.
struct Structure {
  StructureParams params;
  Box box;
  double base_radius = 0;     ///< R_0
  LeafBlocks points;          ///< level 0
  std::vector<Level> levels;  ///< level 1 always, levels[0] holds radii only
  std::vector<Vec3> raw;      ///< positions as given, by id
  std::vector<std::int32_t>
      slot_of_id;  ///< level-0 node of a point, kNone for free ids, or place_of_singleton()
  std::vector<std::int32_t> free_ids;  ///< min-heap
  SearchStats stats;

  /// A node without nodes below it in memory, since it has neither edges nor other descendants than itself.
  struct Singleton {
    int level;  ///< at least 2
    std::int32_t node;
  };
  std::vector<Singleton> singletons;
  bool placing_later = false;  ///< while building: slot_of_id holds parents

  /// Added to the thresholds of all levels but 0: how far the distance of wrapped points may be from the pair
  /// distance that lists go by. About 1e-13 of the box, more if a point lies very many boxes away.
  double wrap_slack = 0;
  double largest_reach = 0;  ///< largest WrapError::reach of the points [length]

  /// Whether points have moved since the structure was in order; the edges of level 1 are certified all the
  /// same to join all leaves with points within rho_0 of each other, and lists need no more.
  bool pending = false;
  std::vector<Vec3> anchors;  ///< while pending: where the nodes of level 1 were when it was in order
  double motion = 0;  ///< while pending: how far nodes of level 1 are from their anchors at most [length]
  MeasuredLeaves leaves;
  bool measured = false;              ///< whether `leaves` holds the points as they are now
  std::optional<SubtreeBalls> balls;  ///< kept up while there are any
  std::int64_t misplaced = 0;  ///< nodes that changed their parent since the nodes were last put in order

  std::size_t count() const { return slot_of_id.size() - free_ids.size(); }
  bool contains(std::int32_t id) const {
    return id >= 0 && static_cast<std::size_t>(id) < slot_of_id.size() && slot_of_id[id] != kNone;
  }
  int top() const { return static_cast<int>(levels.size()) - 1; }

  // The nodes of all levels alike
  std::int32_t size(int level) const { return level == 0 ? points.size() : levels[level].size(); }
  std::int32_t alive(int level) const { return level == 0 ? points.alive : levels[level].alive(); }
  bool is_alive(int level, std::int32_t k) const { return id(level, k) != kNone; }
  std::int32_t id(int level, std::int32_t k) const { return level == 0 ? points.id[k] : levels[level].id[k]; }
  Vec3 position(int level, std::int32_t k) const {
    return level == 0 ? position_in(k, box) : levels[level].position[k];
  }
  /// Of the point in a slot, wrapped. `in` wraps positions: the metric of the box, or the box.
  template <class Wrapping>
  Vec3 position_in(std::int32_t slot, const Wrapping& in) const {
    return points.keeps_positions ? points.position[slot] : in.wrap(raw[points.id[slot]]);
  }
  std::int32_t parent(int level, std::int32_t k) const {
    return level == 0 ? points.parent(k) : levels[level].parent[k];
  }
  /// Own node in the level above, or kNone.
  std::int32_t up(int level, std::int32_t k) const {
    if (level > 0) return levels[level].up[k];
    const std::int32_t leaf = points.parent(k);
    return levels[1].down[leaf] == k ? leaf : kNone;
  }
  /// Calls f(child) for the children of node `k` of level `level` >= 1.
  template <class F>
  void for_each_child(int level, std::int32_t k, const F& f) const {
    std::int32_t child = levels[level].first_child[k];
    if (level == 1) return points.for_each(child, f);
    for (; child != kNone; child = levels[level - 1].next_sibling[child]) f(child);
  }

  /// A node of some level >= target, the nearer the cheaper; none to descend from the roots.
  struct Hint {
    int level = 0;
    std::int32_t node = kNone;
  };

  std::int32_t node_of(std::int32_t id, int level) const;

  // Points on their own
  /// What slot_of_id and Level::down hold for the k-th singleton; an involution.
  static std::int32_t place_of_singleton(std::int32_t k) { return -2 - k; }
  static std::int32_t singleton_at(std::int32_t place) { return -2 - place; }
  bool is_singleton(int level, std::int32_t node) const {
    return level > 1 && levels[level].down[node] < kNone;
  }
  /// Whether a point's node of some level is not in memory, being on its own.
  bool stands_alone(std::int32_t id, int level) const {
    return level >= 0 && id >= 0 && static_cast<std::size_t>(id) < slot_of_id.size() &&
           is_singleton_point(id) && level < lowest_node(id).level;
  }
  bool is_singleton_point(std::int32_t id) const { return slot_of_id[id] < kNone; }
  /// Number of singletons of the levels above.
  std::int32_t singletons_above(int level) const;
  /// Points that are singletons, by id.
  std::vector<std::int32_t> singleton_ids() const;
  /// Lowest node of a point that is in memory: its leaf, or the singleton.
  Hint lowest_node(std::int32_t id) const {
    if (is_singleton_point(id))
      return {singletons[singleton_at(slot_of_id[id])].level, singletons[singleton_at(slot_of_id[id])].node};
    return {1, points.parent(slot_of_id[id])};
  }

  /// Appends the neighbors of a node in its level of G_c.
  template <class Metric>
  void neighbors(const Metric& metric, int level, std::int32_t node, std::vector<std::int32_t>& nodes) const;
};

}  // namespace dch::detail
