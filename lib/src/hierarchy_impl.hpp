// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <dch/hierarchy.hpp>

#include "block_order.hpp"
#include "candidate_buffer.hpp"
#include "cluster_pair_finder.hpp"
#include "cluster_points.hpp"
#include "hierarchy_level.hpp"
#include "list_finder.hpp"
#include "list_source.hpp"
#include "maintenance_cost.hpp"
#include "metric.hpp"
#include "point_blocks.hpp"
#include "sibling_store.hpp"

namespace dch {

/// Candidate radii (never decisions) are inflated by this factor, squared radii by its square, so that
/// rounding in the triangle inequality cannot hide a node.
inline constexpr double kInflate = 1 + 1e-12;

/// How far points may move, in units of R_0, before the edges of level 1 have to be made anew, where repair
/// is put off. More: fewer repairs, more edges for lists to dismiss.
inline constexpr double kMotionSlack = 0.4;

/// How much farther than rho_i edges of level i >= 2 reach, in units of R_i, so that they need not be
/// enumerated anew at each repair. More: fewer enumerations, more edges.
inline constexpr double kEdgeSlack = 0.1;

inline constexpr double kMinC = 1.05, kMaxC = 1000;

struct Hierarchy::Impl {
  using Level = detail::Level;

  explicit Impl(const HierarchyParams& p) : params(p) { reset(Box()); }

  HierarchyParams params;
  Box box;
  double base_radius = 0;                ///< R_0
  detail::PointBlocks points;            ///< level 0
  std::vector<Level> levels;             ///< level 1 always, levels[0] holds radii only
  std::vector<Vec3> raw;                 ///< positions as given, by id
  std::vector<std::int32_t> slot_of_id;  ///< level-0 node of a point, kNone for free ids, or place_of_lone()
  std::vector<std::int32_t> free_ids;    ///< min-heap
  SearchStats stats;

  /// A node without nodes below it in memory, since it has neither edges nor other descendants than itself.
  struct LoneNode {
    int level;  ///< at least 2
    std::int32_t node;
  };
  std::vector<LoneNode> lone;
  bool placing_later = false;  ///< while building: slot_of_id holds parents

  /// Added to the thresholds of all levels but 0: how far the distance of wrapped points may be from the pair
  /// distance that lists go by. About 1e-13 of the box, more if a point lies very many boxes away.
  double wrap_slack = 0;
  double largest_reach = 0;  ///< largest WrapError::reach of the points [length]

  /// Whether points have moved since the structure was in order; the edges of level 1 are certified all the
  /// same to join all clusters with points within rho_0 of each other, and lists need no more.
  bool pending = false;
  std::vector<Vec3> anchors;      ///< while pending: where the nodes of level 1 were when it was in order
  detail::MaintenanceWork ahead;  ///< what the last choice between repair and build went by
  double motion = 0;  ///< while pending: how far nodes of level 1 are from their anchors at most [length]
  detail::ClusterPoints cluster_points;
  bool measured = false;     ///< whether cluster_points holds the points as they are now
  std::int64_t strayed = 0;  ///< nodes that changed their parent since the nodes were last put in order

  /// To be called when points have come, gone or changed their cluster, slot or id.
  void note_new_places() {
    measured = false;
    cluster_points.forget_layout();
  }

  int top() const { return static_cast<int>(levels.size()) - 1; }
  void check_base_radius(const Box& b) const;
  double radius_of_level(int i) const;
  double threshold_of_level(int i) const;
  bool finds_base_radius() const { return params.base_radius == 0 && params.edge_rule == EdgeRule::additive; }
  void set_base_radius(Span<const Vec3> positions);
  void set_wrap_slack();
  void set_lengths(int i);

  // The nodes of all levels alike
  std::int32_t size(int level) const { return level == 0 ? points.size() : levels[level].size(); }
  std::int32_t alive(int level) const { return level == 0 ? points.alive : levels[level].alive(); }
  bool is_alive(int level, std::int32_t k) const { return id(level, k) != detail::kNone; }
  std::int32_t id(int level, std::int32_t k) const { return level == 0 ? points.id[k] : levels[level].id[k]; }
  Vec3 position(int level, std::int32_t k) const {
    return level == 0 ? points.position[k] : levels[level].position[k];
  }
  std::int32_t parent(int level, std::int32_t k) const {
    return level == 0 ? points.parent(k) : levels[level].parent[k];
  }
  /// Own node in the level above, or kNone.
  std::int32_t up(int level, std::int32_t k) const {
    if (level > 0) return levels[level].up[k];
    const std::int32_t cluster = points.parent(k);
    return levels[1].down[cluster] == k ? cluster : detail::kNone;
  }
  /// Calls f(child) for the children of node `k` of level `level` >= 1.
  template <class F>
  void for_each_child(int level, std::int32_t k, const F& f) const {
    std::int32_t child = levels[level].first_child[k];
    if (level == 1) return points.for_each(child, f);
    for (; child != detail::kNone; child = levels[level - 1].next_sibling[child]) f(child);
  }

  // Places for nodes
  struct Cover {
    int level;  ///< lowest level >= target with a node within R_{level-1}; top() + 1 if there is none
    std::int32_t parent;  ///< that node, the nearest one; kNone if there is none
  };
  /// A node of some level >= target, the nearer the cheaper; none to descend from the roots.
  struct Hint {
    int level = 0;
    std::int32_t node = detail::kNone;
  };

  // hierarchy.cpp: whole-structure operations
  void reset(const Box& b);
  /// Runs what changes the structure. If that throws, nothing is left of it: an empty hierarchy, for which
  /// reset() takes no memory.
  template <class Change>
  void change_or_empty(const Change& change) {
    try {
      change();
    } catch (...) {
      reset(Box());
      throw;
    }
  }
  void push_level();
  void pop_level();
  std::int32_t take_free_id();
  std::int32_t node_of(std::int32_t id, int level) const;
  std::size_t memory_bytes() const;

  // hierarchy_build.cpp
  void build(Span<const Vec3> positions, const Box& b);
  /// Some points close to each other, to find parents for together.
  struct Batch {
    const std::int32_t* ids;
    std::size_t size;
    Vec3 center;
    double extent;  ///< of the farthest point from the center, wrapped but not by nearest images [length]
  };
  template <class Metric>
  void choose_clusters(const Metric& metric);
  template <class Metric>
  void settle_batch(const Metric& metric, const Batch& batch);
  template <class Metric>
  Hint cluster_for(const Metric& metric, Vec3 at, std::int32_t id, Hint hint);
  template <class Metric>
  void place_points(const Metric& metric);

  // hierarchy_blocks.hpp
  /// Points by their cluster.
  struct Members {
    std::vector<std::int32_t> index;  ///< those of cluster k from first[k] to first[k + 1]
    std::vector<std::int32_t> first;

    void sort(const std::vector<std::int32_t>& cluster_of, std::int32_t clusters);
  };
  /// Puts points into blocks, each point into the nearest cluster that an edge joins to its own. Their ids
  /// and positions depend on their indices, and so do their clusters, which are negative for what is no
  /// point.
  template <class Metric, class IdOf, class PositionOf>
  void fill_clusters(const Metric& metric, detail::PointBlocks& blocks, std::vector<std::int32_t>& cluster_of,
                     const IdOf& id_of, const PositionOf& position_of);
  template <class Metric, class PositionOf>
  void choose_nearest(const Metric& metric, const Members& members, std::vector<std::int32_t>& cluster_of,
                      const PositionOf& position_of);
  /// Puts the points of a cluster, in no order yet, into blocks. Their ids and positions depend on their
  /// indices.
  template <class IdOf, class PositionOf>
  void fill_cluster(detail::PointBlocks& blocks, std::int32_t cluster, std::vector<detail::LocalPoint>& local,
                    const IdOf& id_of, const PositionOf& position_of);

  // hierarchy_lone.cpp: points on their own
  /// What slot_of_id and Level::down hold for the k-th lone node; an involution.
  static std::int32_t place_of_lone(std::int32_t k) { return -2 - k; }
  static std::int32_t lone_at(std::int32_t place) { return -2 - place; }
  bool is_lone(int level, std::int32_t node) const {
    return level > 1 && levels[level].down[node] < detail::kNone;
  }
  /// Whether a point's node of some level is not in memory, being on its own.
  bool stands_alone(std::int32_t id, int level) const {
    return level >= 0 && id >= 0 && static_cast<std::size_t>(id) < slot_of_id.size() && is_lone_point(id) &&
           level < lowest_node(id).level;
  }
  bool is_lone_point(std::int32_t id) const { return slot_of_id[id] < detail::kNone; }
  void make_lone(int level, std::int32_t node);
  /// The node's point needs another place.
  void forget_lone(int level, std::int32_t node);
  void unfold(int level, std::int32_t node);
  /// Unfolds the lone nodes of a level that have edges now.
  void unfold_joined(int level);
  bool could_be_lone(int level, std::int32_t node) const;
  /// Makes all nodes lone that can be.
  void fold();
  /// Number of lone nodes of the levels above.
  std::int32_t lone_above(int level) const;
  /// Points that are lone nodes, by id.
  std::vector<std::int32_t> lone_points() const;
  /// Lowest node of a point that is in memory: its cluster, or the lone node.
  Hint lowest_node(std::int32_t id) const {
    if (is_lone_point(id)) return {lone[lone_at(slot_of_id[id])].level, lone[lone_at(slot_of_id[id])].node};
    return {1, points.parent(slot_of_id[id])};
  }

  // hierarchy_links.cpp: parents and children
  void attach(int level, std::int32_t node, std::int32_t parent);
  void detach(int level, std::int32_t node);
  std::int32_t place_point(std::int32_t point, Vec3 at, std::int32_t cluster);
  void take_point(std::int32_t slot);
  void disconnect(int level, std::int32_t node);

  // hierarchy_update.cpp: places for single points
  /// Fills near[target] with the nodes of that level within `reach` of a point, and near[] of the levels
  /// above it up to that of the node it returns, whose neighbors include all that are wanted. Levels >=
  /// target must be in order.
  template <class Metric>
  Hint find_near(const Metric& metric, Vec3 at, int target, double reach, Hint hint);
  template <class Metric>
  void look_around(const Metric& metric, Vec3 at, Hint middle, double reach);
  /// Finds a parent in level `target` or above for a point. Levels >= target must be in order.
  template <class Metric>
  Cover locate(const Metric& metric, Vec3 at, int target, Hint hint);
  /// Gives a point nodes in the levels between `level` and its cover, linked to each other and to the cover.
  /// Returns the lowest one, or the cover's node if there are none between. From level 0 on it ends at the
  /// first that is lone, and returns kNone.
  template <class Metric>
  std::int32_t lift(const Metric& metric, int level, std::int32_t point, Vec3 at, Cover cover);
  /// Links a node of `level` >= 1 to its cover.
  template <class Metric>
  void settle(const Metric& metric, int level, std::int32_t node, Cover cover);
  /// The same for a point, which gets a slot.
  template <class Metric>
  void settle_point(const Metric& metric, std::int32_t point, Vec3 at, Cover cover);
  template <class Metric>
  void connect(const Metric& metric, int level, std::int32_t node);
  template <class Metric>
  void grow_top(const Metric& metric);
  template <class Metric>
  void insert(const Metric& metric, std::int32_t point, Vec3 at, Hint hint);
  template <class Metric>
  void remove(const Metric& metric, std::int32_t point);
  void trim_top();

  // hierarchy_refresh.cpp
  void update(Span<const Vec3> positions, const Box& b);
  double check_positions_of_points(Span<const Vec3> positions, const Box& b) const;
  template <class Metric>
  void refresh_level(const Metric& metric, int i);
  /// New positions of the points and of level 1; with this, points are measured.
  template <class Metric>
  void refresh_clusters(const Metric& metric);
  /// New positions of the levels above, which keep those of the last repair while one is pending.
  template <class Metric>
  void refresh_centers(const Metric& metric);
  /// What a repair to the new positions has to do.
  template <class Metric>
  detail::MaintenanceWork work_ahead(const Metric& metric);
  template <class Metric>
  void count_uncovered(const Metric& metric, int i, detail::MaintenanceWork& work);
  template <class Metric>
  void count_demoted(const Metric& metric, int i, detail::MaintenanceWork& work);
  /// What of it the structure alone says.
  detail::MaintenanceWork standing_work() const;
  template <class Metric>
  void measure(const Metric& metric);
  template <class Metric>
  bool edges_are_certified(const Metric& metric);
  void repair_if_pending();
  template <class Metric>
  bool repair_pays(const Metric& metric);
  /// Whether to insert and remove so many particles in all is less work than to build anew.
  bool exchange_pays(std::size_t particles) const;

  // hierarchy_repair.cpp
  /// Points must have been measured since they moved last.
  template <class Metric>
  void repair(const Metric& metric);
  bool is_known_to_cover(std::int32_t cluster) const;
  template <class Metric>
  void cover_points(const Metric& metric);
  template <class Metric>
  void cover_level(const Metric& metric, int i);
  bool edges_are_complete(int i) const;
  template <class Metric>
  void find_too_close(const Metric& metric, int i);
  template <class Metric>
  void connect_level(const Metric& metric, int i);
  /// Whether of two nodes of a level that are too close the first one stays.
  bool keeps_first(int i, std::int32_t a, std::int32_t b) const;
  void separate_level(int i);
  void demote(int i, std::int32_t node, std::int32_t heir);

  // hierarchy_reorder.cpp: puts nodes in depth-first order, siblings side by side
  void reorder();
  /// Levels 1 and above. Returns the new index of each node of level 1.
  std::vector<std::int32_t> reorder_levels();
  void reorder_points();

  // hierarchy_list.cpp
  /// Appends the neighbors of a node in its level of G_c.
  template <class Metric>
  void neighbors(const Metric& metric, int level, std::int32_t node, std::vector<std::int32_t>& nodes) const;
  void lists(Span<const ListParams> requests, const std::vector<NeighborList*>& out);
  /// Brings up to date what lists are made from. Returns how far the distance of two wrapped positions may be
  /// from their pair distance [length].
  double prepare_for_lists();
  detail::ListSource list_source(const detail::ParticleNames& names);

  // hierarchy_cluster_pairs.cpp
  void cluster_pairs(const ListParams& request, ClusterPairs& out);

  // hierarchy_validate.cpp
  std::string validate() const;

  // Scratch space, kept to avoid allocation.
  struct Near {
    std::int32_t node;
    double distance2;
  };
  Hint batch_hint;                        ///< of settle_batch(): where the last batch was
  std::vector<std::int32_t> batch_nodes;  ///< and the nodes near this one
  std::vector<Vec3> batch_centers;
  std::vector<std::vector<Near>> near;  ///< of find_near(): by level, the nodes within reach
  std::vector<std::array<std::int32_t, 2>>
      too_close;  ///< of a level: pairs for separate_level(), each once, the smaller node first
  std::vector<std::int32_t> strays;  ///< of cover_points(): ids
  detail::CandidateBuffer candidates;
  detail::SiblingStore siblings;
  std::vector<std::int32_t> row;
  detail::ListFinder list_finder;
  detail::ClusterPairFinder pair_finder;
};

}  // namespace dch
