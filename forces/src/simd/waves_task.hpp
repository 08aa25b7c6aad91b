// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace dch::detail {

/// Charges are taken in blocks of so many.
inline constexpr std::size_t kWaveBlock = 64;
/// Room for the lanes of a vector on any instruction set.
inline constexpr std::size_t kWaveLanes = 8;

/// A block of charges and all waves with numbers 0 .. count - 1 along each axis. Arrays are aligned.
struct WaveTask {
  std::size_t count[3];
  /// Of each number along each axis: of the charges' phases, kWaveBlock each.
  const double *cosine[3], *sine[3];
  const double* charge;  ///< kWaveBlock; 0 for those that there are not
};

/// Products of a cosine or sine along x, along y and along z stand in the order ccc, ccs, csc, css, scc, scs,
/// ssc, sss; waves with z innermost.
struct WaveKernels {
  /// Adds charge times product of all charges to sums: for each wave eight products of kWaveLanes numbers,
  /// which are still to be added up.
  void (*gather)(const WaveTask& task, double* sums);
  /// Adds the slopes of sums over waves and products: of the factor times the product of the charge's
  /// phases, with respect to the position.
  /// @param factors  of each wave: eight factors; and the same times the wave number along z, as the slope of
  ///   the product along z has them: those of cosines negative
  /// @param length  2 pi over the period along x and along y
  void (*slopes)(const WaveTask& task, const double* factors, const double length[2],
                 double (*slope)[kWaveBlock]);
};

}  // namespace dch::detail
