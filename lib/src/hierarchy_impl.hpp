// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <dch/hierarchy.hpp>

#include "candidate_buffer.hpp"
#include "cost_estimate.hpp"
#include "hierarchy_level.hpp"
#include "list_assembly.hpp"
#include "metric.hpp"
#include "sibling_store.hpp"

namespace dch {

/// Candidate radii (never decisions) are inflated by this factor, squared radii by its square, so that
/// rounding in the triangle inequality cannot hide a node.
inline constexpr double kInflate = 1 + 1e-12;
/// Edges are stored from this level on; below they are enumerated among the children of neighboring parents
/// (Lemma 5.3.1(5)), the level-0 ones as neighbor lists. Levels 0 and 1 hold nearly all nodes and edges, yet
/// neither maintenance nor lists need theirs: their pairs are met in the clusters of level 2, of about r_list
/// in size.
inline constexpr int kFirstStoredLevel = 2;

inline constexpr double kMinC = 1.05, kMaxC = 1000;
inline constexpr double kMinRadius = 1e-100;

struct Hierarchy::Impl {
  using Level = detail::Level;

  explicit Impl(const HierarchyParams& p) : params(p) { reset(Box()); }

  HierarchyParams params;
  Box box;
  std::vector<Level> levels;             ///< at least level 0
  std::vector<Vec3> raw;                 ///< positions as given, by id
  std::vector<std::int32_t> slot_of_id;  ///< level-0 node of a point, kNone for free ids
  std::vector<std::int32_t> free_ids;    ///< min-heap
  SearchStats stats;

  // What the two ways to bring the structure up to date cost, measured on itself [s].
  detail::CostEstimate build_per_point;
  detail::CostEstimate sweep_per_point;  ///< of a repair that finds nothing to change
  detail::CostEstimate per_orphan;       ///< to give one orphan a parent or promote it

  /// Added to the thresholds of all levels but 0: how far the distance of wrapped points may be from the pair
  /// distance that lists go by. About 1e-13 of the box, more if a point lies very many boxes away.
  double wrap_slack = 0;
  std::int64_t strayed = 0;  ///< nodes that changed their parent since the nodes were last put in order

  bool stores_edges(int level) const { return level >= kFirstStoredLevel; }
  int top() const { return static_cast<int>(levels.size()) - 1; }
  double radius_of_level(int i) const;
  double threshold_of_level(int i) const;
  void set_wrap_slack(Span<const Vec3> positions);

  // hierarchy.cpp: whole-structure operations
  void reset(const Box& b);
  void build(Span<const Vec3> positions, const Box& b);
  void push_level();
  void pop_level();
  std::int32_t node_of(std::int32_t id, int level) const;

  std::size_t memory_bytes() const;

  // hierarchy_links.cpp: parents and children
  void attach(int level, std::int32_t node, std::int32_t parent);
  void detach(int level, std::int32_t node);

  // hierarchy_update.cpp: places for single points
  struct Cover {
    int level;  ///< lowest level >= target with a node within R_{level-1}; top() + 1 if there is none
    std::int32_t parent;  ///< that node, the nearest one; kNone if there is none
  };
  /// A node of some level >= target, the nearer the cheaper; none to descend from the roots.
  struct Hint {
    int level = 0;
    std::int32_t node = detail::kNone;
  };
  /// Finds a parent in level `target` or above for a point. Levels >= target must be in order.
  template <class Metric>
  Cover locate(const Metric& metric, Vec3 at, int target, Hint hint);
  /// Links a node of `level` to its cover, lifting its point through the levels between.
  template <class Metric>
  void settle(const Metric& metric, int level, std::int32_t node, Cover cover);
  template <class Metric>
  void connect(const Metric& metric, int level, std::int32_t node);
  template <class Metric>
  void grow_top(const Metric& metric);
  template <class Metric>
  std::int32_t insert(const Metric& metric, std::int32_t id, Vec3 at, std::int32_t hint_slot);
  template <class Metric>
  void remove(const Metric& metric, std::int32_t id);
  void trim_top();
  void disconnect(int level, std::int32_t node);

  // hierarchy_repair.cpp
  void update(Span<const Vec3> positions, const Box& b);
  void check_positions_of_points(Span<const Vec3> positions, const Box& b) const;
  void refresh_positions(Span<const Vec3> positions);
  template <class Metric>
  std::int64_t count_orphans(const Metric& metric) const;
  bool repair_pays(std::int64_t orphans) const;
  template <class Metric>
  void repair(const Metric& metric, double check_seconds);
  template <class Metric>
  void cover_level(const Metric& metric, int level);
  template <class Metric>
  void connect_level(const Metric& metric, int level);
  void separate_level(int level);
  void demote(int level, std::int32_t node, std::int32_t heir);

  // hierarchy_reorder.cpp: puts nodes in depth-first order, siblings side by side
  void reorder();

  // hierarchy_list.cpp
  /// Appends the neighbors of a node in its level of G_c, stored or not.
  template <class Metric>
  void neighbors(const Metric& metric, int level, std::int32_t node, std::vector<std::int32_t>& nodes) const;
  void list(const ListParams& request, NeighborList& out);

  // hierarchy_validate.cpp
  std::string validate() const;

  // Scratch space, kept to avoid allocation.
  struct Near {
    std::int32_t node;
    double distance2;
  };
  std::vector<std::vector<Near>> near;  ///< of locate(): by level, the nodes within R_level
  std::vector<std::array<std::int32_t, 2>>
      too_close;  ///< of connect_level(): pairs that separate_level() settles
  detail::CandidateBuffer candidates;
  detail::SiblingStore siblings;
  std::vector<std::int32_t> row;
  detail::PairBuffer pairs;
  detail::ListAssembler assembler;
};

}  // namespace dch
