// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <dch/base/vec3.hpp>

#include "frames/frame_decoder.hpp"

namespace dch::trajectory {

/// Indices of step sizes that a stream may have. The last one stands for no small steps at all: writers say
/// so where all atoms are further apart than any small step.
constexpr std::int32_t kFirstSmall = 9, kLastSmall = 73;

/// The bit stream of an XTC frame, and the numbers in front of it that say how to read it.
///
/// An atom is stored in full, relative to `low`: its three coordinates packed into one number if each size is
/// below 2^24, else one after the other. A bit behind it tells whether another five follow; they hold the
/// number of atoms, counted in coordinates, that are stored as small steps from the atom in front of each,
/// and whether the next small steps will be smaller, as large, or larger. Without them the count stays what
/// it was. The first of a run of small steps stands in front of the atom stored in full: in water the oxygen
/// comes first but is the middle one.
struct XtcStream {
  std::array<std::int32_t, 3> low{};    ///< the smallest coordinates [1/precision]
  std::array<std::uint32_t, 3> size{};  ///< how many there are from them to the largest; below 2^31
  float precision = 0;                  ///< [1/length]
  std::int32_t small = 0;               ///< index of the first step size

  /// Fills the positions, as many as there are; returns nullptr, or what is wrong with the stream.
  const char* decode(Bytes data, std::span<Vec3> positions) const;
};

}  // namespace dch::trajectory
