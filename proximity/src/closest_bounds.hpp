// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <dch/proximity/closest_pair.hpp>

#include "base/tournament.hpp"

namespace dch::detail {

/// What is known of the nearest neighbor of each point: the nearest one itself, or a distance within which
/// there is none. Each two points are known to one of them at least.
class ClosestBounds {
 public:
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  struct Pair {
    double distance2 = kFar;
    std::int32_t a = -1, b = -1;  ///< the smaller id first; -1 where the nearest one is not known
    bool operator<(const Pair& other) const {
      if (distance2 != other.distance2) return distance2 < other.distance2;
      return a != other.a ? a < other.a : b < other.b;
    }
  };

  std::size_t size() const { return pairs_.size(); }
  /// Of points beyond those of before nothing is known, nor asked.
  void grow(std::size_t points);
  /// Knows the nearest neighbor of every point.
  void set_all(std::vector<Pair> pairs, std::int64_t asked_at);

  /// Knows nothing of any point.
  void forget_all(const std::vector<char>& is_there);
  /// The point is at another place, and has to ask before anything is read.
  void note_change(std::int32_t id, std::int64_t now) { changed_at_[static_cast<std::size_t>(id)] = now; }
  /// The point has gone.
  void remove(std::int32_t id, std::int64_t now);
  void set_nearest(std::int32_t id, const Pair& pair, std::int64_t now);
  /// The point has no neighbor within a distance, of least_distance() or more: of a smaller one rounding
  /// would leave nothing.
  void set_none_within(std::int32_t id, double distance);
  double least_distance() const;
  /// The distances of all points may have shrunk by so much.
  void shrink_all(double by);

  /// The smallest of the pairs that are known; one without points if there is none.
  const Pair& closest();
  /// A point that may have a pair within a distance which is not known; -1 if there is none.
  std::int32_t next_below(double distance) const;
  /// How many points have lower bounds within a distance.
  std::size_t count_below(double distance) const;

 private:
  /// No neighbor is nearer that is not known: of a point whose nearest one is known, infinity.
  double bound(std::int32_t id) const;
  bool is_stale(std::int32_t id) const;
  void demote(std::int32_t id);
  void clear_pair(std::int32_t id);
  double bound_of(const Pair& pair) const;

  Tournament<Pair> pairs_;
  Tournament<double>
      bounds_;         ///< with what distances had shrunk by when it was set; infinity where there is none
  double shrunk_ = 0;  ///< by how much distances have shrunk since all were set [length]
  std::vector<std::int64_t> changed_at_;  ///< by point: when it last came, went or moved
  std::vector<std::int64_t> asked_at_;    ///< by point: when its nearest one was found
};

}  // namespace dch::detail
