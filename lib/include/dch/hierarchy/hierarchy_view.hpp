// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>
#include <dch/hierarchy/hierarchy_params.hpp>

#pragma GCC visibility push(default)
namespace dch {

namespace detail {
struct Structure;
struct StructureParams;
}  // namespace detail

/// One level of a hierarchy, for tests, statistics and plots.
struct LevelInfo {
  double covering_radius = 0;  ///< R_i = 2^i r0: level i+1 covers level i within it [length]
  double edge_threshold = 0;   ///< rho_i [length]
  std::int64_t nodes = 0;
  std::int64_t edges = 0;  ///< stored: those of G_c and, from level 2 on, some longer ones; -1 for level 0,
                           ///< where lists enumerate them
  std::int64_t max_degree = 0;  ///< most stored edges of a node
};

/// A hierarchy to be looked at: its points, levels and edges, which nobody changes through this. Lists,
/// cluster pairs and queries take one. It is a pointer to copy as you like, and good until the hierarchy is
/// next changed or destroyed.
class HierarchyView {
 public:
  std::size_t size() const;      ///< number of points
  std::size_t capacity() const;  ///< one more than the largest id ever in use since build()
  bool contains(std::int32_t id) const;
  Vec3 position(std::int32_t id) const;
  const Box& box() const;
  const HierarchyParams& params() const;
  /// See Hierarchy::repair_pending().
  bool repair_pending() const;

  int levels() const;
  LevelInfo level(int i) const;
  /// Highest level in which the point stands.
  int top_level(std::int32_t id) const;
  /// Id of the parent of the point's node in level i; the point itself if it stands in level i+1; -1 for a
  /// root.
  /// @throws InvalidParameter if the point does not stand in level i.
  std::int32_t parent(std::int32_t id, int i) const;
  /// Ids of the neighbors in level i of G_c, ascending. Those of level 0 are not stored, but enumerated among
  /// the children of neighboring parents (Lemma 5.3.1(5)).
  /// @throws InvalidParameter if the point does not stand in level i.
  std::vector<std::int32_t> neighbors(std::int32_t id, int i) const;

  /// For the library's own algorithms.
  explicit HierarchyView(const detail::Structure& structure) : structure_(&structure) {}
  const detail::Structure& structure() const { return *structure_; }

 private:
  const detail::Structure* structure_;
};

/// Checks every invariant of Lemma 5.3.1 and of the data layout against all pairs: nesting, coverage,
/// separation, parents, children, edges of every level. O(n^2) time, for tests and for --verify. Returns an
/// empty string if all hold, else a description of the first violation found.
std::string validate(const HierarchyView& hierarchy);

}  // namespace dch
#pragma GCC visibility pop
