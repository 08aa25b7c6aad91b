// SPDX-License-Identifier: MIT
#pragma once

#include <boost/heap/d_ary_heap.hpp>
#include <cstdint>
#include <vector>

#include <dch/kinetic/kinetic_edges.hpp>

namespace dch::kinetic {

/// What is next for a point. Ordered by time, then by ids, so that the order never depends on a history.
struct Due {
  double time;
  Edge edge;  ///< {point, -1} where no other point has part in it
  std::int32_t pair = -1;

  bool operator<(const Due& other) const {
    return time != other.time ? time < other.time : edge < other.edge;
  }
};

/// One entry for each point, the earliest on top.
class PointQueue {
 public:
  explicit PointQueue(std::size_t points) {
    heap_.reserve(points);
    for (std::size_t i = 0; i < points; ++i)
      handles_.push_back(heap_.push({kNever, {static_cast<std::int32_t>(i), -1}}));
  }

  bool empty() const { return heap_.empty(); }
  const Due& top() const { return heap_.top(); }
  const Due& of(std::int32_t point) const { return *handles_[static_cast<std::size_t>(point)]; }
  void set(std::int32_t point, const Due& due) {
    heap_.update(handles_[static_cast<std::size_t>(point)], due);
  }

 private:
  struct Later {
    bool operator()(const Due& x, const Due& y) const { return y < x; }
  };
  using Heap = boost::heap::d_ary_heap<Due, boost::heap::arity<4>, boost::heap::mutable_<true>,
                                       boost::heap::compare<Later>>;
  Heap heap_;
  std::vector<Heap::handle_type> handles_;
};

}  // namespace dch::kinetic
