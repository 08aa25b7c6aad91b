// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>
#include <dch/hierarchy/hierarchy_params.hpp>
#include <dch/hierarchy/hierarchy_view.hpp>
#include <dch/hierarchy/search_stats.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// The discrete center hierarchy of a point set and its conflict graph (thesis, chapter 5).
///
/// Level 0 holds all points; level i+1 is a set of discrete centers of level i with radius R_i = 2^i R_0:
/// every node of level i has a parent at level i+1 within R_i, and two nodes of level i+1 are more than R_i
/// apart. G_c joins two nodes of level i within rho_i of each other. rho_0 is `radius`, so that the level-0
/// edges **are** the neighbor list of that radius. R_0 is chosen by the density of the
/// points at each build: the levels below, which no query of the scene needs, are not built. It does not
/// depend on the closest pair, so coincident points are no trouble (one of them stands in level 1).
///
/// Hypotheses: the distance is a metric (Euclidean, or the torus with true nearest images), so the packing
/// lemma 5.3.2 and Lemma 5.3.1 hold at every level; nothing is assumed about density, aspect ratio or motion.
/// Where this departs from the thesis's text (thresholds, repair order, forest roots) see docs/thesis-map.md.
///
/// Points have ids: 0..n-1 after build(), and what insert() returns. Not thread-safe.
///
/// What is thrown for arguments that do not fit is thrown before anything changes, but build() and update()
/// check positions when the old ones are given up. If anything else is thrown (std::bad_alloc, what an
/// Executor throws, InvalidParameter where points that come apart need more blocks than 32-bit
/// numbers name), build(), update(), repair(), insert() and remove() leave the hierarchy
/// empty, without points until the next build(); renumber(), view() and
/// kept_view() leave it as it was.
class Hierarchy {
 public:
  /// @throws InvalidParameter for a radius out of range.
  explicit Hierarchy(const HierarchyParams& params);
  /// For the library's own engines and tests, which may choose how the structure is made too.
  explicit Hierarchy(const detail::StructureParams& params);
  ~Hierarchy();
  Hierarchy(Hierarchy&&) noexcept;
  Hierarchy& operator=(Hierarchy&&) noexcept;
  Hierarchy(const Hierarchy&) = delete;
  Hierarchy& operator=(const Hierarchy&) = delete;

  /// Builds from scratch by insertion in space-filling order, ids 0..n-1. O(n lg alpha) (Theorem 5.4.1).
  /// @throws InvalidPosition, CutoffTooLarge; InvalidParameter for
  ///   more points than 32-bit numbers can name the places of. They stand in blocks of eight, at most 2^28 -
  ///   1 of them, and points far apart take a block each: so 268 million points always fit, more if they are
  ///   dense. The hierarchy is empty after a throw.
  void build(Span<const Vec3> positions, const Box& box);

  /// Takes new positions, indexed by id, in a possibly changed box. With MaintenancePolicy::automatic repair
  /// is put off as long as the displacements so far certify that the edges of level 1 still join all leaves
  /// with points within `radius` of each other: lists are exact all the same. Else the structure is brought
  /// up to date by black-box repair (5.5.2 and 5.5.3, corrected), right for any displacement,
  /// O(n + k lg alpha) for k changes; or a build, as the policy decides. Entries of ids that were removed are
  /// ignored.
  /// @throws InvalidParameter, changing nothing, if the number of positions is not capacity(); as build()
  ///   otherwise.
  void update(Span<const Vec3> positions, const Box& box);

  /// Whether points have moved since the structure was last in order. Parents and edges then are those of
  /// that time, and validate() checks what lists rely on instead.
  bool repair_pending() const;
  /// Does now what update() put off. insert() and remove() do so first.
  void repair();

  /// Adds a point, with its edges in every level: O(lg alpha), or O(1) levels if `near` (optional) is the id
  /// of a point close by. Returns the new id: the smallest free one.
  /// @throws InvalidPosition; InvalidParameter if near is given and not in the hierarchy, and where there may
  ///   be no place left, as build() says.
  std::int32_t insert(Vec3 position, std::int32_t near = -1);

  /// Removes a point; its children find new parents or are promoted: O(lg alpha).
  /// @throws InvalidParameter if there is no such point.
  void remove(std::int32_t id);

  /// Gives every point a new id: the point now called old_of_new[k] is called k from here on. Ids that are
  /// not listed must not be alive. O(n).
  /// @throws InvalidParameter unless old_of_new lists every live id exactly once.
  void renumber(Span<const std::int32_t> old_of_new);

  std::size_t size() const;      ///< number of points
  std::size_t capacity() const;  ///< one more than the largest id ever in use since build()
  bool contains(std::int32_t id) const;
  const Box& box() const;
  const HierarchyParams& params() const;

  /// What lists, cluster pairs, queries and validate() take. Points that have come, gone or changed their
  /// places since the last view are measured: O(n), on the threads of the executor.
  HierarchyView view();

  /// What Nearest takes where points come and go between queries. The first one measures, O(n); from then on
  /// insert() and remove() keep up what they change, so that the next ones cost nothing until update(),
  /// repair() or build(). For no other algorithm.
  HierarchyView kept_view();

  /// Whether to insert and remove so many points in all is less work than to build anew, as counted.
  bool exchange_pays(std::size_t points) const;

  /// Gives all points up. Takes no memory.
  void clear() noexcept;

  const SearchStats& stats() const;

 private:
  friend struct HierarchyTestAccess;  // tests plant faults for validate() to find
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dch
#pragma GCC visibility pop
