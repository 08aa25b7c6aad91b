// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/clusters/cluster_pairs.hpp>
#include <dch/geometry/box.hpp>
#include <dch/hierarchy/hierarchy_params.hpp>
#include <dch/hierarchy/hierarchy_view.hpp>
#include <dch/hierarchy/search_stats.hpp>
#include <dch/lists/list_params.hpp>
#include <dch/lists/neighbor_list.hpp>
#include <dch/lists/unlisted_pair.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// An engine that keeps a search structure over moving particles and writes neighbor lists from it.
///
///     auto search = dch::make_dch_search(params.list_radius());
///     search->update(positions, box);          // build, later: repair
///     dch::NeighborList list = search->list(params);
///
/// The same input gives the same list, whatever the history of the structure. Not thread-safe; distinct
/// objects are independent.
class PairSearch {
 public:
  virtual ~PairSearch() = default;

  /// Takes new positions (any displacement, any change of the box or of the number of particles).
  /// `keys`, if given, name the particles: one distinct number each, the same from call to call, so that a
  /// host may re-sort, add and drop particles and the structure survives. Without keys particle i is particle
  /// i. The positions are copied.
  /// @throws InvalidPosition; InvalidParameter if keys repeat or their number is not that of the positions;
  ///   CutoffTooLarge if the search radius exceeds box.max_cutoff(). After a throw the structure holds
  ///   nothing until the next successful update().
  virtual void update(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys = {}) = 0;

  /// As update() without keys, for callers who keep `positions` where and as they are until the next update
  /// or the last call about this one. The grid reads them there in place of a copy; other engines do as
  /// update().
  virtual void update_by_reference(Span<const Vec3> positions, const Box& box) { update(positions, box); }

  /// All pairs that params asks for, at the positions of the last update.
  /// @throws InvalidParameter if params.list_radius() exceeds the radius the engine was made for, for a
  ///   negative or non-finite skin, and for types or exclusions that do not fit the particles. After any
  ///   throw the particles are there as before, and `out` is empty or as it was.
  virtual void list(const ListParams& params, NeighborList& out) = 0;
  NeighborList list(const ListParams& params) {
    NeighborList out;
    list(params, out);
    return out;
  }

  /// Several lists at the positions of the last update, one for each request; out[k] is what
  /// list(requests[k]) gives. Engines that can share work between them do.
  virtual void lists(Span<const ListParams> requests, std::vector<NeighborList>& out);
  std::vector<NeighborList> lists(const std::vector<ListParams>& requests) {
    std::vector<NeighborList> out;
    lists(requests, out);
    return out;
  }

  /// The pairs of list(params), each once, in pieces: for callers who look at each pair and keep none of
  /// them. Calls use(piece) with half lists, unsorted, each of which holds until use() returns; params.kind
  /// and params.order have no meaning here. A pair stands in the row of either particle, ghost or not. Which
  /// pairs a piece has depends on the engine and its threads. Engines that make rows on several threads call
  /// use() on several at once; the grid never holds more than a piece a thread, other engines a whole list.
  /// @throws as list(), and what use() throws.
  virtual void list_in_pieces(const ListParams& params, const std::function<void(const NeighborList&)>& use);

  /// The pairs within the list radius for SIMD force kernels, at the positions of the last update: whatever
  /// their types or radii, all of them, except those with a cutoff of 0; params.kind and params.order have no
  /// meaning here. The same on any number of threads and any instruction set.
  /// @throws InvalidParameter as list(), if the radius is outside 1e-9..1e9, where single precision might
  /// overflow, and
  ///   from engines that make none: has_cluster_pairs() says which.
  virtual void cluster_pairs(const ListParams& params, ClusterPairs& out);
  virtual bool has_cluster_pairs() const { return false; }

  /// Whether a list made at the last update lacks a pair that is within its cutoff now: asks the structure as
  /// it was then about the particles that have moved far, and changes nothing. By the definition of
  /// ListParams, so all engines that can tell say the same. A query takes a fraction of a microsecond for
  /// each of them. Engines that keep no structure, or whose lists were found without it, answer `unknown`,
  /// and so do all where a TieBreaker decides about pairs.
  virtual UnlistedPair unlisted_pair(const UnlistedQuestion& question);

  /// Checks the structure against all pairs, in O(n^2). Returns an empty string if all is in order (or no
  /// structure is kept), else a description of the first fault.
  virtual std::string validate() { return {}; }
  /// The levels of the hierarchy, from the lowest on; none of engines without one, or with several.
  virtual std::vector<LevelInfo> levels() { return {}; }

  virtual const SearchStats& stats() const = 0;
  virtual std::string name() const = 0;  ///< "dch", "grid", "cell", "auto"
  /// Which engine is in use and why, in words, as "grid: 41 points a cell, spread 1.1"; empty where there is
  /// no choice, or none has been made yet.
  virtual std::string choice() const { return {}; }
};

/// An engine on a hierarchy of its own; see PairSearch.
/// @throws as Hierarchy's constructor.
std::unique_ptr<PairSearch> make_dch_search(const HierarchyParams& params);
std::unique_ptr<PairSearch> make_dch_search(double radius);

/// Cell (voxel) list with a hash over occupied cells, built from scratch at every update: the baseline.
/// Cells are of the reduced box and at least `radius` / `divisions` wide.
/// @throws InvalidParameter unless radius is finite and >= 1e-100 and divisions is in 1..4.
std::unique_ptr<PairSearch> make_cell_search(double radius, int divisions = 1);

/// Points sorted into cells anew at every update, rows found with the vector units as those of the hierarchy
/// are: the twin of the hierarchy, fastest where the density is even and points move far. From update to
/// update it keeps only how wide cells were and how many points they held: update() puts points into cells
/// for lists as the last ones, and other lists take a pass more. The width of cells, and whether particles of
/// different sizes have grids of their own, goes by counts of the points; so where list radii reach half the
/// box, or points lie a million cells apart, it finds pairs as make_cell_search() does.
/// @param executor threads to make lists with; null for that of the caller alone. Not owned; results do not
///   depend on it.
/// @throws InvalidParameter unless radius is in kMinListRadius..kMaxListRadius.
std::unique_ptr<PairSearch> make_grid_search(double radius, Executor* executor = nullptr);

/// The grid where density is even or the hierarchy has much to repair, the hierarchy elsewhere: by counts of
/// occupied cells and of the distances that the hierarchy computed, never by a clock, so the same updates
/// make the same choice. It looks anew at a list after 32 updates, or when the number of particles, the
/// volume of the box or the list radius has changed by a quarter, and chooses anew if these or the counts
/// have. Cluster pairs always come from the hierarchy, which serves lists too while they are asked for.
/// @throws as Hierarchy's constructor.
std::unique_ptr<PairSearch> make_auto_search(const HierarchyParams& params);

/// The engine of that name: "dch", "grid", "cell" or "auto". Those that keep no hierarchy take what concerns
/// them of the parameters.
/// @throws InvalidParameter for another name, and as the function that makes the engine.
std::unique_ptr<PairSearch> make_search(const std::string& name, const HierarchyParams& params);

}  // namespace dch
#pragma GCC visibility pop
