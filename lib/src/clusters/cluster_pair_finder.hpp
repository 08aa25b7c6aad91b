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

#include "base/aligned_vector.hpp"
#include "base/resize.hpp"
#include "clusters/simd/cluster_search_kernels.hpp"
#include "geometry/lattice.hpp"
#include "hierarchy/build/block_order.hpp"
#include "hierarchy/leaf_blocks.hpp"
#include "hierarchy/level.hpp"
#include "hierarchy/measured_leaves.hpp"
#include "lists/list_limits.hpp"

namespace dch::detail {

inline constexpr int kSlots = ClusterPairs::kSlots;

/// Makes ClusterPairs: cuts the points of each node of level 1 into clusters of four and finds those within
/// reach of each other among the nodes that edges of level 1 join (Lemma 5.3.1(5)).
///
/// Coordinates are 16-bit integers in frames of the nodes, as those of lists. No pair within the reach is
/// missed, whatever is rounded; cluster pairs up to margin() beyond it may be kept. Integer arithmetic is the
/// same on every instruction set, so all give the same pairs, on any number of threads.
class ClusterPairFinder {
 public:
  /// What the pairs are found in.
  template <class Metric>
  struct Scene {
    const Metric& metric;
    const Box& box;
    const Level& nodes;
    const LeafBlocks& points;
    const MeasuredLeaves& leaves;  ///< the nodes with their points, as they are
    Span<const Vec3> positions;    ///< as given, by id
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
  /// How far beyond the reach two points of a cluster pair may be at the last find(), if none are nearer
  /// [length].
  double margin() const { return limit_.margin; }
  std::size_t memory_bytes() const;

  Limits limits;

 private:
  /// A node of level 1; its number is also that of its origin.
  struct Node {
    std::int32_t first = 0, clusters = 0;
    ClusterBox box{};  ///< around its points, in its frame
    Vec3 origin;       ///< of its frame, relative to the center [length]
  };
  /// What takes points of a node to its frame.
  struct Frame {
    float origin[3], per_unit;
  };
  /// Clusters side by side, with their boxes.
  class Near {
   public:
    void make_room(std::size_t count);
    NearClusters from(std::int32_t k) const;
    NearClustersTo to(std::int32_t k);
    RowCluster row(std::int32_t k) const;
    void set(std::int32_t k, const NearCluster& cluster, const ClusterBox& box);
    std::size_t memory_bytes() const;

   private:
    AlignedVector<NearCluster> cluster_;
    std::array<AlignedVector<std::int16_t>, 6> side_;
  };
  /// What one slice of the work finds and needs.
  struct Slice {
    std::vector<ClusterPairs::Row> rows;
    std::vector<ClusterPairs::Entry> entries;  ///< and room for more
    std::size_t written = 0;                   ///< entries
    Progress progress;                         ///< in nodes
    std::vector<ClusterPairs::Shift> shift;
    Near near;                            ///< the clusters near a node, those of the node first
    std::vector<std::int32_t> section;    ///< where `near` begins, where entries name shifts from another
                                          ///< one on, and where it ends
    std::vector<std::uint16_t> excluded;  ///< by cluster; all 0 between rows
    Work work;
  };

  /// Some of ClusterPairs::shift.
  struct Shifts {
    std::int64_t first, last;
  };
  /// A node beside the one whose rows are found.
  struct NodePair {
    std::int32_t from, to;
    Vec3 between;              ///< their centers [length]
    std::int32_t first_shift;  ///< the first one that leads from that node
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
  void keep_cuts();
  void put_cluster(const LocalPoint* points, const std::int32_t* ids, std::int32_t count, std::int32_t c,
                   const Frame& frame, const ListParams& request, ClusterPairs& out);
  template <class Metric>
  void find_around(const Scene<Metric>& scene, std::int32_t k, const ClusterPairs& clusters, Slice& slice);
  template <class Metric>
  void collect(const Scene<Metric>& scene, const NodePair& pair, Slice& slice);
  void append_rows(std::int32_t own, std::int32_t first_shift, const ListParams& request,
                   const ClusterPairs& clusters, Slice& slice) const;
  std::int32_t restrict_row(std::int32_t c, const ListParams& request, const ClusterPairs& clusters,
                            ClusterPairs::Entry* row, std::int32_t found, Slice& slice) const;
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
  static void swap_found(Slice& slice, ClusterPairs& out);
  void join(Executor* executor, ClusterPairs& out);
  void append_slices(Executor* executor, ClusterPairs& out) const;
  void cut_into_tasks(ClusterPairs& out);
  void append_ranges(Shifts shifts, std::int32_t first_node, ClusterPairs& out);

  const ClusterSearchKernels* kernels_ = nullptr;
  Lattice images_{Box()};
  bool one_image_ = true;     ///< whether only the nearest image of a node can matter to another one
  bool drops_types_ = false;  ///< whether some pair of types has no cutoff
  double unit_ = 1;           ///< of coordinates [length]
  ReachLimit limit_{};        ///< of sums of squares
  std::vector<Node> nodes_;
  Cuts cuts_, last_cuts_;              ///< of this search, and of the last one that came to its end
  Near clusters_;                      ///< all of them, each in the frame of its node
  std::vector<std::uint8_t> ghost_;    ///< by cluster: bit of each slot with a ghost
  std::vector<std::int32_t> slot_of_;  ///< by particle; kept where there are exclusions
  std::vector<Slice> slices_;
  std::vector<std::uint8_t> is_named_;  ///< by node, of one of ClusterPairs::tasks
};

}  // namespace dch::detail
