// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "hierarchy/measured_leaves.hpp"
#include "hierarchy/structure.hpp"
#include "leaves/labelled_leaves.hpp"
#include "leaves/own_blocks.hpp"
#include "leaves/quantized_leaves.hpp"

namespace dch::detail {

/// What lists take from a hierarchy: its leaves, measured by the hierarchy, then labelled, then quantized.
struct LeafSource {
  const Structure* structure = nullptr;
  ParticleIds ids;
  LabelledLeaves labelled;
  QuantizedLeaves quantized;

  const MeasuredLeaves& measured() const { return structure->leaves; }
  const Level& centers() const { return structure->levels[1]; }
  /// How far a node may be from where it was when parents were in order [length].
  double motion() const { return structure->pending ? structure->motion : 0.0; }

  /// What the cutoffs of points depend on, by block: radii in units or types; null if nothing.
  const std::array<std::int16_t, kBlock>* tags() const {
    if (!quantized.radii.empty()) return quantized.radii.data();
    return labelled.types.empty() ? nullptr : labelled.types.data();
  }
  /// Whose points they are, by block.
  const OfLanes<std::int32_t>* particles() const {
    static_assert(sizeof(OfLanes<std::int32_t>) == kBlock * sizeof(std::int32_t));
    return labelled.particle.empty()
               ? reinterpret_cast<const OfLanes<std::int32_t>*>(structure->points.id.data())
               : labelled.particle.data();
  }
  /// Blocks [first, last) of a leaf.
  OwnBlocks blocks(std::int32_t first, std::int32_t last) const {
    return {quantized.points.data() + first,
            quantized.spans.data() + first,
            particles() + first,
            tags() == nullptr ? nullptr : tags() + first,
            measured().count.data() + first,
            last - first};
  }
  std::size_t memory_bytes() const { return labelled.memory_bytes() + quantized.memory_bytes(); }
};

}  // namespace dch::detail
