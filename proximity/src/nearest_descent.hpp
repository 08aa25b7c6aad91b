// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/vec3.hpp>
#include <dch/proximity/nearest.hpp>

#include "closest_candidate.hpp"
#include "geometry/position_check.hpp"
#include "hierarchy/structure.hpp"
#include "hierarchy/subtree_balls.hpp"
#include "nearest_candidates.hpp"
#include "within_candidates.hpp"

namespace dch::detail {

/// One query at a time: depth first, of siblings the nearest first, without subtrees that are too far for the
/// candidates: farther than the k-th point, or than a radius. The first leaf is near enough for the rest to
/// be dismissed by their squared distances.
template <class Metric, class Candidates = NearestCandidates>
class NearestDescent {
 public:
  NearestDescent(const Metric& metric, const Structure& structure, const SubtreeBalls& balls)
      : metric_(metric), structure_(structure), balls_(balls), wrap_error_(structure.box) {
    waiting_.reserve(kUsual);
    near_blocks_.reserve(kUsual);
  }

  /// @param position as given
  /// @param self id of a point that is no neighbor; -1 for none
  void search(Vec3 position, std::int32_t self, double epsilon, Candidates& best);

  NearestWork work;

 private:
  struct Subtree {
    double distance2;  ///< of its node
    double radius;     ///< of its ball
    std::int32_t level, node;
  };
  struct NearBlock {
    float gap2;  ///< squared distance from its box
    std::int32_t block;
  };
  struct Query {
    Vec3 given, wrapped;
    std::int32_t self;
    double slack;  ///< by which distances of wrapped points may be off
    Candidates* best;
    double limit;   ///< how far off a point may be at most to be taken, by its wrapped image
    double shrink;  ///< of that: how far off a subtree may be to be opened
  };
  static constexpr std::size_t kUsual = 256;  ///< subtrees or blocks that wait: hardly a query has more
  static bool is_nearer(const Subtree& a, const Subtree& b) { return a.distance2 < b.distance2; }
  void push_roots(const Query& query);
  void dive(Query& query);
  bool is_too_far(const Query& query, const Subtree& subtree) const;
  void push(const Query& query, int level, std::int32_t node);
  void put_nearest_last(std::size_t first);
  void open(Query& query, const Subtree& subtree);
  void look_at_leaf(Query& query, std::int32_t node);
  void look_at_block(Query& query, std::int32_t block);
  void look_at_point(Query& query, std::int32_t id, Vec3 given);
  static void set_limit(Query& query);

  const Metric& metric_;
  const Structure& structure_;
  const SubtreeBalls& balls_;
  WrapError wrap_error_;
  std::vector<Subtree> waiting_;  ///< a stack
  std::vector<Subtree> divers_;
  std::vector<NearBlock> near_blocks_;
};

}  // namespace dch::detail
