// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/base/vec3.hpp>
#include <dch/proximity/nearest.hpp>

#include "geometry/position_check.hpp"
#include "hierarchy/structure.hpp"
#include "nearest_candidates.hpp"
#include "subtree_balls.hpp"

namespace dch::detail {

/// One query at a time: subtrees in the order of their distance, until none is nearer than the k-th point.
template <class Metric>
class NearestDescent {
 public:
  NearestDescent(const Metric& metric, const Structure& structure, const SubtreeBalls& balls)
      : metric_(metric), structure_(structure), balls_(balls), wrap_error_(structure.box) {}

  /// @param position as given
  /// @param self id of a point that is no neighbor; -1 for none
  void search(Vec3 position, std::int32_t self, double epsilon, NearestCandidates& best);

  NearestWork work;

 private:
  struct Subtree {
    double distance;  ///< of its ball at least
    std::int32_t level, node;
    bool operator<(const Subtree& other) const { return distance > other.distance; }
  };
  struct Query {
    Vec3 given, wrapped;
    std::int32_t self;
    double slack;  ///< by which distances of wrapped points may be off
    NearestCandidates* best;
    double limit;  ///< how far off a point may be at most to be taken, by its wrapped image
  };
  void push(const Query& query, int level, std::int32_t node);
  void open(Query& query, const Subtree& subtree);
  void look_at_leaf(Query& query, std::int32_t node);
  void look_at_point(Query& query, std::int32_t id);

  const Metric& metric_;
  const Structure& structure_;
  const SubtreeBalls& balls_;
  WrapError wrap_error_;
  std::vector<Subtree> waiting_;  ///< a heap
};

}  // namespace dch::detail
