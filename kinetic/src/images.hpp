// SPDX-License-Identifier: MIT
#pragma once

#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>

#include "geometry/lattice.hpp"

namespace dch::kinetic {

/// Images that rounding may have put a little beyond a limit are looked at too.
inline constexpr double kMargin = 1 + 1e-9;

/// Which image of a point is meant, as a lattice vector that does not depend on how the image was found.
class Images {
 public:
  explicit Images(const Box& box) : box_(box), lattice_(box) {}

  const Box& box() const { return box_; }
  /// What makes the nearest image of a displacement when added to it.
  Vec3 to_nearest(Vec3 d) const { return box_.any_periodic() ? to_image(d, box_.nearest_image(d)) : Vec3{}; }
  /// The same for another image, which may be off by rounding.
  Vec3 to_image(Vec3 d, Vec3 image) const { return lattice_.vector(lattice_.integers(image - d)); }

 private:
  Box box_;
  detail::Lattice lattice_;
};

}  // namespace dch::kinetic
