// SPDX-License-Identifier: MIT
//
// The loops of forces of bonds over vector types; see cluster_loops.hpp.
#pragma once

#include "clusters/simd/cluster_loops.hpp"
#include "simd/force_kernels.hpp"
#include "simd/pair_forces_loops.hpp"

namespace dch::detail {
namespace {

/// Forces over distance, positive if the bond pushes, and which of the bonds in `mask` are too long.
template <class S>
struct FeneTerms {
  using V = typename S::V;
  static constexpr int kTables = 4;  ///< k, 1/r0^2, sigma^2, 48 epsilon

  template <class Coefficient>
  static V force_over_r(V r2, Coefficient coefficient, std::uint32_t mask, std::uint32_t& too_long) {
    const V left = S::sub(S::set1(1), S::mul(r2, coefficient(1)));
    too_long = S::bits(S::less(left, S::set1(0.1), mask, 0));
    // One division for two: 1/left and 1/r2.
    const V inverse = S::inverse(S::mul(left, r2));
    const V s = S::mul(inverse, left);
    const V sigma2 = coefficient(2), t = S::mul(sigma2, s), t3 = S::mul(S::mul(t, t), t);
    const auto is_near = S::less(r2, S::mul(S::set1(1.2599210498948732), sigma2), 0xFFFF, 0);  // 2^(1/3)
    const V repulsion = S::mul(S::mul(coefficient(3), S::mul(t3, s)), S::sub(t3, S::set1(0.5)));
    return S::sub(S::keep(is_near, repulsion), S::mul(coefficient(0), S::mul(inverse, r2)));
  }
};

/// No bond is too long, and one of length 0 has no force.
template <class S>
struct HarmonicTerms {
  using V = typename S::V;
  static constexpr int kTables = 2;  ///< 2 k, r0

  template <class Coefficient>
  static V force_over_r(V r2, Coefficient coefficient, std::uint32_t, std::uint32_t& too_long) {
    too_long = 0;
    const V s = S::inverse(r2), over_r = S::over_root(r2, s);
    const V force = S::mul(coefficient(0), S::msub(coefficient(1), over_r, S::set1(1)));
    return S::keep(S::less(S::zero(), r2, 0xFFFF, 0), force);
  }
};

/// kLanes bonds, of which only those in `mask` are there. Returns those that are too long.
template <class S, class Terms, bool kOneType, bool kVirial>
std::uint32_t add_bonds(const BondTask& task, const std::int32_t* i, const std::int32_t* j,
                        const std::int32_t* type, std::uint32_t mask, const typename S::V* of_one_type,
                        typename S::V* virial) {
  using V = typename S::V;
  const auto coefficient = [&](int k) { return kOneType ? of_one_type[k] : S::gather(task.table[k], type); };
  const double* const positions = &task.positions->x;
  V xi, yi, zi, xj, yj, zj;
  S::gather_xyz(positions, i, xi, yi, zi);
  S::gather_xyz(positions, j, xj, yj, zj);
  const V dx = S::sub(xj, xi), dy = S::sub(yj, yi), dz = S::sub(zj, zi);
  const V r2 = S::madd(dx, dx, S::madd(dy, dy, S::mul(dz, dz)));
  std::uint32_t too_long;
  const V f = Terms::force_over_r(r2, coefficient, mask, too_long);
  const V fx = S::mul(f, dx), fy = S::mul(f, dy), fz = S::mul(f, dz);
  add_to_both<S>(mask & ~too_long, i, j, fx, fy, fz, task.forces);
  if constexpr (kVirial) {
    const auto is_bond = S::less(S::zero(), S::set1(1), mask & ~too_long, 0);
    const V terms[6] = {S::mul(dx, fx), S::mul(dy, fy), S::mul(dz, fz),
                        S::mul(dx, fy), S::mul(dx, fz), S::mul(dy, fz)};
    for (int k = 0; k < 6; ++k) virial[k] = S::add(virial[k], S::keep(is_bond, terms[k]));
  }
  return too_long;
}

template <class S, class Terms, bool kOneType, bool kVirial>
std::int32_t bonds_of_types(const BondTask& task, std::int32_t* too_long) {
  typename S::V one[Terms::kTables];
  for (int k = 0; k < Terms::kTables; ++k) one[k] = S::set1(*task.table[k]);
  typename S::V virial[6];
  for (auto& sum : virial) sum = S::zero();
  std::int32_t found = 0;
  std::int32_t i[S::kLanes], j[S::kLanes], type[S::kLanes];
  for (std::int64_t first = 0; first < task.count; first += S::kLanes) {
    const int lanes = task.count - first < S::kLanes ? static_cast<int>(task.count - first) : S::kLanes;
    // Lanes without a bond repeat the last one.
    for (int k = 0; k < S::kLanes; ++k) {
      const BondOfType& bond = task.bonds[first + (k < lanes ? k : lanes - 1)];
      i[k] = bond.i;
      j[k] = bond.j;
      type[k] = bond.type - task.first_type;
    }
    const std::uint32_t mask = ((1u << S::kLanes) - 1) >> (S::kLanes - lanes);
    const std::uint32_t left_out =
        add_bonds<S, Terms, kOneType, kVirial>(task, i, j, type, mask, one, virial);
    for (std::uint32_t bits = left_out; bits != 0; bits &= bits - 1)
      too_long[found++] = static_cast<std::int32_t>(first) + __builtin_ctz(bits);
  }
  if constexpr (kVirial)
    for (int k = 0; k < 6; ++k) task.virial[k] += S::sum(virial[k]);
  return found;
}

template <class S, class Terms, bool kOneType>
std::int32_t bonds_of_types(const BondTask& task, std::int32_t* too_long) {
  return task.virial ? bonds_of_types<S, Terms, kOneType, true>(task, too_long)
                     : bonds_of_types<S, Terms, kOneType, false>(task, too_long);
}

template <class S, class Terms>
std::int32_t bonds(const BondTask& task, std::int32_t* too_long) {
  return task.types == 1 ? bonds_of_types<S, Terms, true>(task, too_long)
                         : bonds_of_types<S, Terms, false>(task, too_long);
}

template <class S>
inline constexpr BondKernels bond_kernels{bonds<S, FeneTerms<S>>, bonds<S, HarmonicTerms<S>>};

}  // namespace
}  // namespace dch::detail
