// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#pragma GCC visibility push(default)
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
  /// Nodes and blocks of points that insertions and removals looked at, dead ones and those of which no
  /// distance was computed among them (DCH). The same everywhere, as `distances`.
  std::int64_t visited = 0;
  std::int64_t inserted = 0;     ///< particles added to a standing structure
  std::int64_t removed = 0;      ///< particles removed from a standing structure
  int levels = 0;                ///< height of the hierarchy now (DCH)
  double maintain_seconds = 0;   ///< spent in update()
  double list_seconds = 0;       ///< spent in list()
  std::size_t memory_bytes = 0;  ///< held by the structure now, lists left out

  /// Adds what another structure did: counts, not the state it is in nor times.
  SearchStats& operator+=(const SearchStats& other);
};

}  // namespace dch
#pragma GCC visibility pop
