// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include <dch/proximity/closest_pair.hpp>

#include "gap_between.hpp"
#include "geometry/tolerance.hpp"

namespace dch {
namespace {

/// Two nodes, and what the first of their pairs of points may be like. Pairs of nodes share no pair of
/// points, so no two have the same smallest ids.
struct Candidate {
  double distance2;               ///< at least
  std::int32_t least_a, least_b;  ///< smallest ids, in order
  std::int32_t x, y;
  bool operator<(const Candidate& other) const {
    return std::tie(distance2, least_a, least_b) > std::tie(other.distance2, other.least_a, other.least_b);
  }
};

class ClosestPairSearch {
 public:
  explicit ClosestPairSearch(const PointTree& tree) : tree_(tree), least_id_(tree.nodes().size()) {}

  ClosestPoints search() {
    // Children before their parents, so that small nodes give a small limit early.
    const std::vector<std::int32_t> order = from_the_root();
    for (auto k = order.rbegin(); k != order.rend(); ++k) {
      const PointTree::Node& node = tree_.node(*k);
      const std::int32_t end = node.first_child + node.children;
      std::int32_t& least_id = least_id_[static_cast<std::size_t>(*k)];
      least_id = node.representative;
      for (std::int32_t x = node.first_child; x < end; ++x) {
        least_id = std::min(least_id, least_id_[static_cast<std::size_t>(x)]);
        for (std::int32_t y = x + 1; y < end; ++y) push(x, y);
      }
    }
    while (!waiting_.empty()) {
      std::pop_heap(waiting_.begin(), waiting_.end());
      const Candidate first = waiting_.back();
      waiting_.pop_back();
      const PointTree::Node &x = tree_.node(first.x), &y = tree_.node(first.y);
      if (x.points == 1 && y.points == 1) return {first.least_a, first.least_b, first.distance2, looked_at_};
      const bool splits_x = y.points == 1 || (x.points > 1 && x.radius >= y.radius);
      const PointTree::Node& split = splits_x ? x : y;
      for (std::int32_t k = 0; k < split.children; ++k)
        push(split.first_child + k, splits_x ? first.y : first.x);
    }
    return {};
  }

 private:
  /// All nodes, children behind their parents.
  std::vector<std::int32_t> from_the_root() const {
    std::vector<std::int32_t> order;
    order.reserve(tree_.nodes().size());
    if (tree_.size() > 0) order.push_back(0);
    for (std::size_t k = 0; k < order.size(); ++k) {
      const PointTree::Node& node = tree_.node(order[k]);
      for (std::int32_t c = 0; c < node.children; ++c) order.push_back(node.first_child + c);
    }
    return order;
  }

  void push(std::int32_t x, std::int32_t y) {
    ++looked_at_;
    const PointTree::Node &one = tree_.node(x), &other = tree_.node(y);
    const double between = tree_.distance2(one.representative, other.representative);
    limit2_ = std::min(limit2_, between);
    double least2 = between;
    if (one.points > 1 || other.points > 1) {
      const double gap = detail::gap_between(tree_, one, other);
      least2 = gap * gap / detail::kInflate;
    }
    if (least2 > limit2_) return;
    const auto [a, b] =
        std::minmax(least_id_[static_cast<std::size_t>(x)], least_id_[static_cast<std::size_t>(y)]);
    waiting_.push_back({least2, a, b, x, y});
    std::push_heap(waiting_.begin(), waiting_.end());
  }

  const PointTree& tree_;
  std::vector<std::int32_t> least_id_;  ///< by node
  std::vector<Candidate> waiting_;      ///< a heap
  double limit2_ = std::numeric_limits<double>::infinity();
  std::int64_t looked_at_ = 0;
};

}  // namespace

ClosestPoints closest_pair(const PointTree& tree) { return ClosestPairSearch(tree).search(); }

}  // namespace dch
