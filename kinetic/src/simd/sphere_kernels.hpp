// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <dch/base/instruction_set.hpp>
#include <dch/base/vec3.hpp>

namespace dch::kinetic {

class Images;

struct Ball {
  Vec3 center{};
  double radius = 0;
};

/// The flight of a sphere since its last collision.
struct alignas(64) Flight {
  Vec3 position{};
  double time = 0;
  Vec3 velocity{};
  double radius = 0;  ///< as given at the start
};

/// What kernels have to know of a box.
struct NearestImages {
  explicit NearestImages(const Images& of);

  double sure2;  ///< square of a displacement that is surely the nearest image [length^2]
  Vec3 periods;  ///< of an orthorhombic box, infinite along open axes; 0 in other boxes
  const Images* images;
};

/// What is the same for all pairs at a time.
struct ContactLaw {
  double now, scale, growth;  ///< radii are scaled by scale + growth * time
};

/// A vector holds at most so many numbers; what kernels write has room for as many more.
inline constexpr std::size_t kMostLanes = 8;

/// The inner loops of hard spheres, for one instruction set. All give the same to the last bit.
struct SphereKernels {
  /// Writes the times at which a sphere touches those of a row, kNever where it does not, and returns the
  /// least.
  double (*contact_times)(const Flight* flights, std::int32_t id, const std::int32_t* row, std::size_t count,
                          const NearestImages& box, const ContactLaw& law, double* times);
  /// Writes those of a row whose balls touch that of a sphere, in their order, and returns how many they are.
  std::size_t (*find_touching)(const Ball* balls, std::int32_t id, const std::int32_t* row, std::size_t count,
                               const NearestImages& box, std::int32_t* found);
};

const SphereKernels& sphere_kernels(InstructionSet set);

const SphereKernels& sphere_kernels_portable();
#ifdef DCH_X86_KERNELS
const SphereKernels& sphere_kernels_avx2();
const SphereKernels& sphere_kernels_avx512();
#endif

/// For the few pairs that may be nearest across a face of the box: what brings a displacement to its nearest
/// image, as a lattice vector, and the square of that image.
void shift_to_nearest(const Images& images, const double* displacement, double* shift);
double nearest2(const Images& images, const double* displacement);

}  // namespace dch::kinetic
