// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/forces/embedded_atoms.hpp>

namespace dch::detail {

/// A cubic a + p (b + p (c + p d)), p from 0 to 1 between two knots.
struct Cubic {
  double a, b, c, d;
};

/// What is looked up of a pair: one line of the cache.
struct alignas(64) EmbeddedLine {
  Cubic density;  ///< that the first atom gets
  Cubic pair;     ///< the energy times the distance
};

/// A position, or a force, with room for one more number.
struct alignas(32) PointAndNumber {
  double x, y, z, number;
};

/// Atoms and listed pairs; see EmbeddedAtoms.
struct EmbeddedTask {
  const std::int32_t* atoms;  ///< that have rows
  std::int64_t rows;
  const std::int32_t* counts;
  const std::int32_t* const* neighbors;
  std::int32_t number_bits;
  const PointAndNumber* points;  ///< with the slopes of embedding energies, for forces
  const std::int32_t* type;      ///< from 1
  std::int32_t types;            ///< 1 if all have the same functions
  const EmbeddedLine* lines;     ///< of knots, of the second type of a pair, of the first
  double last_knot, knots_per_length, cutoff2;
  double* densities;          ///< added to
  std::int32_t* near;         ///< second atoms of pairs within the cutoff, row by row, one behind the other
  std::int32_t* near_counts;  ///< by atom
  PointAndNumber* forces;     ///< added to
  double energy;              ///< of pairs, added to
  /// Gets the pairs of each row; null if they are not wanted.
  void (*visit)(const void* visitor, const EmbeddedPair* pairs, std::int32_t count);
  const void* visitor;
};

}  // namespace dch::detail
