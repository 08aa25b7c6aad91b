// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>

#include "tag_table.h"

namespace dch::lammps {

/// How often an atom has crossed the periodic box along x, y, z (LAMMPS's image flags).
using ImageFlags = std::array<int, 3>;

/// The periodic lattice as LAMMPS stores it: x = low + H lamda with H upper triangular.
struct Lattice {
  std::array<double, 6> inverse{};  ///< of H, in LAMMPS's Voigt order xx, yy, zz, yz, xz, xy [1/length]
  std::array<bool, 3> periodic{};
  Vec3 low;  ///< corner of the box [length]

  /// Box coordinates of a displacement.
  Vec3 lamda(Vec3 d) const {
    return {inverse[0] * d.x + inverse[5] * d.y + inverse[4] * d.z, inverse[1] * d.y + inverse[3] * d.z,
            inverse[2] * d.z};
  }
};

/// Names for owned and ghost atoms that outlive the re-sorting of atoms, their migration and the re-creation
/// of ghosts.
///
/// A name is the atom's ID together with the number of box vectors between the point and the atom's unwrapped
/// position. So an atom that leaves the box through a periodic face changes places with one of its ghosts,
/// and no point jumps. Copies of one atom differ by whole box vectors, found by rounding the distance between
/// the copies; hence their names differ whatever the rounding of their coordinates. Where the owner of a
/// ghost is another process its image flags are unknown, and names count from the box instead.
class PointKeys {
 public:
  /// Names the points; the first images.size() of them are owned atoms with these image flags, the rest are
  /// ghosts. IDs are positive. O(n). Returns an empty span if copies of an atom lie more than 127 boxes
  /// apart, or an ID is 2^40 or more: such points have no names.
  Span<const std::uint64_t> assign(Span<const Vec3> points, Span<const std::int64_t> tags,
                                   Span<const ImageFlags> images, const Lattice& lattice);

 private:
  std::vector<std::uint64_t> keys_;
  TagTable by_tag_;
};

}  // namespace dch::lammps
