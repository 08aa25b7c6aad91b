// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>

#include "base/aligned_vector.hpp"
#include "hierarchy/level.hpp"
#include "lists/pair_filter.hpp"
#include "hierarchy/leaf_blocks.hpp"
#include "simd/list_kernels.hpp"

namespace dch::detail {

/// Lengths of one unit of the integers that lists are made with.
struct ListUnits {
  double point = 1, box = 1;  ///< of points, and of the boxes of blocks [length]
};

/// Which particles the ids of a hierarchy are.
struct ParticleNames {
  Span<const std::int32_t> particle_of_id;  ///< empty where ids are those of the particles
  std::uint64_t version = 0;  ///< another one when these or the sizes of particles may have changed; 0 where
                              ///< that is not known of sizes
};

/// The points as lists are made from them: relative to the center of their cluster (a node of level 1), in
/// blocks with a box around each, first as lengths, then as 16-bit integers. The blocks of a cluster lie side
/// by side.
struct ClusterPoints {
  struct Cluster {
    std::int32_t first_block = 0, blocks = 0;
    double extent = 0;       ///< distance of the farthest point from the center [length]
    double width = 0;        ///< of the box around the points and the center, along its longest side [length]
    double block_width = 0;  ///< the same of the widest block
    std::int32_t uncovered = 0;  ///< points farther from the center than asked
    bool owned = true;           ///< whether a point is not a ghost
  };
  /// Positions of a block's points relative to the cluster's center [length].
  struct Offsets {
    float axis[3][kBlock];
  };
  /// The box around them [length].
  struct Corners {
    float low[3], high[3];
  };

  /// To be called when points have come, gone or changed their cluster, slot or id.
  void forget_layout() { laid_out_ = named_ = false; }

  /// Takes the positions. To be called again when a point has moved, come or gone. Counts those whose squared
  /// distance from their center exceeds `covered2`.
  template <class Metric>
  void measure(const Metric& metric, const Level& centers, PointBlocks& points, double covered2,
               Executor* executor);

  /// The same after motion, with the new positions, by id: wraps them into their slots too, in the same pass.
  /// Those of the centers are up to date already.
  template <class Metric>
  void refresh(const Metric& metric, const Level& centers, Span<const Vec3> positions, PointBlocks& points,
               double covered2, Executor* executor);

  /// Takes from `filter` which points are ghosts and what the cutoffs of pairs depend on.
  void name(const PointBlocks& points, const ParticleNames& names, const PairFilter& filter,
            Executor* executor);
  /// Rounds everything to the units. To be called after name().
  void quantize(const ListUnits& units, Executor* executor);

  /// Box around blocks [first, last) of a cluster.
  BlockSpan span_of(std::int32_t first, std::int32_t last) const;
  /// The same in the units of boxes.
  BlockSpan box_of(std::int32_t first, std::int32_t last) const;
  BlockSpans boxes() const;
  /// Largest tag in blocks [first, last), which have tags.
  std::int16_t largest_tag(std::int32_t first, std::int32_t last) const;

  std::size_t memory_bytes() const;

  std::vector<Cluster> clusters;  ///< by node of level 1
  std::int32_t blocks = 0;
  std::vector<std::int32_t> source;  ///< by block: the block of PointBlocks
  std::vector<std::uint8_t> count;   ///< by block: number of points
  std::vector<std::uint8_t> lanes;   ///< by block: a bit for each of them
  std::vector<Offsets> offsets;      ///< by block
  std::vector<Corners> corners;      ///< by block
  double largest_extent = 0;         ///< of a cluster
  double largest_width = 0;
  double largest_block_width = 0;

  // What name() makes, by block
  std::vector<std::array<std::int32_t, kBlock>> ids;  ///< particles
  std::vector<std::array<float, kBlock>> radii;       ///< [length]; empty if cutoffs do not depend on them
  std::vector<std::uint8_t> owned;                    ///< whether a point is not a ghost

  // What quantize() makes
  ListUnits units;
  struct {
    double point = 1, box = 1;
  } per_unit;                       ///< the inverse [1/length]
  std::vector<BlockPoints> points;  ///< by block, as all below
  std::vector<BlockSpan> spans;
  std::vector<std::array<std::int16_t, kBlock>> tags;  ///< what their cutoffs depend on, 0 in empty lanes:
                                                       ///< radii in units or types; empty if nothing

 private:
  AlignedVector<std::int16_t> box_center_[3], box_half_width_[3];
  AlignedVector<std::int32_t> number_;
  bool laid_out_ = false, named_ = false;  ///< and nothing has changed since
  /// What name() has gone by.
  struct Naming {
    std::uint64_t version = 0;
    PairFilter::By by = PairFilter::By::one_cutoff;
    std::int32_t first_ghost = -1;
    const double* radii = nullptr;
    const std::int32_t* types = nullptr;
    bool operator==(const Naming&) const = default;
  } naming_;

  void lay_out(const Level& centers, const PointBlocks& from);
  template <class Metric>
  void measure_all(const Metric& metric, const Level& centers, const Vec3* positions, PointBlocks& from,
                   double covered2, Executor* executor);
  template <class Meter>
  void measure_cluster(const Meter& meter, Vec3 center, Cluster& cluster);
  void name_block(std::int32_t b, const PointBlocks& from, Span<const std::int32_t> particle_of_id,
                  const PairFilter& filter);
  void quantize_block(std::int32_t block);
};

/// The nearest integer, modulo 2^16, of a number below 2^22 or 2^51 in magnitude.
inline std::int16_t rounded(float v) {
  const float shifted = v + 0x1.8p23f;  // now the integer stands in the low bits
  std::int32_t bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(bits));
}
inline std::int16_t rounded(double v) {
  const double shifted = v + 0x1.8p52;
  std::int64_t bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(bits));
}

}  // namespace dch::detail
