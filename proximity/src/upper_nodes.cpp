// SPDX-License-Identifier: MIT
#include "upper_nodes.hpp"

namespace dch::detail {

UpperNodes::UpperNodes(const Structure& structure) : structure_(structure) {
  tree.ids.resize(structure.count());
  if (tree.ids.empty()) return;
  count_points();
  tree.nodes.emplace_back();
  tree.nodes[0].points = static_cast<std::int32_t>(tree.ids.size());
  tree.nets.emplace_back();
  tree.first_point.push_back(0);
  std::vector<Subtree> children;
  for (std::int32_t root = 0; root < structure.levels.back().size(); ++root)
    if (structure.levels.back().is_alive(root)) children.push_back({structure.top(), root});
  subtree_.push_back(children.front());
  if (children.size() > 1) add_children(0, children);
  for (std::size_t k = 0; k < tree.nodes.size(); ++k) {
    if (tree.nodes[k].children > 0) continue;
    const Subtree at = pass_only_children(subtree_[k]);
    list_children(at, children);
    if (children.empty()) {
      take_points(at, static_cast<std::size_t>(tree.first_point[k]));
    } else {
      add_children(k, children);
    }
  }
}

void UpperNodes::count_points() {
  count_.resize(structure_.levels.size());
  for (std::size_t level = 1; level < count_.size(); ++level) {
    const int below = static_cast<int>(level) - 1;
    const Level& nodes_of_level = structure_.levels[level];
    count_[level].assign(static_cast<std::size_t>(nodes_of_level.size()), 0);
    for (std::int32_t node = 0; node < nodes_of_level.size(); ++node) {
      if (!nodes_of_level.is_alive(node)) continue;
      std::int32_t& points = count_[level][static_cast<std::size_t>(node)];
      if (structure_.is_singleton(static_cast<int>(level), node)) ++points;
      structure_.for_each_child(static_cast<int>(level), node, [&](std::int32_t child) {
        points += count({below, child});
      });
    }
  }
}

/// Below level 1 there are points alone.
std::int32_t UpperNodes::count(Subtree at) const {
  return at.level == 0 ? 1 : count_[static_cast<std::size_t>(at.level)][static_cast<std::size_t>(at.node)];
}

Vec3 UpperNodes::site(Subtree at) const {
  return at.level == 0 ? structure_.box.wrap(structure_.raw[static_cast<std::size_t>(at.node)])
                       : structure_.levels[static_cast<std::size_t>(at.level)]
                             .position[static_cast<std::size_t>(at.node)];
}

/// None of a leaf, whose points are taken as they are.
void UpperNodes::list_children(Subtree of, std::vector<Subtree>& children) const {
  children.clear();
  if (of.level <= 1) return;
  if (structure_.is_singleton(of.level, of.node))
    children.push_back({0, structure_.levels[of.level].id[of.node]});
  structure_.for_each_child(of.level, of.node, [&](std::int32_t child) {
    children.push_back({of.level - 1, child});
  });
}

/// The lowest node with the same points below.
UpperNodes::Subtree UpperNodes::pass_only_children(Subtree at) const {
  std::vector<Subtree> children;
  for (list_children(at, children); children.size() == 1; list_children(at, children)) at = children.front();
  return at;
}

/// Of the points below nodes of a level all are within its radius (thesis 5.3), but while a repair is put
/// off.
void UpperNodes::add_children(std::size_t parent, const std::vector<Subtree>& children) {
  const int level = children.back().level;  // no singleton, of which there is one at most, in front
  tree.nets[parent].radius = structure_.levels[static_cast<std::size_t>(level)].radius;
  tree.begin_row(parent, children.size());
  std::int32_t place = tree.first_point[parent];
  for (const Subtree at : children) {
    tree.add(parent, place, count(at), site(at));
    place += count(at);
    subtree_.push_back(at);
  }
}

void UpperNodes::take_points(Subtree of, std::size_t place) {
  if (of.level == 0) {
    tree.ids[place] = of.node;
    return;
  }
  structure_.for_each_child(1, of.node,
                            [&](std::int32_t slot) { tree.ids[place++] = structure_.points.id[slot]; });
}

}  // namespace dch::detail
