// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/base/index_count.hpp>
#include <dch/clusters/cluster_pair_maker.hpp>
#include <dch/clusters/cluster_pairs.hpp>
#include <dch/geometry/box.hpp>
#include <dch/lists/list_params.hpp>

#include "clusters/simd/cluster_search_kernels.hpp"
#include "geometry/lattice.hpp"
#include "hierarchy/build/block_order.hpp"
#include "hierarchy/leaf_blocks.hpp"
#include "hierarchy/level.hpp"

namespace dch::detail {

inline constexpr int kSlots = ClusterPairs::kSlots;

/// Makes ClusterPairs: cuts the points of each node of level 1 into clusters of four and finds those within
/// reach of each other among the nodes that edges of level 1 join (Lemma 5.3.1(5)).
///
/// Coordinates are single precision relative to the node's center. The reach is widened by more than they can
/// be off, so no pair within it is missed; a cluster pair a millionth beyond it may be kept. Only operations
/// that round alike on every instruction set are used, so all give the same pairs, on any number of threads.
class ClusterPairFinder {
 public:
  /// What the pairs are found in.
  template <class Metric>
  struct Scene {
    const Metric& metric;
    const Box& box;
    const Level& nodes;
    const LeafBlocks& points;
    Span<const Vec3> positions;  ///< as given, by id
    const ListParams& request;
    double reach;  ///< within which wrapped points may be a pair [length]
  };

  using Work = ClusterPairWork;

  /// Most things that 32-bit indices are to name; fewer in tests alone.
  struct Limits {
    std::int64_t slots = kMaxIndexCount, shifts = kMaxIndexCount;
  };

  template <class Metric>
  void find(const Scene<Metric>& scene, Executor* executor, ClusterPairs& out);
  /// Of the last find().
  Work work() const;
  std::size_t memory_bytes() const;

  Limits limits;

 private:
  /// Lower corner, then the upper one.
  using Corners = std::array<float, 6>;
  /// A node of level 1; its number is also that of its origin.
  struct Node {
    std::int32_t first = 0, clusters = 0;
    double extent = 0;  ///< distance of the farthest point from the center [length]
    Corners box{};      ///< around its points, relative to the center
  };
  /// Boxes of clusters side by side: lower corners, then upper ones, in one array for each coordinate.
  struct Boxes {
    std::array<std::vector<float>, 6> side;
    void make_room(std::size_t count);
    void set(std::size_t k, const Corners& box) {
      for (std::size_t s = 0; s < side.size(); ++s) side[s][k] = box[s];
    }
    Corners at(std::size_t k) const {
      return {side[0][k], side[1][k], side[2][k], side[3][k], side[4][k], side[5][k]};
    }
    BoxArrays from(std::int32_t k) const;
  };
  /// Which cluster stands near a node, and by which of the slice's shifts.
  struct Source {
    std::int32_t cluster, shift;
    std::uint8_t filled, ghosts;  ///< a bit for each slot
  };
  /// What one slice of the work finds and needs.
  struct Slice {
    std::vector<ClusterPairs::Row> rows;
    std::vector<ClusterPairs::Entry> entries;
    std::vector<ClusterPairs::Shift> shift;
    Boxes boxes;  ///< of the clusters near a node, those of the node first
    std::vector<ClusterOfFour<float>> near;
    std::vector<Source> source;  ///< of `near`
    std::vector<std::int32_t> chosen;
    std::vector<std::uint16_t> excluded;  ///< by cluster; all 0 between rows
    Work work;
  };

  /// Some of ClusterPairs::shift.
  struct Shifts {
    std::int64_t first, last;
  };
  /// How the points of a node were ordered, which holds as long as it has the same ones and they have not
  /// moved much. Both by slot of the node's clusters.
  struct Cut {
    std::int32_t first = 0, points = 0;
    std::int32_t age = 0;  ///< searches since
  };
  struct Cuts {
    std::vector<Cut> of_node;
    std::vector<std::int32_t> id;     ///< points as LeafBlocks has them
    std::vector<std::int32_t> place;  ///< which of those comes next in the order
  };

  template <class Metric>
  void cut_into_clusters(const Scene<Metric>& scene, Executor* executor, ClusterPairs& out);
  template <class Metric>
  void cut_node(const Scene<Metric>& scene, std::int32_t k, std::vector<LocalPoint>& local,
                std::vector<LocalPoint>& ordered, ClusterPairs& out);
  bool order_as_before(std::int32_t k);
  void put_cluster(const LocalPoint* points, const std::int32_t* ids, std::int32_t count, std::int32_t c,
                   const ListParams& request, ClusterPairs& out);
  template <class Metric>
  void find_around(const Scene<Metric>& scene, std::int32_t k, const ClusterPairs& clusters, Slice& slice);
  void collect(std::int32_t k, std::int32_t other, Vec3 between, Vec3 image, const ClusterPairs& clusters,
               Slice& slice);
  void append_row(std::int32_t k, std::int32_t own, std::int32_t first_shift, const ListParams& request,
                  const ClusterPairs& clusters, Slice& slice);
  void append_whole_row(std::int32_t c, std::int32_t own, std::int32_t first_shift, std::int32_t found,
                        Slice& slice) const;
  template <class F>
  void for_each_excluded(const Exclusions& exclusions, std::int32_t c, const ClusterPairs& clusters,
                         const F& f) const;
  void mark_exclusions(const Exclusions& exclusions, std::int32_t c, const ClusterPairs& clusters,
                       Slice& slice) const;
  void unmark_exclusions(const Exclusions& exclusions, std::int32_t c, const ClusterPairs& clusters,
                         Slice& slice) const;
  static std::uint32_t pairs_of_wanted_types(const TypeCutoffs& cutoffs, std::int32_t a, std::int32_t b,
                                             const ClusterPairs& clusters);
  std::int32_t shift_count(std::size_t shifts) const;
  double extent(std::int32_t node) const { return nodes_[static_cast<std::size_t>(node)].extent; }
  void join(ClusterPairs& out);
  void append_slices(ClusterPairs& out) const;
  void cut_into_tasks(ClusterPairs& out);
  void append_ranges(Shifts shifts, std::int32_t first_cluster, ClusterPairs& out);

  const ClusterSearchKernels* kernels_ = nullptr;
  Lattice images_{Box()};
  bool one_image_ = true;     ///< whether only the nearest image of a node can matter to another one
  bool drops_types_ = false;  ///< whether some pair of types has no cutoff
  float limit2_ = 0;          ///< squared reach with its margin
  std::vector<Node> nodes_;
  Cuts cuts_, last_cuts_;              ///< of this search, and of the last one that came to its end
  Boxes boxes_;                        ///< of all clusters, each relative to its node
  std::vector<std::uint8_t> filled_;   ///< by cluster: bit of each slot that is no padding
  std::vector<std::uint8_t> ghost_;    ///< by cluster: bit of each slot with a ghost
  std::vector<std::int32_t> slot_of_;  ///< by particle; kept where there are exclusions
  std::vector<Slice> slices_;
  std::vector<std::int32_t> task_of_node_;  ///< the last one of ClusterPairs::tasks that names it
  std::vector<std::int32_t> named_nodes_;   ///< by one of them
};

}  // namespace dch::detail
