// SPDX-License-Identifier: MIT
//
// Every invariant of Lemma 5.3.1 and of the arrays, checked against all pairs. Shares only the metric with
// the code that maintains them.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "hierarchy_impl.hpp"

namespace dch {

using detail::kNone;
using detail::Level;
using detail::with_metric;

namespace {

/// Collects the first violation only.
class Verdict {
 public:
  template <class... Parts>
  bool require(bool holds, int level, const Parts&... parts) {
    if (holds || !text_.empty()) return holds;
    std::ostringstream out;
    out.precision(17);
    out << "level " << level << ": ";
    (out << ... << parts);
    text_ = out.str();
    return false;
  }
  bool failed() const { return !text_.empty(); }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Ids, positions and the links between a point's own nodes: S_0 holds every point, S_{i+1} is a subset of
/// S_i.
void check_nesting(const std::vector<Level>& levels, const std::vector<std::int32_t>& slot_of_id,
                   Verdict& verdict) {
  std::int64_t points = 0;
  for (std::size_t id = 0; id < slot_of_id.size(); ++id) {
    const std::int32_t slot = slot_of_id[id];
    if (slot == kNone) continue;
    ++points;
    verdict.require(slot < levels[0].size() && levels[0].id[slot] == static_cast<std::int32_t>(id), 0,
                    "slot of point ", id, " holds another point");
  }
  verdict.require(points == levels[0].alive(), 0, points, " points but ", levels[0].alive(), " nodes");
  for (int i = 0; i < static_cast<int>(levels.size()); ++i) {
    const Level& level = levels[i];
    const bool is_top = i + 1 == static_cast<int>(levels.size());
    std::int64_t lifted = 0;
    for (std::int32_t k = 0; k < level.size(); ++k) {
      if (!level.is_alive(k)) continue;
      if (i > 0) {
        const std::int32_t down = level.down[k];
        if (!verdict.require(
                down != kNone && levels[i - 1].id[down] == level.id[k] && levels[i - 1].up[down] == k, i,
                "point ", level.id[k], " does not stand in the level below"))
          return;
        verdict.require(levels[i - 1].position[down] == level.position[k], i, "position of point ",
                        level.id[k], " differs from the level below");
      }
      if (level.up[k] == kNone) continue;
      ++lifted;
      verdict.require(!is_top && levels[i + 1].down[level.up[k]] == k && level.parent[k] == level.up[k], i,
                      "point ", level.id[k], " is not its own parent although it stands in the level above");
    }
    if (!is_top) verdict.require(lifted == levels[i + 1].alive(), i + 1, "holds nodes without a node below");
  }
}

/// Parents cover their children, and the lists of children are exactly the inverse of `parent`.
template <class Metric>
void check_coverage(const Metric& metric, const std::vector<Level>& levels, Verdict& verdict) {
  for (int i = 0; i < static_cast<int>(levels.size()); ++i) {
    const Level& level = levels[i];
    const bool is_top = i + 1 == static_cast<int>(levels.size());
    for (std::int32_t k = 0; k < level.size(); ++k) {
      if (!level.is_alive(k)) continue;
      const std::int32_t parent = level.parent[k];
      if (is_top) {
        verdict.require(parent == kNone, i, "root ", level.id[k], " has a parent");
        continue;
      }
      if (!verdict.require(parent != kNone && levels[i + 1].is_alive(parent), i, "point ", level.id[k],
                           " has no parent"))
        return;
      verdict.require(metric.distance2(level.position[k], levels[i + 1].position[parent]) <= level.radius2, i,
                      "point ", level.id[k], " is farther than R_i = ", level.radius, " from its parent ",
                      levels[i + 1].id[parent]);
    }
    if (is_top) continue;
    std::int64_t children = 0;
    for (std::int32_t parent = 0; parent < levels[i + 1].size(); ++parent) {
      if (!levels[i + 1].is_alive(parent)) continue;
      std::int32_t previous = kNone;
      for (std::int32_t k = levels[i + 1].first_child[parent]; k != kNone; k = level.next_sibling[k]) {
        if (!verdict.require(
                level.is_alive(k) && level.parent[k] == parent && level.prev_sibling[k] == previous, i,
                "list of children of ", levels[i + 1].id[parent], " is broken"))
          return;
        previous = k;
        if (!verdict.require(++children <= level.alive(), i, "lists of children hold a cycle")) return;
      }
    }
    verdict.require(children == level.alive(), i, children, " nodes in lists of children, but ",
                    level.alive(), " nodes");
  }
}

/// Says which of the nodes of a level are in a row, in constant time.
class Marks {
 public:
  explicit Marks(std::int32_t nodes) : row_of_(static_cast<std::size_t>(nodes), kNone) {}
  /// False if a node is named twice.
  template <class Row>
  bool set(std::int32_t owner, const Row& row) {
    for (const std::int32_t k : row) {
      if (row_of_[k] == owner) return false;
      row_of_[k] = owner;
    }
    return true;
  }
  bool has(std::int32_t owner, std::int32_t k) const { return row_of_[k] == owner; }

 private:
  std::vector<std::int32_t> row_of_;  ///< by node: the last owner that named it
};

/// Separation (5.3.1(2)) and edges (5.3.1(3)), stored or enumerated, of one level against all pairs.
template <class Metric, class FindNeighbors>
void check_pairs(const Metric& metric, const std::vector<Level>& levels, int i,
                 const FindNeighbors& find_neighbors, Verdict& verdict) {
  const Level& level = levels[i];
  const double separation2 = i == 0 ? -1 : levels[i - 1].radius2;  // level 0 may hold coincident points
  Marks joined(level.size());
  std::vector<std::int32_t> row;
  for (std::int32_t a = 0; a < level.size() && !verdict.failed(); ++a) {
    verdict.require(level.is_alive(a) || level.edges.row(a).empty(), i, "a dead node has edges");
    if (!level.is_alive(a)) continue;
    row.clear();
    find_neighbors(a, row);
    verdict.require(joined.set(a, row), i, "point ", level.id[a], " has a repeated edge");
    for (std::int32_t b = 0; b < level.size(); ++b) {
      const bool edge = joined.has(a, b);
      if (a == b || !level.is_alive(b)) {
        verdict.require(!edge, i, "point ", level.id[a], " has an edge to itself or a dead node");
        continue;
      }
      const double d2 = metric.distance2(level.position[a], level.position[b]);
      if (d2 > separation2 && edge == (d2 <= level.threshold2)) continue;
      verdict.require(d2 > separation2, i, "points ", level.id[a], " and ", level.id[b], " at distance ",
                      std::sqrt(d2), " are not separated by more than ", levels[i - 1].radius);
      verdict.require(edge == (d2 <= level.threshold2), i, "edge between ", level.id[a], " and ", level.id[b],
                      " at distance ", std::sqrt(d2), edge ? " should not exist" : " is missing",
                      " (threshold ", level.threshold, ")");
    }
  }
}

}  // namespace

std::string Hierarchy::Impl::validate() const {
  Verdict verdict;
  verdict.require(top() == 0 || levels[top() - 1].alive() > params.max_roots, top(), "is not needed");
  verdict.require(levels.back().alive() <= params.max_roots, top(), "has ", levels.back().alive(),
                  " roots, more than ", params.max_roots);
  check_nesting(levels, slot_of_id, verdict);
  if (verdict.failed()) return verdict.text();
  with_metric(box, [&](const auto& metric) {
    check_coverage(metric, levels, verdict);
    for (int i = 0; i <= top() && !verdict.failed(); ++i) {
      const auto find = [&](std::int32_t k, std::vector<std::int32_t>& nodes) {
        neighbors(metric, i, k, nodes);
      };
      check_pairs(metric, levels, i, find, verdict);
    }
  });
  return verdict.text();
}

}  // namespace dch
