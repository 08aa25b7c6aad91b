// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include <dch/base/instruction_set.hpp>
#include <dch/forces/pair_potential.hpp>

#include "simd/form_kernels.hpp"

namespace dch::detail {

/// The kernels of a form and its charges for the instruction set in use.
inline const FormKernels::OfStyle& style_of(const PairPotentialParams& params) {
  return form_kernels(instruction_set())
      .of_style[static_cast<std::size_t>(params.form)][static_cast<std::size_t>(params.charges)];
}

}  // namespace dch::detail
