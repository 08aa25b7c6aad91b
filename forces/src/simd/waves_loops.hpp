// SPDX-License-Identifier: MIT
//
// A sum over waves and charges, over vector types; see cluster_loops.hpp. A lane is a charge.
//
// In a rectangular cell the eight waves that differ in signs alone have one weight. So products of cosines
// and sines along the axes, one real sum each, stand for their complex sums: a product and a sum for each
// wave and charge, and two for its force.
#pragma once

#include "clusters/simd/cluster_loops.hpp"
#include "simd/waves_task.hpp"

namespace dch::detail {
namespace {

template <class S>
struct WaveLoops {
  using V = typename S::V;
  static constexpr auto kStep = static_cast<std::size_t>(S::kLanes);

  /// The phases along an axis of the charges from k on, for wave number n.
  struct Phase {
    V cosine, sine;
    Phase(const WaveTask& task, int axis, std::size_t n, std::size_t k)
        : cosine(S::load(task.cosine[axis] + n * kWaveBlock + k)),
          sine(S::load(task.sine[axis] + n * kWaveBlock + k)) {}
  };

  /// Charge times the four products along x and y, of all charges of the block.
  struct Plane {
    alignas(64) double product[4][kWaveBlock];
    Plane(const WaveTask& task, std::size_t nx, std::size_t ny) {
      for (std::size_t k = 0; k < kWaveBlock; k += kStep) {
        const Phase x(task, 0, nx, k), y(task, 1, ny, k);
        const V charge = S::load(task.charge + k);
        const V c = S::mul(charge, x.cosine), s = S::mul(charge, x.sine);
        S::store(product[0] + k, S::mul(c, y.cosine));
        S::store(product[1] + k, S::mul(c, y.sine));
        S::store(product[2] + k, S::mul(s, y.cosine));
        S::store(product[3] + k, S::mul(s, y.sine));
      }
    }
  };

  static void add_wave(const WaveTask& task, const Plane& plane, std::size_t nz, double* sums) {
    V sum[8];
    for (std::size_t p = 0; p < 8; ++p) sum[p] = S::load(sums + p * kWaveLanes);
    for (std::size_t k = 0; k < kWaveBlock; k += kStep) {
      const Phase z(task, 2, nz, k);
      for (std::size_t p = 0; p < 4; ++p) {
        const V of_plane = S::load(plane.product[p] + k);
        sum[2 * p] = S::madd(of_plane, z.cosine, sum[2 * p]);
        sum[2 * p + 1] = S::madd(of_plane, z.sine, sum[2 * p + 1]);
      }
    }
    for (std::size_t p = 0; p < 8; ++p) S::store(sums + p * kWaveLanes, sum[p]);
  }

  DCH_FLATTEN static void gather(const WaveTask& task, double* sums) {
    for (std::size_t nx = 0; nx < task.count[0]; ++nx)
      for (std::size_t ny = 0; ny < task.count[1]; ++ny) {
        const Plane plane(task, nx, ny);
        for (std::size_t nz = 0; nz < task.count[2]; ++nz, sums += 8 * kWaveLanes)
          add_wave(task, plane, nz, sums);
      }
  }

  /// Sums over the waves of a row along z: of the four products along x and y, and of their slopes along z.
  struct Row {
    V sum[4], slope[4];
    Row(const WaveTask& task, const double* factors, std::size_t k) {
      for (std::size_t p = 0; p < 4; ++p) sum[p] = slope[p] = S::zero();
      for (std::size_t nz = 0; nz < task.count[2]; ++nz, factors += 16) {
        const Phase z(task, 2, nz, k);
        for (std::size_t p = 0; p < 4; ++p) {
          sum[p] = S::madd(S::set1(factors[2 * p]), z.cosine, sum[p]);
          sum[p] = S::madd(S::set1(factors[2 * p + 1]), z.sine, sum[p]);
          slope[p] = S::madd(S::set1(factors[8 + 2 * p]), z.sine, slope[p]);
          slope[p] = S::madd(S::set1(factors[8 + 2 * p + 1]), z.cosine, slope[p]);
        }
      }
    }
  };

  static V times(const V& a, const V& b, const V& c, const V& d) { return S::madd(a, b, S::mul(c, d)); }
  static void add(double* to, const V& what) { S::store(to, S::add(S::load(to), what)); }

  DCH_FLATTEN static void slopes(const WaveTask& task, const double* factors, const double length[2],
                                 double (*slope)[kWaveBlock]) {
    for (std::size_t nx = 0; nx < task.count[0]; ++nx)
      for (std::size_t ny = 0; ny < task.count[1]; ++ny, factors += 16 * task.count[2])
        for (std::size_t k = 0; k < kWaveBlock; k += kStep) {
          const Row row(task, factors, k);
          const Phase x(task, 0, nx, k), y(task, 1, ny, k);
          // What stands beside the cosine along x, and beside the sine; along y alike.
          const V cosine_x = times(row.sum[0], y.cosine, row.sum[1], y.sine);
          const V sine_x = times(row.sum[2], y.cosine, row.sum[3], y.sine);
          const V cosine_y = times(row.sum[0], x.cosine, row.sum[2], x.sine);
          const V sine_y = times(row.sum[1], x.cosine, row.sum[3], x.sine);
          const V wave_x = S::set1(length[0] * static_cast<double>(nx));
          const V wave_y = S::set1(length[1] * static_cast<double>(ny));
          add(slope[0] + k, S::mul(wave_x, S::msub(sine_x, x.cosine, S::mul(cosine_x, x.sine))));
          add(slope[1] + k, S::mul(wave_y, S::msub(sine_y, y.cosine, S::mul(cosine_y, y.sine))));
          const V of_cosine = times(row.slope[0], y.cosine, row.slope[1], y.sine);
          const V of_sine = times(row.slope[2], y.cosine, row.slope[3], y.sine);
          add(slope[2] + k, times(of_cosine, x.cosine, of_sine, x.sine));
        }
  }
};

template <class S>
constexpr WaveKernels wave_kernels{WaveLoops<S>::gather, WaveLoops<S>::slopes};

}  // namespace
}  // namespace dch::detail
