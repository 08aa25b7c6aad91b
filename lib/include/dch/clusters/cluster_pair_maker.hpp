// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include <dch/clusters/cluster_pairs.hpp>
#include <dch/hierarchy/hierarchy_view.hpp>
#include <dch/lists/list_params.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// What a search of cluster pairs has looked at: the work, counted alike on every machine.
struct ClusterPairWork {
  std::int64_t beside_nodes = 0;     ///< boxes of clusters, each beside that of a node
  std::int64_t beside_clusters = 0;  ///< boxes of clusters, each beside that of a cluster
  std::int64_t by_points = 0;        ///< pairs of clusters whose points were compared
  std::int64_t by_slots = 0;         ///< pairs of clusters whose slots exclusions, ghosts or types may forbid

  void operator+=(const ClusterPairWork& more) {
    beside_nodes += more.beside_nodes;
    beside_clusters += more.beside_clusters;
    by_points += more.by_points;
    by_slots += more.by_slots;
  }
};

/// Makes cluster pairs of the points of a hierarchy: the same pairs as lists have, for SIMD force kernels,
/// clusters of four being cut from the nodes of level 1. Keeps its memory, and the order of points in
/// clusters, from call to call. Not thread-safe; uses the threads of the hierarchy's executor.
class ClusterPairMaker {
 public:
  ClusterPairMaker();
  ~ClusterPairMaker();
  ClusterPairMaker(ClusterPairMaker&&) noexcept;
  ClusterPairMaker& operator=(ClusterPairMaker&&) noexcept;

  /// Whatever their types or radii, all pairs within the largest list radius may be there, except those with
  /// a cutoff of 0; params.kind and params.order have no meaning here. O(n) at bounded density; the same
  /// result on any number of threads and any instruction set.
  /// @throws InvalidParameter as ListMaker::list(), and if the radius is outside 1e-9..1e9, where single
  /// precision might
  ///   overflow. After any throw `out` is empty or as it was.
  void make(const HierarchyView& view, const ListParams& params, ClusterPairs& out);

  /// Of the last call.
  ClusterPairWork work() const;
  std::size_t memory_bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dch
#pragma GCC visibility pop
