// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <dch/geometry/box.hpp>
#include <dch/lists/neighbor_list.hpp>
#include <dch/base/span.hpp>

namespace dch {

/// What an engine did since it was made. Times in seconds of wall clock.
struct SearchStats {
  std::int64_t updates = 0;     ///< calls of update()
  std::int64_t builds = 0;      ///< structures built from scratch
  std::int64_t refreshes = 0;   ///< updates that needed no repair yet: positions only (DCH)
  std::int64_t repairs = 0;     ///< structures brought up to date under motion (0 for engines that cannot)
  std::int64_t promotions = 0;  ///< nodes lifted one level (DCH)
  std::int64_t demotions = 0;   ///< nodes removed from one level (DCH)
  std::int64_t reparented =
      0;  ///< nodes that lost their parent under motion and were given a place again (DCH)
  /// Distances between two points that were computed to build, repair or change the structure: in descents,
  /// for edges, and whether parents still cover (DCH). The same on any number of threads and any instruction
  /// set. Left out is what depends on no position: the sampling of the density, and how far each point moved.
  std::int64_t distances = 0;
  std::int64_t inserted = 0;     ///< particles added to a standing structure
  std::int64_t removed = 0;      ///< particles removed from a standing structure
  int levels = 0;                ///< height of the hierarchy now (DCH)
  double maintain_seconds = 0;   ///< spent in update()
  double list_seconds = 0;       ///< spent in list()
  std::size_t memory_bytes = 0;  ///< held by the structure now, lists left out
};

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

  virtual const SearchStats& stats() const = 0;
  virtual std::string name() const = 0;  ///< "dch", "cell"
};

/// Cell (voxel) list with a hash over occupied cells, built from scratch at every update: the baseline.
/// Cells are of the reduced box and at least `radius` / `divisions` wide.
/// @throws InvalidParameter unless radius is finite and >= 1e-100 and divisions is in 1..4.
std::unique_ptr<PairSearch> make_cell_search(double radius, int divisions = 1);

}  // namespace dch
