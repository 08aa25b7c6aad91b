// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "fft_plan.hpp"

namespace dch::detail {

inline constexpr int kSplineOrder = 5;
inline constexpr int kSplineRow = 8;  ///< numbers of a spline, the last three of which are 0

/// A charge beside the mesh: the first of the points along each axis that it acts on, and its splines there,
/// which one of 0 does without.
struct alignas(32) MeshPoint {
  float weight[3][kSplineRow], slope[3][kSplineRow];
  std::int32_t first[3];
  float charge;
};

/// A mesh of real numbers, z running fastest. Behind the last points along z there is room for the first ones
/// once more, as far as a spline reaches.
struct MeshShape {
  int x, y, z;
  std::size_t pitch;  ///< numbers from one row along z to the next
  std::size_t row(int at_x, int at_y) const {
    return (static_cast<std::size_t>(at_x) * static_cast<std::size_t>(y) + static_cast<std::size_t>(at_y)) *
           pitch;
  }
  std::size_t plane() const { return static_cast<std::size_t>(y) * static_cast<std::size_t>(z); }
};

/// Complex numbers: real parts, and imaginary parts elsewhere.
struct ComplexArray {
  float *re, *im;
};

/// Charges onto the points with first_x <= x < last_x, which are 0 before.
struct SpreadTask {
  MeshShape shape;
  const MeshPoint* points;
  std::size_t count;
  float* mesh;
  int first_x, last_x;
};

/// The slopes of the mesh at charges, in units of its points; 0 at charges of 0.
struct GatherTask {
  MeshShape shape;
  const MeshPoint* points;
  std::size_t count;
  const float* mesh;
  float (*slopes)[3];
};

/// Fourier transforms of two rows at once, y and y + (Y + 1) / 2, between the mesh and its spectrum, which
/// has the planes 0 .. X / 2 along x, each [y][z].
struct RowsTask {
  MeshShape shape;
  const FftPlan* along_x;
  int y;
  float* mesh;
  ComplexArray spectrum, scratch, more_scratch;  ///< scratch: X Z numbers each
};

/// A plane of the spectrum: transformed along y and z, multiplied by the influence function, and back.
struct PlaneTask {
  MeshShape shape;
  const FftPlan *along_y, *along_z;
  const float* influence;                     ///< [z][y]
  ComplexArray plane, scratch, more_scratch;  ///< Y Z numbers each
};

struct MeshKernels {
  /// The spline of a charge so far behind a point, 0 <= behind < 1, and its slope.
  void (*spline)(float behind, float* weight, float* slope);
  void (*spread)(const SpreadTask& task);
  void (*gather)(const GatherTask& task);
  void (*forward)(const RowsTask& task);
  void (*backward)(const RowsTask& task);
  /// Returns the sum of influence times squared amplitude.
  double (*convolve)(const PlaneTask& task);
};

}  // namespace dch::detail
