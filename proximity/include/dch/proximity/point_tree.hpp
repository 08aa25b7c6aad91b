// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>
#include <dch/hierarchy/hierarchy_view.hpp>

#pragma GCC visibility push(default)
namespace dch {

namespace detail {
class __attribute__((visibility("hidden"))) TreeChanges;
class __attribute__((visibility("hidden"))) TreeRows;

/// Of a node of a PointTree: how points find their place in it.
struct TreeNet {
  Vec3 site;  ///< a center of its parent's net, and where it stays: points below are near it
  double radius =
      0;             ///< points come to a child within this of its site, and sites are farther apart [length]
  double moved = 0;  ///< how far points below may have moved since the ball was measured [length]
  std::int32_t changes = 0;  ///< points below that came, went or moved alone since then
  std::int32_t room = 0;     ///< places in the row of its children
};
}  // namespace detail

/// Work since a tree was made, for tests and for comparisons on any machine.
struct PointTreeWork {
  std::int64_t builds = 0;    ///< of the whole tree
  std::int64_t compared = 0;  ///< points whose places were compared with those seen before
  std::int64_t placed = 0;    ///< points taken out of the tree or put into it, one by one
  std::int64_t nodes = 0;     ///< looked at for that, and to let balls grow
  std::int64_t measured = 0;  ///< points looked at to measure balls anew
};

/// A hierarchy at full depth: a tree from all points down to single ones, with a measured ball at each node.
///
///     dch::PointTree tree(hierarchy.view());
///     hierarchy.remove(id);
///     const std::int32_t came = hierarchy.insert(position);
///     tree.update(hierarchy.view(), changed_ids);  // or update(hierarchy.view()), which looks at all points
///
/// Above the leaves its nodes are made of those of the hierarchy, which ends at leaves of many points, as
/// lists need. Inside a leaf it goes on with nested nets (thesis 5.2): discrete centers of radius R_0 2^-k,
/// each point below the nearest of them, until points are single or coincide. A node with one child is left
/// out. Balls are measured from the points below, not summed up over the levels, so they are right and tight
/// whether or not a repair is put off. No hypothesis on density, motion or box: the triangle inequality of
/// nearest images is all that is used.
///
/// From then on it is a tree of its own, which changes in update() alone: a point that comes goes down to the
/// nearest center of each net, and is a center of its own where none covers it; one that is farther from a
/// node than its net reaches gets a node above that one, of a net that tells the two apart. So there are O(1)
/// children a node and O(lg alpha) levels, whatever has come and gone, and nothing depends on what the
/// hierarchy did meanwhile. Balls hold all points below them at any time. They grow with what comes and
/// moves, and are measured anew after half as many changes as they have points, or when motion of all may
/// have made them a sixteenth larger than their points need: until then no ball is larger than the points
/// that were below it since it was measured have made it.
///
/// Constant but for update(), which needs the tree alone: several threads may ask at once. The same updates
/// give the same tree.
class PointTree {
 public:
  struct Node {
    Vec3 center;        ///< of the ball, in the cell; the wrapped point if there is one alone
    double radius = 0;  ///< no point below is farther from the center; 0 if all coincide [length]
    double reach = 0;   ///< the same from the representative [length]
    std::int32_t representative = -1;            ///< id of a point below; nearest to the center when measured
    std::int32_t parent = -1;                    ///< -1 for the root
    std::int32_t first_child = 0, children = 0;  ///< nodes in a row; none or more than one
    std::int32_t points = 0;                     ///< how many are below; 0 in a place without a node
  };
  class PointsBelow;

  /// O(n lg alpha) for n points of aspect ratio alpha.
  /// @throws InvalidParameter for so many points that 32-bit numbers might not name all nodes: above 2^30.
  explicit PointTree(const HierarchyView& view);

  /// Takes the points as they are now: those that came, went or moved, found by comparing all positions, a
  /// few nanoseconds each. Nodes may have other numbers afterwards.
  ///
  /// O(lg alpha) for a point that comes or goes, or moves alone, in the mean over many: a node of m points is
  /// measured once in m / 2 changes. Where more than one in 32 moves, O(n) for the balls of all nodes, and
  /// O(n lg alpha) once in as many steps as take points a sixteenth of the radius of their nodes.
  ///
  /// Builds anew where that is less work, as counted: if one in 12 points came, went or is no longer where
  /// its nets put it, and when motion has had balls of 24 n points measured; and for another box.
  ///
  /// What is thrown leaves a tree without points, and the next update() builds it.
  void update(const HierarchyView& view);
  /// The same, told which ids may have come, gone or moved since the call before; ids beyond those of then
  /// are looked at anyway. The tree is wrong if one is left out.
  /// @throws InvalidParameter, changing nothing, for an id beyond those of the hierarchy.
  void update(const HierarchyView& view, Span<const std::int32_t> changed);

  /// Number of points.
  std::size_t size() const { return nodes_.empty() ? 0 : static_cast<std::size_t>(nodes_[0].points); }
  /// One more than the largest id that the hierarchy had in use.
  std::size_t capacity() const { return positions_.size(); }
  /// The root first. Fewer than two nodes a point, none without points. In a tree that was just built
  /// children stand behind their parents. After updates all but the root may stand anywhere, with places
  /// between them that have no node: at most as many again and 64.
  const std::vector<Node>& nodes() const { return nodes_; }
  const Node& node(std::int32_t k) const { return nodes_[static_cast<std::size_t>(k)]; }
  /// All points, those below a node in a row.
  PointsBelow ids() const;
  PointsBelow points_below(const Node& node) const;

  const Box& box() const { return box_; }
  bool contains(std::int32_t id) const;
  /// As given, of a point that there is.
  Vec3 position(std::int32_t id) const { return positions_[static_cast<std::size_t>(id)]; }
  /// Of the nearest images of two points that there are [length^2].
  double distance2(std::int32_t a, std::int32_t b) const { return box_.distance2(position(a), position(b)); }
  /// How far distances of points as given may be from those of wrapped points, which balls are measured by: 0
  /// without a periodic box, else about 1e-14 of the box, more if points lie very many boxes away [length].
  double rounding() const { return rounding_; }
  /// R_0 of the hierarchy when the tree was last built [length].
  double base_radius() const { return base_radius_; }
  const PointTreeWork& work() const { return work_; }

 private:
  friend class detail::TreeChanges;
  friend class detail::TreeRows;
  void build_anew(const HierarchyView& view);
  std::vector<std::int32_t> ids_to_look_at(const HierarchyView& view,
                                           const Span<const std::int32_t>* changed) const;
  void take(const HierarchyView& view, const Span<const std::int32_t>* changed);
  void change(const HierarchyView& view, const std::vector<std::int32_t>& ids);
  void clear() noexcept;

  Box box_;
  double rounding_ = 0, base_radius_ = 0;
  std::vector<Node> nodes_;
  std::vector<detail::TreeNet> nets_;                 ///< by node
  std::int32_t alive_ = 0;                            ///< number of nodes
  std::vector<std::vector<std::int32_t>> free_rows_;  ///< by room: where rows without nodes begin
  std::vector<std::int32_t> node_of_;                 ///< by id: its node, or -1
  std::vector<Vec3> positions_;                       ///< by id
  std::int64_t wear_ = 0;  ///< points that were measured because of motion since the tree was built
  PointTreeWork work_;
};

/// The ids of the points below a node, in the order of the tree: each takes a step or two.
class PointTree::PointsBelow {
 public:
  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = std::int32_t;
    using difference_type = std::ptrdiff_t;
    using pointer = const std::int32_t*;
    using reference = std::int32_t;

    Iterator() = default;
    Iterator(const Node* nodes, const Node* at, std::int32_t left) : nodes_(nodes), at_(at), left_(left) {
      if (left_ > 0) descend();
    }
    std::int32_t operator*() const { return at_->representative; }
    /// The node of the point.
    const Node& node() const { return *at_; }
    Iterator& operator++() {
      if (--left_ == 0) return *this;
      for (const Node* parent = nodes_ + at_->parent;
           at_ + 1 == nodes_ + parent->first_child + parent->children; parent = nodes_ + at_->parent)
        at_ = parent;
      ++at_;
      descend();
      return *this;
    }
    Iterator operator++(int) {
      const Iterator before = *this;
      ++*this;
      return before;
    }
    /// Of two in the same points.
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.left_ == b.left_; }
    friend bool operator!=(const Iterator& a, const Iterator& b) { return a.left_ != b.left_; }

   private:
    void descend() {
      while (at_->children > 0) at_ = nodes_ + at_->first_child;
    }
    const Node* nodes_ = nullptr;
    const Node* at_ = nullptr;
    std::int32_t left_ = 0;
  };

  PointsBelow() = default;
  PointsBelow(const std::vector<Node>& nodes, const Node& node) : nodes_(nodes.data()), node_(&node) {}
  Iterator begin() const { return {nodes_, node_, static_cast<std::int32_t>(size())}; }
  Iterator end() const { return {nodes_, node_, 0}; }
  std::size_t size() const { return node_ ? static_cast<std::size_t>(node_->points) : 0; }

 private:
  const Node* nodes_ = nullptr;
  const Node* node_ = nullptr;
};

inline PointTree::PointsBelow PointTree::ids() const {
  return nodes_.empty() ? PointsBelow() : PointsBelow(nodes_, nodes_[0]);
}
inline PointTree::PointsBelow PointTree::points_below(const Node& node) const { return {nodes_, node}; }

}  // namespace dch
#pragma GCC visibility pop
