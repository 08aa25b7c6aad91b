// SPDX-License-Identifier: MIT
#pragma once

#include <dch/base/instruction_set.hpp>
#include <dch/forces/pair_potential.hpp>

#include "simd/lj_task.hpp"

namespace dch::detail {

/// A few pairs whose squared distances and products of charges are known; see PairBatch.
struct BatchTask {
  LjCoefficients<double> coefficients;
  LjConstants<double> constants;
  double constant;  ///< of charges
  const double *weight, *charge_weight;
};

inline constexpr int kPairForms = 11, kChargeForms = 5;

/// The loops of PairPotential, compiled for one instruction set; null where a form does not go with charges
/// that act so.
struct FormKernels {
  struct OfStyle {
    LjFunctions<LjTask<float>>::OfKind mixed;
    LjFunctions<LjTask<double>>::OfKind full;
    LjFunctions<LjPairTask>::OfKind pairs;
    LjFunctions<LjPairTask>::Function weighted[kWanted];
    void (*batch)(const BatchTask& task, PairBatch& pairs);
    /// Numbers for the tables of those that the form is given; returns the largest exponent of its terms.
    double (*prepare)(const double* given, double cutoff, double* numbers);
    int given;       ///< how many those are
    bool has_shift;  ///< whether energies may be lowered by what they are at the cutoff
  };
  OfStyle of_style[kPairForms][kChargeForms];
  bool mixed_wants_lanes, full_wants_lanes;  ///< whether the functions use LjTask::lanes
};

/// ln(1 + x). Not inlined into kernels, which leave out a call whose result they do not need.
[[gnu::const]] double logarithm_beside_one(double x);

/// The kernels of a set that is supported.
const FormKernels& form_kernels(InstructionSet set);

}  // namespace dch::detail
