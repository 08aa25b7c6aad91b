// SPDX-License-Identifier: MIT
#include "hull_tree.hpp"

namespace dch::zonotope {

HullTree::HullTree(Span<const Vec2> points, bool is_upper) : points_(points), sign_(is_upper ? -1 : 1) {
  while (leaves_ < points.size()) leaves_ *= 2;
  nodes_.resize(2 * leaves_);
}

void HullTree::assign(const std::vector<bool>& is_in) {
  for (std::size_t k = 0; k < leaves_; ++k) {
    const bool has = k < is_in.size() && is_in[k];
    nodes_[leaves_ + k] = {k, k, !has};
  }
  for (std::size_t node = leaves_ - 1; node > 0; --node) join(node);
}

void HullTree::change(std::size_t point, bool is_in) {
  std::size_t node = leaves_ + point;
  nodes_[node] = {point, point, !is_in};
  while ((node /= 2) > 0) join(node);
}

/// The point of a node's hull that is lowest along a direction across which lines are compared: the bridge's
/// slope against that of the direction tells in which half it is.
std::size_t HullTree::lowest(std::size_t node, Vec2 direction) const {
  while (node < leaves_) {
    ++operations_;
    const std::size_t left = 2 * node, right = left + 1;
    if (nodes_[left].is_empty || nodes_[right].is_empty) {
      node = nodes_[left].is_empty ? right : left;
      continue;
    }
    const Vec2 bridge = at(nodes_[node].right) - at(nodes_[node].left);
    node = cross(direction, bridge) < 0 ? right : left;
  }
  return node - leaves_;
}

void HullTree::join(std::size_t node) {
  const std::size_t left = 2 * node, right = left + 1;
  nodes_[node].is_empty = nodes_[left].is_empty && nodes_[right].is_empty;
  if (nodes_[left].is_empty || nodes_[right].is_empty) return;
  // Down the left half: where its bridge, prolonged, has the right half below it, the tangent is less steep
  // and leaves before it.
  std::size_t at_left = left;
  while (at_left < leaves_) {
    ++operations_;
    const std::size_t first = 2 * at_left, second = first + 1;
    if (nodes_[first].is_empty || nodes_[second].is_empty) {
      at_left = nodes_[first].is_empty ? second : first;
      continue;
    }
    const Vec2 start = at(nodes_[at_left].left), slope = at(nodes_[at_left].right) - start;
    const std::size_t below = lowest(right, slope);
    at_left = cross(slope, at(below) - start) < 0 ? first : second;
  }
  nodes_[node].left = at_left - leaves_;
  nodes_[node].right = tangent(right, nodes_[node].left, sign_ > 0);
}

/// @param is_rising in the points' own coordinates
std::size_t HullTree::tangent(std::size_t node, std::size_t from, bool is_rising) const {
  const double turn = is_rising ? -1 : 1;
  while (node < leaves_) {
    ++operations_;
    const std::size_t left = 2 * node, right = left + 1;
    if (nodes_[left].is_empty || nodes_[right].is_empty) {
      node = nodes_[left].is_empty ? right : left;
      continue;
    }
    const Vec2 a = points_[nodes_[node].left] - points_[from],
               b = points_[nodes_[node].right] - points_[from];
    node = turn * cross(a, b) > 0 ? right : left;
  }
  return node - leaves_;
}

std::size_t HullTree::first_met(std::size_t from, std::size_t first, std::size_t last, bool is_rising) const {
  std::size_t best = kNone;
  const auto look_at = [&](std::size_t node) {
    if (nodes_[node].is_empty) return;
    const std::size_t found = tangent(node, from, is_rising);
    ++operations_;
    if (best == kNone ||
        (is_rising ? -1 : 1) * cross(points_[best] - points_[from], points_[found] - points_[from]) > 0)
      best = found;
  };
  for (std::size_t low = leaves_ + first, high = leaves_ + last; low < high; low /= 2, high /= 2) {
    if (low % 2 == 1) look_at(low++);
    if (high % 2 == 1) look_at(--high);
  }
  return best;
}

}  // namespace dch::zonotope
