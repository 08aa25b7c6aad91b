// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/base/instruction_set.hpp>

namespace dch::detail {

/// Pairs of nodes, or charges, that kernels take at once.
inline constexpr int kSumLanes = 8;

/// Coefficients are kept in rows of this length, so that whole lanes can be loaded.
constexpr std::int32_t padded(std::int32_t coefficients) {
  return (coefficients + kSumLanes - 1) / kSumLanes * kSumLanes;
}

/// One step towards the derivatives of the kernel: to[to] = x_axis * from[minus_one] + factor * [minus_two].
struct DerivativeStep {
  std::int32_t to, minus_one, minus_two, axis;
  double factor;
};

/// How expansions of one order are turned into each other; see Expansions.
struct TranslationTables {
  std::int32_t order, coefficients;  ///< of both kinds of expansions
  std::int32_t steps, traces;        ///< towards derivatives
  const DerivativeStep* step;        ///< in this order
  const std::int32_t* trace;         ///< traces times three: to = -(second + third)
  const std::int32_t* degree_end;    ///< by degree: coefficients up to it
  const std::uint16_t* derivative;   ///< for each local coefficient and each multipole one that it takes
};

/// Up to kSumLanes sources of one target. Lanes without a source have inverse distance 0.
struct FarGroup {
  alignas(64) double direction[3][kSumLanes];  ///< from source to target, of length 1
  alignas(64) double inverse[kSumLanes];       ///< of the distance of the centers
  alignas(64) double decay[kSumLanes];         ///< exp(-kappa distance)
  alignas(64) double screening[kSumLanes];     ///< kappa distance
  alignas(64) double source_size[kSumLanes];   ///< radius over distance
  alignas(64) double target_size[kSumLanes];
  const double* moments[kSumLanes];  ///< rows of padded length
};

/// Charges about a target, padded to kSumLanes with charges of 0.
struct NearCharges {
  const double *x, *y, *z, *q;
  std::int32_t count;
  double least2;  ///< no nearer ones [length^2]
  double kappa;
};

struct SumKernels {
  /// Adds the local expansion of a group, lane by lane, to `sums`. work: Expansions::work_size() entries.
  void (*translate)(const TranslationTables& tables, const FarGroup& group, double* work, double* sums);
  double (*potential)(const NearCharges& charges, double x, double y, double z);
};

/// The kernels of a set that is supported.
const SumKernels& sum_kernels(InstructionSet set);

extern const SumKernels kSumPortable;
#ifdef DCH_X86_KERNELS
extern const SumKernels kSumAvx2, kSumAvx512;
#endif

}  // namespace dch::detail
