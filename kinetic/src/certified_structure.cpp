// SPDX-License-Identifier: MIT
//
// How nodes enter and leave levels, find parents and are joined. Each step leaves the certificates of the
// pairs that it touches as they have to be.
#include <set>
#include <vector>

#include "certified_hierarchy.hpp"

namespace dch::kinetic {

/// Puts a point into a level, and into those above that it needs to have a parent.
void CertifiedHierarchy::enter(int level, std::int32_t id) {
  at(level).emplace(id, Node{});
  find_parent(level, id);
}

/// Takes a node out of a level in which it is highest. Its children, the node itself one level down among
/// them, take other parents, one after the other, since one that is promoted may cover the next.
void CertifiedHierarchy::leave(int level, std::int32_t id) {
  const std::set<std::int32_t> orphans = node(level, id).children, neighbors = node(level, id).neighbors;
  for (const std::int32_t orphan : orphans) clear_parent(level - 1, orphan);
  clear_parent(level, id);
  for (const std::int32_t other : neighbors) remove_edge(level, {std::min(id, other), std::max(id, other)});
  for (const Key& key : std::set<Key>(node(level, id).certificates)) drop(key);
  at(level).erase(id);
  for (const std::int32_t orphan : orphans) find_parent(level - 1, orphan);
}

/// The point itself, else the nearest node of the level above that covers it; else it is promoted.
void CertifiedHierarchy::find_parent(int level, std::int32_t id) {
  if (level == top()) {
    if (at(level).size() == 1) return;
    grow();
  }
  std::int32_t parent = stands(level + 1, id) ? id : nearest_cover(level + 1, id);
  if (parent < 0) {
    enter(level + 1, id);
    parent = id;
  }
  set_parent(level, id, parent);
}

std::int32_t CertifiedHierarchy::nearest_cover(int level, std::int32_t id) const {
  std::int32_t nearest = -1;
  double least = 0;
  for (const auto& [other, node] : at(level)) {
    const double apart2 = distance2(id, other);
    if (nearest >= 0 && apart2 >= least) continue;
    if (!is_within({std::min(id, other), std::max(id, other)}, covering_radius(level - 1))) continue;
    nearest = other;
    least = apart2;
  }
  return nearest;
}

/// Lifts the root, which is the one node of the top level with a parent to find no more.
void CertifiedHierarchy::grow() {
  const int level = top();
  std::int32_t root = at(level).begin()->first;
  for (const auto& [id, node] : at(level))
    if (node.children.size() > at(level).at(root).children.size()) root = id;
  levels_.emplace_back();
  at(level + 1).emplace(root, Node{});
  set_parent(level, root, root);
}

/// A level above that of the root holds the root alone.
void CertifiedHierarchy::shrink() {
  while (levels() > 1 && at(top() - 1).size() == 1) {
    clear_parent(top() - 1, at(top() - 1).begin()->first);
    levels_.pop_back();
  }
}

void CertifiedHierarchy::set_parent(int level, std::int32_t id, std::int32_t parent) {
  clear_parent(level, id);
  node(level, id).parent = parent;
  node(level + 1, parent).children.insert(id);
  if (parent != id) make({level, {std::min(id, parent), std::max(id, parent)}, Kind::parent_child});
  std::set<std::int32_t> others;
  for (const Key& key : node(level, id).certificates)
    others.insert(key.edge.a == id ? key.edge.b : key.edge.a);
  for (const std::int32_t near : node(level + 1, parent).neighbors) {
    const auto& cousins = node(level + 1, near).children;
    others.insert(cousins.begin(), cousins.end());
  }
  const auto& siblings = node(level + 1, parent).children;
  others.insert(siblings.begin(), siblings.end());
  for (const std::int32_t other : others)
    if (stands(level, other)) renew_pair(level, id, other);
}

/// Pairs of the node stay until it has another parent, or is gone.
void CertifiedHierarchy::clear_parent(int level, std::int32_t id) {
  const std::int32_t parent = node(level, id).parent;
  if (parent < 0) return;
  node(level, id).parent = -1;
  node(level + 1, parent).children.erase(id);
  drop({level, {std::min(id, parent), std::max(id, parent)}, Kind::parent_child});
}

void CertifiedHierarchy::add_edge(int level, Edge edge) {
  node(level, edge.a).neighbors.insert(edge.b);
  node(level, edge.b).neighbors.insert(edge.a);
  renew_pair(level, edge.a, edge.b, true);
  renew_children(level, edge);
}

void CertifiedHierarchy::remove_edge(int level, Edge edge) {
  node(level, edge.a).neighbors.erase(edge.b);
  node(level, edge.b).neighbors.erase(edge.a);
  renew_pair(level, edge.a, edge.b, true);
  renew_children(level, edge);
}

bool CertifiedHierarchy::are_joined(int level, std::int32_t a, std::int32_t b) const {
  return at(level).at(a).neighbors.contains(b);
}

/// Whether the parents of two nodes are one, or joined.
bool CertifiedHierarchy::are_potential(int level, Edge edge) const {
  const std::int32_t p = at(level).at(edge.a).parent, q = at(level).at(edge.b).parent;
  return p >= 0 && q >= 0 && (p == q || are_joined(level + 1, p, q));
}

}  // namespace dch::kinetic
