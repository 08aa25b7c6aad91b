// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>

namespace LAMMPS_NS {

/// Positions, velocities or forces of `count` atoms from `first` on, at least one; LAMMPS has them in one
/// piece.
inline dch::Span<dch::Vec3> vectors(double** of_atoms, int first, int count) {
  return {reinterpret_cast<dch::Vec3*>(of_atoms[first]), static_cast<std::size_t>(count)};
}

}  // namespace LAMMPS_NS
