// SPDX-License-Identifier: MIT
//
// Every invariant of Lemma 5.3.1 and of the arrays, checked against all pairs. Shares only the metric with
// the code that maintains them.
#include <algorithm>
#include <cmath>
#include <sstream>

#include <dch/hierarchy/hierarchy_view.hpp>

#include "geometry/metric.hpp"
#include "geometry/position_check.hpp"
#include "geometry/tolerance.hpp"
#include "hierarchy/structure.hpp"

namespace dch {

using detail::kInflate;
using detail::kNone;
using detail::Level;
using detail::Structure;
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

/// Blocks of points: filled from the front, in the chain of exactly one leaf.
void check_blocks(const Structure& h, Verdict& verdict) {
  const detail::LeafBlocks& points = h.points;
  std::int32_t alive = 0;
  std::vector<char> seen(points.leaf.size(), 0);
  for (std::int32_t k = 0; k < h.levels[1].size(); ++k) {
    if (!h.levels[1].is_alive(k)) continue;
    for (std::int32_t block = h.levels[1].first_child[k]; block != kNone; block = points.next[block]) {
      if (!verdict.require(!seen[block] && points.leaf[block] == k, 1, "the blocks of point ",
                           h.levels[1].id[k], " are not its own"))
        return;
      seen[block] = 1;
      alive += points.count[block];
      for (std::int32_t lane = 0; lane < detail::kBlock; ++lane)
        verdict.require((points.id[block * detail::kBlock + lane] != kNone) == (lane < points.count[block]),
                        0, "block ", block, " is not filled from the front");
    }
  }
  verdict.require(alive == points.alive, 0, points.alive, " points, but ", alive, " in blocks");
  for (std::size_t block = 0; block < seen.size(); ++block) {
    if (!seen[block]) continue;
    const std::int32_t first = h.levels[1].first_child[points.leaf[block]], next = points.next[block];
    verdict.require(points.prev[next == kNone ? first : next] == static_cast<std::int32_t>(block), 0,
                    "block ", block, " is not linked back to");
  }
  for (std::size_t block = 0; block < seen.size(); ++block)
    verdict.require(seen[block] || points.leaf[block] == kNone, 0, "block ", block, " is in no chain");
}

/// Singletons: known to their points, without edges and children. That no other node is near is for
/// check_pairs().
void check_singletons(const Structure& h, Verdict& verdict) {
  for (std::size_t k = 0; k < h.singletons.size(); ++k) {
    const auto [i, node] = h.singletons[k];
    const std::int32_t place = Structure::place_of_singleton(static_cast<std::int32_t>(k));
    if (!verdict.require(i > 1 && i <= h.top() && h.is_alive(i, node) && h.levels[i].down[node] == place &&
                             h.slot_of_id[h.id(i, node)] == place,
                         i, "singleton ", k, " is not that of its point"))
      return;
    verdict.require(h.levels[i].first_child[node] == kNone && h.levels[i].edges.row(node).empty(), i,
                    "point ", h.id(i, node), " is not on its own");
  }
}

/// Ids, positions and the links between a point's own nodes: S_0 holds every point, S_{i+1} is a subset of
/// S_i.
void check_nesting(const Structure& h, Verdict& verdict) {
  std::int64_t count = 0;
  for (std::size_t id = 0; id < h.slot_of_id.size(); ++id) {
    const std::int32_t slot = h.slot_of_id[id];
    if (slot == kNone) continue;
    ++count;
    if (h.is_singleton_point(static_cast<std::int32_t>(id))) continue;
    verdict.require(slot < h.points.size() && h.points.id[slot] == static_cast<std::int32_t>(id), 0,
                    "slot of point ", id, " holds another point");
  }
  const std::int64_t places = h.points.alive + static_cast<std::int64_t>(h.singletons.size());
  verdict.require(count == places, 0, count, " points but ", places, " nodes");
  check_singletons(h, verdict);
  for (int i = 0; i <= h.top(); ++i) {
    std::int64_t promoted = 0;
    for (std::int32_t k = 0; k < h.size(i); ++k) {
      if (!h.is_alive(i, k)) continue;
      if (i > 0 && !h.is_singleton(i, k)) {
        const std::int32_t down = h.levels[i].down[k];
        if (!verdict.require(down != kNone && h.id(i - 1, down) == h.id(i, k) && h.up(i - 1, down) == k, i,
                             "point ", h.id(i, k), " does not stand in the level below"))
          return;
        verdict.require(h.position(i - 1, down) == h.position(i, k) || (h.pending && i > 1), i,
                        "position of point ", h.id(i, k), " differs from the level below");
      }
      if (i == h.top() || h.up(i, k) == kNone) continue;
      ++promoted;
      verdict.require(h.levels[i + 1].down[h.up(i, k)] == k && h.parent(i, k) == h.up(i, k), i, "point ",
                      h.id(i, k), " is not its own parent although it stands in the level above");
    }
    if (i == h.top()) continue;
    const auto singletons = std::count_if(h.singletons.begin(), h.singletons.end(),
                                          [&](const auto& n) { return n.level == i + 1; });
    verdict.require(promoted + singletons == h.alive(i + 1), i + 1, "holds nodes without a node below");
  }
}

/// Parents cover their children, and the lists of children are exactly the inverse of `parent`.
template <class Metric>
void check_coverage(const Metric& metric, const Structure& h, Verdict& verdict) {
  for (int i = 0; i <= h.top(); ++i) {
    for (std::int32_t k = 0; k < h.size(i); ++k) {
      if (!h.is_alive(i, k)) continue;
      const std::int32_t parent = h.parent(i, k);
      if (i == h.top()) {
        verdict.require(parent == kNone, i, "root ", h.id(i, k), " has a parent");
        continue;
      }
      if (!verdict.require(parent != kNone && h.is_alive(i + 1, parent), i, "point ", h.id(i, k),
                           " has no parent"))
        return;
      verdict.require(metric.distance2(h.position(i, k), h.position(i + 1, parent)) <= h.levels[i].radius2, i,
                      "point ", h.id(i, k), " is farther than R_i = ", h.levels[i].radius,
                      " from its parent ", h.id(i + 1, parent));
    }
    if (i == 0 || i == h.top()) continue;  // chains of blocks have been checked
    const Level& level = h.levels[i];
    std::int64_t children = 0;
    for (std::int32_t parent = 0; parent < h.levels[i + 1].size(); ++parent) {
      if (!h.levels[i + 1].is_alive(parent)) continue;
      std::int32_t previous = kNone;
      for (std::int32_t k = h.levels[i + 1].first_child[parent]; k != kNone; k = level.next_sibling[k]) {
        if (!verdict.require(
                level.is_alive(k) && level.parent[k] == parent && level.prev_sibling[k] == previous, i,
                "list of children of ", h.id(i + 1, parent), " is broken"))
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

/// A node of a level, or the point of a singleton of a level above, which stands there all the same.
struct Member {
  std::int32_t node;  ///< kNone if it is not in memory
  std::int32_t id;
  Vec3 at;
};
std::vector<Member> members_of(const Structure& h, int i) {
  std::vector<Member> members;
  for (std::int32_t k = 0; k < h.size(i); ++k)
    if (h.is_alive(i, k)) members.push_back({k, h.id(i, k), h.position(i, k)});
  for (const auto& [level, node] : h.singletons)
    if (level > i) members.push_back({kNone, h.id(level, node), h.position(level, node)});
  return members;
}

/// Separation (5.3.1(2)) and edges (5.3.1(3)), stored or enumerated, of one level against all pairs.
template <class Metric>
void check_pairs(const Metric& metric, const Structure& h, int i, Verdict& verdict) {
  const double threshold2 = h.levels[i].threshold2;
  const double separation2 = i == 0 ? -1 : h.levels[i - 1].radius2;  // level 0 may hold coincident points
  for (std::int32_t k = 0; k < h.size(i) && i > 0; ++k)
    verdict.require(
        h.is_alive(i, k) || (h.levels[i].edges.row(k).empty() && h.levels[i].first_child[k] == kNone), i,
        "a dead node has edges or children");
  Marks joined(h.size(i));
  std::vector<std::int32_t> row;
  // Reaches follow how far out the points are, which may have been farther when an edge was made.
  const double rounding = detail::WrapError(h.box).bound(h.largest_reach);
  const double longest = (h.levels[i].longest + 2 * h.levels[i].moved) * kInflate + rounding;
  const double longest2 = longest * longest;
  const std::vector<Member> members = members_of(h, i);
  for (std::size_t m = 0; m < members.size() && !verdict.failed(); ++m) {
    const Member& a = members[m];
    row.clear();
    if (a.node != kNone) h.neighbors(metric, i, a.node, row);
    if (a.node != kNone && i > 1)
      for (const std::int32_t k : h.levels[i].edges.row(a.node))
        verdict.require(metric.distance2(a.at, h.position(i, k)) <= longest2, i, "edge between ", a.id,
                        " and ", h.id(i, k), " is longer than any should be");
    verdict.require(joined.set(static_cast<std::int32_t>(m), row), i, "point ", a.id, " has a repeated edge");
    for (const std::int32_t k : row)
      verdict.require(k != a.node && h.is_alive(i, k), i, "point ", a.id,
                      " has an edge to itself or a dead node");
    for (const Member& b : members) {
      if (&a == &b) continue;
      const bool edge = b.node != kNone && joined.has(static_cast<std::int32_t>(m), b.node);
      const double d2 = metric.distance2(a.at, b.at);
      if (d2 > separation2 && edge == (d2 <= threshold2)) continue;
      verdict.require(d2 > separation2, i, "points ", a.id, " and ", b.id, " at distance ", std::sqrt(d2),
                      " are not separated by more than ", h.levels[i == 0 ? 0 : i - 1].radius);
      verdict.require(edge == (d2 <= threshold2), i, "edge between ", a.id, " and ", b.id, " at distance ",
                      std::sqrt(d2), edge ? " should not exist" : " is missing", " (threshold ",
                      h.levels[i].threshold, ")");
    }
  }
}

/// What lists rely on while repair is put off: points within rho_0 of each other have equal or joined
/// parents, and singletons have none so near.
template <class Metric>
void check_reachable_pairs(const Metric& metric, const Structure& h, Verdict& verdict) {
  Marks joined(h.size(1));
  const auto require_far = [&](double d2, std::int32_t a, std::int32_t b) {
    verdict.require(d2 > h.levels[0].threshold2, 0, "repair is pending, and points ", a, " and ", b,
                    " at distance ", std::sqrt(d2), " have parents that no edge joins");
  };
  for (std::int32_t k = 0; k < h.size(1) && !verdict.failed(); ++k) {
    if (!h.is_alive(1, k)) continue;
    joined.set(k, h.levels[1].edges.row(k));
    h.for_each_child(1, k, [&](std::int32_t a) {
      for (std::int32_t b = 0; b < h.size(0); ++b)
        if (h.is_alive(0, b) && h.parent(0, b) != k && !joined.has(k, h.parent(0, b)))
          require_far(metric.distance2(h.position(0, a), h.position(0, b)), h.id(0, a), h.id(0, b));
    });
  }
  for (const auto& [level, node] : h.singletons) {
    const std::int32_t a = h.id(level, node);
    for (std::size_t b = 0; b < h.raw.size(); ++b)
      if (static_cast<std::int32_t>(b) != a && h.slot_of_id[b] != kNone)
        require_far(metric.distance2(h.box.wrap(h.raw[a]), h.box.wrap(h.raw[b])), a,
                    static_cast<std::int32_t>(b));
  }
}

}  // namespace

std::string validate(const HierarchyView& hierarchy) {
  const Structure& h = hierarchy.structure();
  const int top = h.top(), most_roots = h.params.max_roots;
  Verdict verdict;
  verdict.require(top == 1 || h.levels[top - 1].alive() + h.singletons_above(top - 1) > most_roots, top,
                  "is not needed");
  verdict.require(h.levels.back().alive() <= most_roots, top, "has ", h.levels.back().alive(),
                  " roots, more than ", most_roots);
  check_blocks(h, verdict);
  if (!verdict.failed()) check_nesting(h, verdict);
  if (verdict.failed()) return verdict.text();
  with_metric(h.box, [&](const auto& metric) {
    if (h.pending) return check_reachable_pairs(metric, h, verdict);
    check_coverage(metric, h, verdict);
    for (int i = 0; i <= top && !verdict.failed(); ++i) check_pairs(metric, h, i, verdict);
  });
  return verdict.text();
}

}  // namespace dch
