// SPDX-License-Identifier: MIT
//
// Charges onto a mesh, the mesh through Fourier space, and forces from it.
#pragma once

#include <algorithm>
#include <cstring>

#include "simd/fft_loops.hpp"

namespace dch::detail {
namespace {

/// Cardinal B-splines by their recurrence (Essmann et al.), of order `order` from the one before.
inline void raise_spline(int order, float behind, float* weight) {
  const float share = 1.0f / static_cast<float>(order - 1);
  weight[order - 1] = share * behind * weight[order - 2];
  for (int k = order - 2; k > 0; --k) {
    const auto ahead = static_cast<float>(order - 1 - k);
    weight[k] = share * ((behind + ahead) * weight[k - 1] + (static_cast<float>(k + 1) - behind) * weight[k]);
  }
  weight[0] *= share * (1 - behind);
}

inline void mesh_spline(float behind, float* weight, float* slope) {
  std::fill(weight, weight + kSplineRow, 0.0f);
  std::fill(slope, slope + kSplineRow, 0.0f);
  weight[0] = 1 - behind;
  weight[1] = behind;
  for (int order = 3; order < kSplineOrder; ++order) raise_spline(order, behind, weight);
  slope[0] = -weight[0];
  for (int k = 1; k < kSplineOrder; ++k) slope[k] = weight[k - 1] - weight[k];
  raise_spline(kSplineOrder, behind, weight);
}

/// Where the rows that a charge acts on begin, counted from those of x = 0.
struct RowsOfPoint {
  std::size_t at[kSplineOrder];
  RowsOfPoint(const MeshShape& shape, const MeshPoint& point) {
    int y = point.first[1];
    for (std::size_t& row : at) {
      row = shape.row(0, y) + static_cast<std::size_t>(point.first[2]);
      y = y + 1 == shape.y ? 0 : y + 1;
    }
  }
};

inline void mesh_spread(const SpreadTask& task) {
  for (std::size_t i = 0; i < task.count; ++i) {
    const MeshPoint& point = task.points[i];
    if (point.charge == 0) continue;
    const RowsOfPoint rows(task.shape, point);
    float of_rows[kSplineOrder][kSplineRow];
    for (int b = 0; b < kSplineOrder; ++b) {
      const float weight = point.charge * point.weight[1][b];
      for (int k = 0; k < kSplineRow; ++k) of_rows[b][k] = weight * point.weight[2][k];
    }
    int x = point.first[0];
    for (int a = 0; a < kSplineOrder; ++a, x = x + 1 == task.shape.x ? 0 : x + 1) {
      if (x < task.first_x || x >= task.last_x) continue;
      float* const plane = task.mesh + task.shape.row(x, 0);
      const float weight = point.weight[0][a];
      for (int b = 0; b < kSplineOrder; ++b) {
        float* const row = plane + rows.at[b];
        for (int k = 0; k < kSplineRow; ++k) row[k] += weight * of_rows[b][k];
      }
    }
  }
  for (int x = task.first_x; x < task.last_x; ++x)
    for (int y = 0; y < task.shape.y; ++y) {
      float* const row = task.mesh + task.shape.row(x, y);
      for (int k = 0; k < kSplineRow; ++k) row[k % task.shape.z] += row[task.shape.z + k];
    }
}

inline void mesh_gather(const GatherTask& task) {
  for (std::size_t i = 0; i < task.count; ++i) {
    const MeshPoint& point = task.points[i];
    float* const slope = task.slopes[i];
    slope[0] = slope[1] = slope[2] = 0;
    if (point.charge == 0) continue;
    const RowsOfPoint rows(task.shape, point);
    float along_x[kSplineRow]{}, along_y[kSplineRow]{}, along_z[kSplineRow]{};
    int x = point.first[0];
    for (int a = 0; a < kSplineOrder; ++a, x = x + 1 == task.shape.x ? 0 : x + 1) {
      const float* const plane = task.mesh + task.shape.row(x, 0);
      float level[kSplineRow]{}, rise[kSplineRow]{};
      for (int b = 0; b < kSplineOrder; ++b) {
        const float* const row = plane + rows.at[b];
        for (int k = 0; k < kSplineRow; ++k) {
          level[k] += point.weight[1][b] * row[k];
          rise[k] += point.slope[1][b] * row[k];
        }
      }
      for (int k = 0; k < kSplineRow; ++k) {
        along_x[k] += point.slope[0][a] * level[k];
        along_y[k] += point.weight[0][a] * rise[k];
        along_z[k] += point.weight[0][a] * level[k];
      }
    }
    for (int k = 0; k < kSplineOrder; ++k) {
      slope[0] += along_x[k] * point.weight[2][k];
      slope[1] += along_y[k] * point.weight[2][k];
      slope[2] += along_z[k] * point.slope[2][k];
    }
  }
}

/// The rows of a RowsTask: the second is null behind the last one.
struct TwoRows {
  int y, other;
  bool both;
  explicit TwoRows(const RowsTask& task)
      : y(task.y), other(task.y + (task.shape.y + 1) / 2), both(other < task.shape.y) {}
};

/// One row as real parts and one as imaginary parts, whose spectra are told apart by their symmetry.
inline void mesh_forward(const RowsTask& task) {
  const TwoRows rows(task);
  const auto nz = static_cast<std::size_t>(task.shape.z);
  ComplexArray c = task.scratch, other = task.more_scratch;
  for (int x = 0; x < task.shape.x; ++x) {
    const std::size_t to = static_cast<std::size_t>(x) * nz;
    std::copy_n(task.mesh + task.shape.row(x, rows.y), nz, c.re + to);
    if (rows.both)
      std::copy_n(task.mesh + task.shape.row(x, rows.other), nz, c.im + to);
    else
      std::fill_n(c.im + to, nz, 0.0f);
  }
  fft(*task.along_x, nz, -1, c, other);
  for (int k = 0; k <= task.shape.x / 2; ++k) {
    const std::size_t at = static_cast<std::size_t>(k) * nz;
    const std::size_t mirror = static_cast<std::size_t>(k == 0 ? 0 : task.shape.x - k) * nz;
    const std::size_t plane = static_cast<std::size_t>(k) * task.shape.plane();
    const std::size_t a = plane + static_cast<std::size_t>(rows.y) * nz;
    const std::size_t b = plane + static_cast<std::size_t>(rows.other) * nz;
    for (std::size_t z = 0; z < nz; ++z) {
      task.spectrum.re[a + z] = 0.5f * (c.re[at + z] + c.re[mirror + z]);
      task.spectrum.im[a + z] = 0.5f * (c.im[at + z] - c.im[mirror + z]);
    }
    for (std::size_t z = 0; rows.both && z < nz; ++z) {
      task.spectrum.re[b + z] = 0.5f * (c.im[at + z] + c.im[mirror + z]);
      task.spectrum.im[b + z] = 0.5f * (c.re[mirror + z] - c.re[at + z]);
    }
  }
}

/// Back: the spectrum of the one row plus i times that of the other.
inline void mesh_backward(const RowsTask& task) {
  const TwoRows rows(task);
  const auto nz = static_cast<std::size_t>(task.shape.z);
  ComplexArray c = task.scratch, other = task.more_scratch;
  for (int k = 0; k < task.shape.x; ++k) {
    const bool is_mirror = k > task.shape.x / 2;
    const float sign = is_mirror ? -1.0f : 1.0f;
    const std::size_t to = static_cast<std::size_t>(k) * nz;
    const std::size_t plane = static_cast<std::size_t>(is_mirror ? task.shape.x - k : k) * task.shape.plane();
    const std::size_t a = plane + static_cast<std::size_t>(rows.y) * nz;
    const std::size_t b = plane + static_cast<std::size_t>(rows.other) * nz;
    for (std::size_t z = 0; z < nz; ++z) {
      c.re[to + z] = task.spectrum.re[a + z];
      c.im[to + z] = sign * task.spectrum.im[a + z];
    }
    for (std::size_t z = 0; rows.both && z < nz; ++z) {
      c.re[to + z] -= sign * task.spectrum.im[b + z];
      c.im[to + z] += task.spectrum.re[b + z];
    }
  }
  fft(*task.along_x, nz, 1, c, other);
  const auto write = [&](const float* from, int x, int y) {
    float* const row = task.mesh + task.shape.row(x, y);
    std::copy_n(from + static_cast<std::size_t>(x) * nz, nz, row);
    for (int k = 0; k < kSplineRow; ++k) row[task.shape.z + k] = row[k % task.shape.z];
  };
  for (int x = 0; x < task.shape.x; ++x) {
    write(c.re, x, rows.y);
    if (rows.both) write(c.im, x, rows.other);
  }
}

inline void transpose(const float* from, float* to, std::size_t rows, std::size_t columns) {
  constexpr std::size_t kBlock = 8;
  for (std::size_t r = 0; r < rows; r += kBlock)
    for (std::size_t c = 0; c < columns; c += kBlock)
      for (std::size_t i = r; i < std::min(r + kBlock, rows); ++i)
        for (std::size_t j = c; j < std::min(c + kBlock, columns); ++j)
          to[j * rows + i] = from[i * columns + j];
}

inline void transpose(ComplexArray& data, ComplexArray& other, int rows, int columns) {
  transpose(data.re, other.re, static_cast<std::size_t>(rows), static_cast<std::size_t>(columns));
  transpose(data.im, other.im, static_cast<std::size_t>(rows), static_cast<std::size_t>(columns));
  std::swap(data, other);
}

inline double mesh_convolve(const PlaneTask& task) {
  const auto ny = static_cast<std::size_t>(task.shape.y), nz = static_cast<std::size_t>(task.shape.z);
  ComplexArray data = task.scratch, other = task.more_scratch;
  std::copy_n(task.plane.re, ny * nz, data.re);
  std::copy_n(task.plane.im, ny * nz, data.im);
  fft(*task.along_y, nz, -1, data, other);
  transpose(data, other, task.shape.y, task.shape.z);
  fft(*task.along_z, ny, -1, data, other);
  double sum = 0;
  for (std::size_t z = 0; z < nz; ++z) {
    float of_row = 0;
    for (std::size_t k = z * ny; k < (z + 1) * ny; ++k) {
      const float influence = task.influence[k], re = data.re[k], im = data.im[k];
      of_row += influence * (re * re + im * im);
      data.re[k] = influence * re;
      data.im[k] = influence * im;
    }
    sum += double{of_row};
  }
  fft(*task.along_z, ny, 1, data, other);
  transpose(data, other, task.shape.z, task.shape.y);
  fft(*task.along_y, nz, 1, data, other);
  std::copy_n(data.re, ny * nz, task.plane.re);
  std::copy_n(data.im, ny * nz, task.plane.im);
  return sum;
}

inline constexpr MeshKernels mesh_kernels{mesh_spline,  mesh_spread,   mesh_gather,
                                          mesh_forward, mesh_backward, mesh_convolve};

}  // namespace
}  // namespace dch::detail
