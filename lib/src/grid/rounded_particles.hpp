// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>

#include "grid/cell_bins.hpp"
#include "leaves/labelled_leaves.hpp"

namespace dch::detail {

/// What kernels are told of a particle: rounded coordinates, and the radius or the type.
struct RoundedParticle {
  RoundedPoint at;
  std::int16_t tag;  ///< 0 where cutoffs go by neither
};

/// All particles in the integers that several layers of cells share. They are rounded as they lie in memory,
/// many at once, and layers take them from here, which is a third of the memory that their positions fill.
class RoundedParticles {
 public:
  /// @param layout any of the box's
  void round(Span<const Vec3> positions, const Box& box, const CellLayout& layout,
             const CellRounding& rounding, const ParticleLabels& labels, Executor* executor);

  const CellRounding& rounding() const { return rounding_; }
  bool have_tags() const { return have_tags_; }
  const RoundedParticle& operator[](std::int32_t particle) const { return particles_[particle]; }
  std::size_t memory_bytes() const { return particles_.capacity() * sizeof particles_[0]; }

 private:
  CellRounding rounding_;
  bool have_tags_ = false;
  std::vector<RoundedParticle> particles_;
};

/// What kernels know of the cutoffs of a particle.
inline std::int16_t tag_of(const ParticleLabels& labels, std::size_t particle, double per_unit) {
  if (labels.by == CutoffBy::radii) return rounded(labels.radii[particle] * per_unit);
  if (labels.by == CutoffBy::types) return static_cast<std::int16_t>(labels.types[particle] % kKernelTypes);
  return 0;
}

}  // namespace dch::detail
