// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <dch/forces/dissipative_pairs.hpp>

namespace dch::detail {

/// A step, and coefficients by kind and pair of types.
struct DissipativeTask {
  std::uint32_t seed;
  std::uint64_t step;
  double noise;  ///< root of k T / dt
  std::int32_t pairs_of_types;
  const double* table[5];
};

struct DissipativeKernels {
  void (*compute)(const DissipativeTask& task, DissipativeBatch& batch);
};

}  // namespace dch::detail
