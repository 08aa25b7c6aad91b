// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <dch/hierarchy/hierarchy.hpp>

#include "geometry/metric.hpp"
#include "hierarchy/build/block_order.hpp"
#include "hierarchy/candidate_buffer.hpp"
#include "hierarchy/maintenance_cost.hpp"
#include "hierarchy/sibling_store.hpp"
#include "hierarchy/structure.hpp"

namespace dch {

using detail::kInflate;

/// How far points may move, in units of R_0, before the edges of level 1 have to be made anew, where repair
/// is put off. More: fewer repairs, more edges for lists to dismiss.
inline constexpr double kMotionSlack = 0.4;

/// How much farther than rho_i edges of level i >= 2 reach, in units of R_i, so that they need not be
/// enumerated anew at each repair. More: fewer enumerations, more edges.
inline constexpr double kEdgeSlack = 0.1;

inline constexpr double kMinC = 1.05, kMaxC = 1000;

/// A structure, and the stages that change it: each in a source file of its own.
struct Hierarchy::Impl : detail::Structure {
  using Level = detail::Level;

  explicit Impl(const detail::StructureParams& p) {
    params = p;
    points.keeps_positions = params.keeps_block_positions;
    reset(Box());
  }

  /// To be called when points have come, gone or changed their leaf, slot or id.
  void note_new_places() {
    measured = false;
    leaves.forget_layout();
  }

  void check_base_radius(const Box& b) const;
  double radius_of_level(int i) const;
  double threshold_of_level(int i) const;
  bool finds_base_radius() const {
    return params.base_radius == 0 && params.edge_rule == detail::EdgeRule::additive;
  }
  void set_base_radius(Span<const Vec3> positions);
  void set_wrap_slack();
  void set_lengths(int i);

  /// Nodes whose distances were computed to find places for others.
  void note_tested(std::int64_t nodes) {
    stats.distances += nodes;
    stats.visited += nodes;
  }

  // Places for nodes
  struct Cover {
    int level;  ///< lowest level >= target with a node within R_{level-1}; top() + 1 if there is none
    std::int32_t parent;  ///< that node, the nearest one; kNone if there is none
  };
  // levels.cpp: whole-structure operations
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
  std::size_t memory_bytes() const;

  // build/build.cpp
  void build(Span<const Vec3> positions, const Box& b);
  /// Some points close to each other, to find parents for together.
  struct Batch {
    const std::int32_t* ids;
    std::size_t size;
    Vec3 center;
    double extent;  ///< of the farthest point from the center, wrapped but not by nearest images [length]
  };
  template <class Metric>
  void choose_leaves(const Metric& metric);
  template <class Metric>
  void attach_batch(const Metric& metric, const Batch& batch);
  template <class Metric>
  Hint leaf_for(const Metric& metric, Vec3 at, std::int32_t id, Hint hint);
  template <class Metric>
  void place_points(const Metric& metric);

  // build/fill_leaves.hpp
  /// Points by their leaf.
  struct Members {
    std::vector<std::int32_t> index;  ///< those of leaf k from first[k] to first[k + 1]
    std::vector<std::int32_t> first;

    void sort(const std::vector<std::int32_t>& leaf_of, std::int32_t leaf_count);
  };
  /// Puts points into blocks, each point into the nearest leaf that an edge joins to its own. Their ids
  /// and positions depend on their indices, and so do their leaves, which are negative for what is no
  /// point.
  template <class Metric, class IdOf, class PositionOf>
  void fill_leaves(const Metric& metric, detail::LeafBlocks& blocks, std::vector<std::int32_t>& leaf_of,
                   const IdOf& id_of, const PositionOf& position_of);
  template <class Metric, class PositionOf>
  void choose_nearest(const Metric& metric, const Members& members, std::vector<std::int32_t>& leaf_of,
                      const PositionOf& position_of);
  /// Puts the points of a leaf, in no order yet, into blocks. Their ids and positions depend on their
  /// indices.
  template <class IdOf, class PositionOf>
  void fill_leaf(detail::LeafBlocks& blocks, std::int32_t leaf, std::vector<detail::LocalPoint>& local,
                 const IdOf& id_of, const PositionOf& position_of);

  // points/singletons.cpp: points on their own
  void make_singleton(int level, std::int32_t node);
  /// The node's point needs another place.
  void forget_singleton(int level, std::int32_t node);
  void expand(int level, std::int32_t node);
  /// Expands the singletons of a level that have edges now.
  void expand_joined(int level);
  bool could_be_singleton(int level, std::int32_t node) const;
  /// Makes a singleton of every node that can be one.
  void collapse();
  // points/links.cpp: parents and children
  std::int32_t add_node(int level, std::int32_t point, Vec3 at);
  void attach(int level, std::int32_t node, std::int32_t parent);
  void detach(int level, std::int32_t node);
  std::int32_t place_point(std::int32_t point, Vec3 at, std::int32_t leaf);
  void remove_from_block(std::int32_t slot);
  void disconnect(int level, std::int32_t node);

  // points/insert_remove.cpp: places for single points
  /// Fills near[target] with the nodes of that level within `reach` of a point, and near[] of the levels
  /// above it up to that of the node it returns, whose neighbors include all that are wanted. Levels >=
  /// target must be in order.
  template <class Metric>
  Hint find_near(const Metric& metric, Vec3 at, int target, double reach, Hint hint);
  template <class Metric>
  void search_around(const Metric& metric, Vec3 at, Hint middle, double reach);
  /// Finds a parent in level `target` or above for a point. Levels >= target must be in order.
  template <class Metric>
  Cover locate(const Metric& metric, Vec3 at, int target, Hint hint);
  /// Gives a point nodes in the levels between `level` and its cover, linked to each other and to the cover.
  /// Returns the lowest one, or the cover's node if there are none between. From level 0 on it ends at the
  /// first singleton, and returns kNone.
  template <class Metric>
  std::int32_t promote(const Metric& metric, int level, std::int32_t point, Vec3 at, Cover cover);
  /// Links a node of `level` >= 1 to its cover.
  template <class Metric>
  void attach_under(const Metric& metric, int level, std::int32_t node, Cover cover);
  /// The same for a point, which gets a slot.
  template <class Metric>
  void attach_point_under(const Metric& metric, std::int32_t point, Vec3 at, Cover cover);
  template <class Metric>
  void connect(const Metric& metric, int level, std::int32_t node);
  template <class Metric>
  void grow_top(const Metric& metric);
  template <class Metric>
  void insert(const Metric& metric, std::int32_t point, Vec3 at, Hint hint);

  // points/removal.cpp
  /// What a point that goes leaves behind.
  struct Left {
    std::vector<std::vector<std::int32_t>> nodes;  ///< by level from 1 on: those without a parent
    std::vector<Hint> hint;               ///< by level: a node there or above that stays and is not far
    std::int32_t blocks = detail::kNone;  ///< chain of points without a leaf
    std::vector<std::int32_t> leaves;     ///< that may cover these
  };
  template <class Metric>
  void remove(const Metric& metric, std::int32_t point);
  template <class Metric>
  Left take_out(const Metric& metric, std::int32_t point);
  template <class Metric>
  void leave_children(const Metric& metric, int level, std::int32_t node, Left& left);
  template <class Metric>
  void adopt_block(const Metric& metric, std::int32_t block, Left& left);
  template <class Metric>
  Cover leaf_among(const Metric& metric, Vec3 at, Left& left);
  void trim_top();

  // motion/refresh.cpp
  void update(Span<const Vec3> positions, const Box& b);
  double take_positions(Span<const Vec3> positions, const Box& b);
  template <class Metric>
  void refresh_level(const Metric& metric, int i);
  /// New positions of the points and of level 1; with this, points are measured.
  template <class Metric>
  void refresh_leaves(const Metric& metric);
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
  void allow_for_far_points();
  void repair_if_pending();
  template <class Metric>
  bool repair_pays(const Metric& metric);
  /// Whether to insert and remove so many particles in all is less work than to build anew.
  bool exchange_pays(std::size_t particles) const;

  // motion/repair.cpp
  /// Points must have been measured since they moved last.
  template <class Metric>
  void repair(const Metric& metric);
  bool is_known_to_cover(std::int32_t leaf) const;
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
  void demote(int i, std::int32_t node, std::int32_t successor);

  // build/reorder.cpp: puts nodes in depth-first order, siblings side by side
  void reorder();
  /// Levels 1 and above. Returns the new index of each node of level 1.
  std::vector<std::int32_t> reorder_levels();
  void reorder_points();
  void order_blocks();

  detail::MaintenanceWork ahead;  ///< what the last choice between repair and build went by

  // Scratch space, kept to avoid allocation.
  struct Near {
    std::int32_t node;
    double distance2;
  };
  Hint batch_hint;                        ///< of attach_batch(): where the last batch was
  std::vector<std::int32_t> batch_nodes;  ///< and the nodes near this one
  std::vector<Vec3> batch_centers;
  std::vector<std::vector<Near>> near;  ///< of find_near(): by level, the nodes within reach
  std::vector<std::array<std::int32_t, 2>>
      too_close;  ///< of a level: pairs for separate_level(), each once, the smaller node first
  std::vector<std::int32_t> uncovered_points;  ///< of cover_points(): ids
  detail::CandidateBuffer candidates;
  detail::SiblingStore siblings;
  std::vector<std::int32_t> row;
};

}  // namespace dch
