// SPDX-License-Identifier: MIT
#include "grid/rounded_particles.hpp"

#include <algorithm>
#include <array>

namespace dch::detail {
namespace {

constexpr std::size_t kAtOnce = 256;  ///< particles that are looked at together, while they are in a cache

}  // namespace

void RoundedParticles::round(Span<const Vec3> positions, const Box& box, const CellLayout& layout,
                             const CellRounding& rounding, const ParticleLabels& labels, Executor* executor) {
  const CellBins bins(box, layout, rounding);
  rounding_ = rounding;
  have_tags_ = labels.by != CutoffBy::one_cutoff;
  particles_.resize(positions.size());
  for_ranges(executor, positions.size(), [&](std::size_t begin, std::size_t end) {
    const ParticleLabels own_labels = labels;
    const double per_unit = 1 / rounding.unit;
    std::array<CellCoordinates, kAtOnce> unused;
    std::array<RoundedPoint, kAtOnce> points;
    for (std::size_t at = begin; at < end; at += kAtOnce) {
      const std::size_t count = std::min(kAtOnce, end - at);
      bins.find({positions.data() + at, count}, unused.data(), points.data());
      for (std::size_t k = 0; k < count; ++k)
        particles_[at + k] = {points[k], tag_of(own_labels, at + k, per_unit)};
    }
  });
}

}  // namespace dch::detail
