// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <dch/forces/lennard_jones.hpp>

#include "simd/lj_task.hpp"

namespace dch::detail {

template <class Real>
LjCoefficients<Real> pointers_to(const std::array<std::vector<Real>, 7>& tables) {
  return {tables[0].data(), tables[1].data(), tables[2].data(), tables[3].data(),
          tables[4].data(), tables[5].data(), tables[6].data()};
}

/// Whether single precision holds a number, 0 or not too small.
inline bool fits_in_single(double v) {
  using Limits = std::numeric_limits<float>;
  return v == 0 || (std::abs(v) >= double{Limits::min()} && std::abs(v) <= double{Limits::max()});
}

/// What a kernel has to find.
/// @param sums  null if nobody asks for them
inline Wanted wanted(const LennardJonesSums* sums) { return sums ? Wanted::sums : Wanted::forces; }
inline Wanted wanted(const LennardJonesSums* sums, Span<const LennardJonesSums> halves) {
  return halves.empty() ? wanted(sums) : Wanted::tallies;
}

/// Tallies by particle as the kernels of pairs one by one have them; null without.
inline double* numbers_of(Span<LennardJonesSums> halves) {
  static_assert(sizeof(LennardJonesSums) == kTallied * sizeof(double) &&
                offsetof(LennardJonesSums, virial) == kTallyOfVirial * sizeof(double));
  return halves.empty() ? nullptr : &halves.data()->energy;
}

inline void give(const LjSums& found, LennardJonesSums& sums) {
  sums.energy += found.energy;
  sums.coulomb_energy += found.coulomb_energy;
  for (std::size_t k = 0; k < 6; ++k) sums.virial[k] += found.virial[k];
}

}  // namespace dch::detail
