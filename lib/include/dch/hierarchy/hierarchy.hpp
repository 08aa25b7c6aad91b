// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <dch/geometry/box.hpp>
#include <dch/clusters/cluster_pairs.hpp>
#include <dch/base/executor.hpp>
#include <dch/lists/neighbor_list.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/base/span.hpp>

namespace dch {

namespace detail {
class DchSearch;
class SizedSearch;
}  // namespace detail

/// How the edge thresholds rho_i of the conflict graph grow with the level.
enum class EdgeRule {
  /// rho_{i+1} = rho_i + 2 R_i, the smallest thresholds for which Lemma 5.3.1(5) holds: far fewer edges.
  additive,
  /// rho_i = 2 c R_i, as the thesis defines G_c.
  thesis
};

/// When update() repairs and when it builds anew.
enum class MaintenancePolicy {
  automatic,      ///< nothing as long as lists are certified to be complete without, then whichever is less
                  ///< work, as counted before: the same on any machine, however busy
  always_repair,  ///< build once, then repair
  always_rebuild  ///< build at every update
};

/// List radii that a hierarchy can have [length]: coordinates relative to clusters, and their inverse units,
/// stay within single precision.
inline constexpr double kMinListRadius = 1e-30, kMaxListRadius = 1e30;

struct HierarchyParams {
  /// rho_0, the edge threshold of level 0, kMinListRadius..kMaxListRadius [length]: cutoff + skin of the list
  /// that the level-0 edges are.
  double radius = 0;
  /// R_0, the radius within which level 1 covers the points [length]. 0: with EdgeRule::additive 2^k r0 for
  /// the k that gives a node of level 1 about 150 children, which suits lists (measured at each build); with
  /// EdgeRule::thesis r0. At most 16 times the smallest height of a periodic box, if that is wider anywhere.
  double base_radius = 0;
  /// c >= 1.05, ties the scale of the levels to the list: 2 c r0 = radius. EdgeRule::thesis: larger c means
  /// smaller balls, more levels and edges, more slack.
  double c = 1.05;
  EdgeRule edge_rule = EdgeRule::additive;
  MaintenancePolicy policy = MaintenancePolicy::automatic;
  /// Levels are added until this many nodes or fewer are left at the top; those are the roots of a forest and
  /// all pairs of them are looked at. 1 gives the hierarchy of the thesis, with a single root.
  int max_roots = 16;
  /// Path compression: points that have no neighbor in level i >= 2 nor a point below them are in memory in
  /// levels i and above only, and in no cluster of level 1; so that gas in a huge box costs as much as in a
  /// small one.
  bool fold_lone_points = true;
  /// Threads to make lists with; null for that of the caller alone. Not owned; results do not depend on it.
  Executor* executor = nullptr;
  /// For make_dch_search: whether the cutoffs of particles may differ much, by radii or types. Then there is
  /// a hierarchy for each class of sizes, made when a list is asked for; `radius` is the largest list radius.
  bool size_classes = false;
};

/// One level of a hierarchy, for tests, statistics and plots.
struct LevelInfo {
  double covering_radius = 0;  ///< R_i = 2^i r0: level i+1 covers level i within it [length]
  double edge_threshold = 0;   ///< rho_i [length]
  std::int64_t nodes = 0;
  std::int64_t edges = 0;  ///< stored: those of G_c and, from level 2 on, some longer ones; -1 for level 0,
                           ///< where lists enumerate them
  std::int64_t max_degree = 0;  ///< most stored edges of a node
};

/// The discrete center hierarchy of a point set and its conflict graph (thesis, chapter 5).
///
/// Level 0 holds all points; level i+1 is a set of discrete centers of level i with radius R_i = 2^i R_0:
/// every node of level i has a parent at level i+1 within R_i, and two nodes of level i+1 are more than R_i
/// apart. G_c joins two nodes of level i within rho_i of each other. rho_0 is `radius`, so that the level-0
/// edges **are** the neighbor list of that radius. The scale r0 is tied to the list by 2 c r0 = radius. With
/// EdgeRule::thesis R_0 = r0; else R_0 = 2^k r0, and the first k levels, which no query of the scene needs,
/// are not built. R_0 does not depend on the closest pair, so coincident points are no trouble (one of them
/// stands in level 1).
///
/// Hypotheses: the distance is a metric (Euclidean, or the torus with true nearest images), so the packing
/// lemma 5.3.2 and Lemma 5.3.1 hold at every level; nothing is assumed about density, aspect ratio or motion.
/// Where this departs from the thesis's text (thresholds, repair order, forest roots) see docs/thesis-map.md.
///
/// Points have ids: 0..n-1 after build(), and what insert() returns. Not thread-safe.
///
/// What is thrown for arguments that do not fit is thrown before anything changes, but build() and update()
/// check positions when the old ones are given up. If anything else is thrown (std::bad_alloc, what a
/// PairTest or an Executor throws, InvalidParameter where points that come apart need more blocks than 32-bit
/// numbers name), build(), update(), repair(), insert() and remove() leave the hierarchy
/// empty, without points until the next build(); renumber() leaves it as it was. list(), lists() and
/// cluster_pairs() leave it as it was too (empty only where they had to repair it first, since points
/// inserted since update() lie much farther out than all others), and what they were to write is empty or as
/// it was.
class Hierarchy {
 public:
  /// @throws InvalidParameter for a radius or c out of range, or max_roots < 1.
  explicit Hierarchy(const HierarchyParams& params);
  ~Hierarchy();
  Hierarchy(Hierarchy&&) noexcept;
  Hierarchy& operator=(Hierarchy&&) noexcept;
  Hierarchy(const Hierarchy&) = delete;
  Hierarchy& operator=(const Hierarchy&) = delete;

  /// Builds from scratch by insertion in space-filling order, ids 0..n-1. O(n lg alpha) (Theorem 5.4.1).
  /// @throws InvalidPosition, CutoffTooLarge; InvalidParameter for a base_radius too large for the box, and
  /// for
  ///   more points than 32-bit numbers can name the places of. They stand in blocks of eight, at most 2^28 -
  ///   1 of them, and points far apart take a block each: so 268 million points always fit, more if they are
  ///   dense. The hierarchy is empty after a throw.
  void build(Span<const Vec3> positions, const Box& box);

  /// Takes new positions, indexed by id, in a possibly changed box. With MaintenancePolicy::automatic repair
  /// is put off as long as the displacements so far certify that the edges of level 1 still join all clusters
  /// with points within `radius` of each other: lists are exact all the same. Else the structure is brought
  /// up to date by black-box repair (5.5.2/5.5.3 with errata E2, E7, E8, E10), right for any displacement,
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
  Vec3 position(std::int32_t id) const;
  const Box& box() const;
  const HierarchyParams& params() const;

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

  /// The list of all pairs params asks for; row k is the point with id k, rows of free ids are empty.
  /// @throws InvalidParameter if params.list_radius() exceeds radius, or types or exclusions do not fit.
  void list(const ListParams& params, NeighborList& out);
  /// Several lists, out[k] being that of requests[k]: at little more than the cost of the one with the
  /// largest radius, if the cutoffs of all depend on the same types or radii, or on neither.
  void lists(Span<const ListParams> requests, std::vector<NeighborList>& out);

  /// The same pairs for SIMD force kernels, clusters being cut from the nodes of level 1. Whatever their
  /// types or radii, all pairs within the largest list radius may be there, except those with a cutoff of 0;
  /// params.kind and params.order have no meaning here. O(n) at bounded density; the same result on any
  /// number of threads and any instruction set.
  /// @throws InvalidParameter as list(), and if the radius is outside 1e-9..1e9, where single precision might
  /// overflow.
  void cluster_pairs(const ListParams& params, ClusterPairs& out);

  /// Checks every invariant of Lemma 5.3.1 and of the data layout against all pairs: nesting, coverage,
  /// separation, parents, children, edges of every level. O(n^2) time, for tests and for --verify. Returns an
  /// empty string if all hold, else a description of the first violation found.
  std::string validate() const;

  const SearchStats& stats() const;

 private:
  friend struct HierarchyTestAccess;  // tests plant faults for validate() to find
  friend class detail::SizedSearch;   // makes lists from several hierarchies
  friend class detail::DchSearch;     // asks what an exchange of particles costs
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// An engine on a hierarchy of its own; see PairSearch.
/// @throws as Hierarchy's constructor.
std::unique_ptr<PairSearch> make_dch_search(const HierarchyParams& params);
std::unique_ptr<PairSearch> make_dch_search(double radius);

/// The hierarchy that an engine of make_dch_search() keeps, for statistics and validate(); null for other
/// engines. It lives as long as the engine; after a successful update() ids are indices.
const Hierarchy* hierarchy_of(const PairSearch& search);
/// The same, to be asked for cluster pairs. Whatever adds, removes or renumbers points is for the engine
/// alone.
Hierarchy* hierarchy_of(PairSearch& search);

}  // namespace dch
