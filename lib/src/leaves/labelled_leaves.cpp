// SPDX-License-Identifier: MIT
#include "leaves/labelled_leaves.hpp"

#include <algorithm>

#include "base/resize.hpp"

namespace dch::detail {

void LabelledLeaves::label(const MeasuredLeaves& measured, const LeafBlocks& points, const ParticleIds& ids,
                           const ParticleLabels& labels, Executor* executor) {
  const Source source{measured.layout,    ids.version,         labels.by,
                      labels.first_ghost, labels.radii.data(), labels.types.data()};
  const bool sizes_are_known = ids.version != 0 || labels.by == CutoffBy::one_cutoff;
  if (sizes_are_known && source == source_) return;
  source_.layout = 0;
  const auto all = static_cast<std::size_t>(measured.blocks);
  resize_closely(particle, ids.particle_of_id.empty() && measured.are_in_order ? 0 : all);
  resize_closely(owned, all);
  resize_closely(radii, labels.by == CutoffBy::radii ? all : 0);
  resize_closely(types, labels.by == CutoffBy::types ? all : 0);
  resize_closely(leaf_owned, measured.leaves.size());
  for_ranges(executor, static_cast<std::int32_t>(measured.leaves.size()),
             [&](std::int32_t first, std::int32_t last) {
               for (std::int32_t k = first; k < last; ++k) {
                 const MeasuredLeaves::Leaf& leaf = measured.leaves[k];
                 leaf_owned[k] = labels.first_ghost < 0;
                 for (std::int32_t b = leaf.first_block; b < leaf.first_block + leaf.blocks; ++b) {
                   label_block(b, measured, points, ids.particle_of_id, labels);
                   leaf_owned[k] |= owned[b];
                 }
               }
             });
  source_ = source;
}

void LabelledLeaves::label_block(std::int32_t b, const MeasuredLeaves& measured, const LeafBlocks& from,
                                 Span<const std::int32_t> particle_of_id, const ParticleLabels& labels) {
  const int count = measured.count[b];
  const std::int32_t* here = from.id.data() + static_cast<std::size_t>(measured.source[b]) * kBlock;
  if (!particle.empty()) {
    std::copy_n(here, kBlock, particle[b].data());
    for (int lane = 0; lane < count && !particle_of_id.empty(); ++lane)
      particle[b][lane] = particle_of_id[here[lane]];
    here = particle[b].data();
  }
  owned[b] = labels.first_ghost < 0;
  for (int lane = 0; lane < count && !owned[b]; ++lane) owned[b] = here[lane] < labels.first_ghost;
  if (!radii.empty()) {
    radii[b].fill(0);
    for (int lane = 0; lane < count; ++lane) radii[b][lane] = static_cast<float>(labels.radii[here[lane]]);
  } else if (!types.empty()) {
    types[b].fill(0);
    for (int lane = 0; lane < count; ++lane)
      types[b][lane] = static_cast<std::int16_t>(labels.types[here[lane]] % kKernelTypes);
  }
}

std::size_t LabelledLeaves::memory_bytes() const {
  const auto bytes_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  return bytes_of(particle) + bytes_of(radii) + bytes_of(types) + bytes_of(owned) + bytes_of(leaf_owned);
}

}  // namespace dch::detail
