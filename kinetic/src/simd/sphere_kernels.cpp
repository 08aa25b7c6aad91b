// SPDX-License-Identifier: MIT
#include "simd/sphere_kernels.hpp"

#include <cmath>
#include <limits>

#include "images.hpp"

namespace dch::kinetic {
namespace {

/// Distances that rounding may have put a little beyond half a period are looked at.
constexpr double kSurely = 1 - 1e-9;

Vec3 periods_of(const Box& box) {
  if (box.kind() != Box::Kind::orthorhombic) return {};
  Vec3 periods;
  for (int axis = 0; axis < 3; ++axis)
    periods[axis] = box.periodic(axis) ? box.vector(axis)[axis] : std::numeric_limits<double>::infinity();
  return periods;
}

}  // namespace

NearestImages::NearestImages(const Images& of)
    : sure2(0.25 * kSurely * std::pow(of.box().shortest_period(), 2)),
      periods(periods_of(of.box())),
      images(&of) {}

const SphereKernels& sphere_kernels(InstructionSet set) {
#ifdef DCH_X86_KERNELS
  if (set == InstructionSet::avx512) return sphere_kernels_avx512();
  if (set == InstructionSet::avx2) return sphere_kernels_avx2();
#endif
  static_cast<void>(set);  // the baselines of compilers are next to SSE4.2 and NEON here
  return sphere_kernels_portable();
}

void shift_to_nearest(const Images& images, const double* displacement, double* shift) {
  const Vec3 present{displacement[0], displacement[1], displacement[2]};
  const Vec3 nearest = images.box().nearest_image(present);
  const Vec3 change = nearest != present ? images.to_image(present, nearest) : Vec3{};
  shift[0] = change.x;
  shift[1] = change.y;
  shift[2] = change.z;
}

double nearest2(const Images& images, const double* displacement) {
  return norm2(images.box().nearest_image({displacement[0], displacement[1], displacement[2]}));
}

}  // namespace dch::kinetic
