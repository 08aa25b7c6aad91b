// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/base/span.hpp>

#include "hierarchy/leaf_blocks.hpp"
#include "hierarchy/measured_leaves.hpp"
#include "leaves/cutoff_by.hpp"

namespace dch::detail {

/// Which particles the ids of a hierarchy are.
struct ParticleIds {
  Span<const std::int32_t> particle_of_id;  ///< empty where ids are those of the particles
  std::uint64_t version = 0;  ///< another one when these or the sizes of particles may have changed; 0 where
                              ///< that is not known of sizes
};

/// What a list says of its particles.
struct ParticleLabels {
  CutoffBy by = CutoffBy::one_cutoff;
  Span<const double> radii;  ///< by particle, where cutoffs go by them [length]
  Span<const std::int32_t> types;
  std::int32_t first_ghost = -1;  ///< negative: there are none
};

/// What lists have to know of the points in blocks beside where they are, block by block as MeasuredLeaves
/// has them.
struct LabelledLeaves {
  /// Does nothing if nothing has changed since the last time.
  void label(const MeasuredLeaves& measured, const LeafBlocks& points, const ParticleIds& ids,
             const ParticleLabels& labels, Executor* executor);

  std::size_t memory_bytes() const;

  /// Empty where ids of particles are those of points in blocks that are in order: LeafSource::particles().
  std::vector<std::array<std::int32_t, kBlock>> particle;
  std::vector<std::array<float, kBlock>> radii;  ///< [length]; empty if cutoffs do not go by them
  std::vector<std::array<std::int16_t, kBlock>>
      types;                             ///< 0 in empty lanes; empty if cutoffs do not go by them
  std::vector<std::uint8_t> owned;       ///< whether a point is not a ghost
  std::vector<std::uint8_t> leaf_owned;  ///< by leaf: the same

 private:
  void label_block(std::int32_t b, const MeasuredLeaves& measured, const LeafBlocks& from,
                   Span<const std::int32_t> particle_of_id, const ParticleLabels& labels);

  /// What the labels go by; layout 0 if there are none.
  struct Source {
    std::uint64_t layout = 0, version = 0;
    CutoffBy by = CutoffBy::one_cutoff;
    std::int32_t first_ghost = -1;
    const double* size = nullptr;
    const std::int32_t* type = nullptr;
    bool operator==(const Source&) const = default;
  } source_;
};

}  // namespace dch::detail
