// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/base/instruction_set.hpp>
#include <dch/forces/fene.hpp>

#include "simd/all_pairs_task.hpp"
#include "simd/angle_task.hpp"
#include "simd/born_task.hpp"
#include "simd/dissipative_task.hpp"
#include "simd/lj_task.hpp"
#include "simd/mesh_task.hpp"
#include "simd/motion_task.hpp"
#include "simd/noise_task.hpp"
#include "simd/waves_task.hpp"

namespace dch::detail {

/// Bonds, and coefficients by type.
struct BondTask {
  const BondOfType* bonds;
  std::int64_t count;
  std::int32_t first_type, types;
  const double* table[4];
  const Vec3* positions;
  Vec3* forces;    ///< added to
  double* virial;  ///< six sums of d f, added to; null if not wanted
};

/// Each adds forces of all bonds but those that are too long, whose numbers it writes, ascending; there has
/// to be room for all. It returns how many.
struct BondKernels {
  std::int32_t (*fene)(const BondTask& task, std::int32_t* too_long);
  std::int32_t (*harmonic)(const BondTask& task, std::int32_t* too_long);
};

/// The loops of forces, compiled for one instruction set. No function allocates.
struct ForceKernels {
  LjFunctions<LjTask<float>> mixed;
  LjFunctions<LjTask<double>> full;
  LjFunctions<LjPairTask> pairs;
  MeshKernels mesh;
  BornKernels born;
  MotionKernels motion;
  AllPairsKernels all_pairs;
  NoiseKernels noise;
  BondKernels bonds;
  AngleKernels angles;
  WaveKernels waves;
  DissipativeKernels dissipative;
};

/// The kernels of a set that is supported.
const ForceKernels& force_kernels(InstructionSet set);

}  // namespace dch::detail
