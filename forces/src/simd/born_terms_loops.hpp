// SPDX-License-Identifier: MIT
//
// What a pair adds to generalized Born sums, over vector types; see cluster_loops.hpp.
//
// With a the radius of a particle, s the scaled radius of another one at distance r, U = r + s and
// L = max(a, |r - s|), the integral of Hawkins, Cramer and Truhlar (J. Phys. Chem. 100:19824, 1996) is
//     H = 1/2 (1/L - 1/U + 1/4 (r - s^2/r) (1/U^2 - 1/L^2) + 1/2 log(L/U) / r)   where a < U, else 0.
// Its terms cancel, all the more the smaller r or s/r is. So 1/L - 1/U is computed from U - L, and the
// logarithm as -2 artanh((U - L) / (U + L)). Far away, where L = r - s, it is a series of s/r.
#pragma once

#include "simd/born_task.hpp"
#include "simd/lj_terms_loops.hpp"

namespace dch::detail {
namespace {

/// Coefficients for y = s^2/r^2 up to kBornFarRatio2, by Chebyshev's points: of sum k/(2k+1) y^(k-1), within
/// 9e-8, and of sum k (2k+2)/(2k+1) y^(k-1), within 3e-8. Highest power first.
inline constexpr float kFarIntegral[] = {0.887233264f, 0.347113218f, 0.456125209f,
                                         0.428014239f, 0.400009533f, 0.333333307f};
inline constexpr float kFarSlope[] = {17.5690884f, 3.26414936f, 5.91667302f, 4.41134255f,
                                      3.42967669f, 2.39998639f, 1.33333336f};

template <class S, int kTerms>
typename S::V born_series(const float (&term)[kTerms], typename S::V y) {
  typename S::V sum = S::set1(term[0]);
  for (int k = 1; k < kTerms; ++k) sum = S::madd(sum, y, S::set1(term[k]));
  return sum;
}

/// H of pairs that are far, from 1/r^2; 0 where that is.
template <class S>
typename S::V far_integral(typename S::V over_r2, typename S::V scaled) {
  const typename S::V y = S::mul(S::mul(scaled, scaled), over_r2);
  return S::mul(S::mul(S::mul(scaled, y), over_r2), born_series<S>(kFarIntegral, y));
}

/// -(dH/dr) / r of pairs that are far.
template <class S>
typename S::V far_slope(typename S::V over_r2, typename S::V scaled) {
  const typename S::V y = S::mul(S::mul(scaled, scaled), over_r2);
  return S::mul(S::mul(S::mul(scaled, y), S::mul(over_r2, over_r2)), born_series<S>(kFarSlope, y));
}

/// artanh(z) of -1 < z < 1, halved three times by artanh(z) = 2 artanh(z / (1 + sqrt(1 - z^2))).
template <class S>
typename S::V artanh(typename S::V z) {
  using V = typename S::V;
  const V one = S::set1(1);
  for (int k = 0; k < 3; ++k) {
    const V rest = S::max(S::sub(one, S::mul(z, z)), S::set1(1e-12f));
    const V root = S::mul(rest, S::over_root(rest, S::inverse(rest)));
    z = S::mul(z, S::inverse(S::add(one, root)));
  }
  constexpr float kSeries[] = {1 / 15.f, 1 / 13.f, 1 / 11.f, 1 / 9.f, 1 / 7.f, 1 / 5.f, 1 / 3.f, 1.f};
  return S::mul(S::mul(S::set1(8), z), born_series<S>(kSeries, S::mul(z, z)));
}

template <class S>
typename S::V smaller(typename S::V a, typename S::V b) {
  return S::sub(S::zero(), S::max(S::sub(S::zero(), a), S::sub(S::zero(), b)));
}

/// Distances of pairs in all ways that terms want them.
template <class S>
struct Distance {
  typename S::V r, over_r, over_r2;
  /// Particles at the same place are taken to be a millionth apart, which gives the limit.
  explicit Distance(typename S::V r2) {
    r2 = S::max(r2, S::set1(1e-12f));
    over_r2 = S::inverse(r2);
    over_r = S::over_root(r2, over_r2);
    r = S::mul(r2, over_r);
  }
};

/// H, or -(dH/dr) / r, at any distance.
template <class S>
struct NearTerms {
  using V = typename S::V;
  NearTerms(const Distance<S>& d, V a, V s) : distance(d), radius(a), scaled(s) {
    const V r = d.r, apart = S::max(S::sub(r, s), S::sub(s, r)), least = S::max(a, apart);
    const V most = S::add(r, s), two = S::set1(2);
    // The limits are |r - s| and r + s, or a and r + s.
    across = smaller<S>(S::add(S::sub(s, a), r), S::mul(two, smaller<S>(r, s)));
    both = S::add(least, most);
    over_least = S::inverse(least);
    over_most = S::inverse(most);
    log_half = artanh<S>(S::mul(across, S::inverse(both)));
  }
  /// The lanes with a < U have terms; those with a < s - r are inside.
  auto acts(std::uint32_t mask, int p) const { return S::less(radius, S::add(distance.r, scaled), mask, p); }
  auto inside(std::uint32_t mask, int p) const {
    return S::less(radius, S::sub(scaled, distance.r), mask, p);
  }
  V integral(V counts_inside, std::uint32_t mask, int p) const {
    const V lever = S::mul(S::mul(S::sub(distance.r, scaled), both), S::mul(over_least, distance.over_r));
    const V part = S::sub(S::set1(1), S::mul(S::set1(0.25f), lever));
    const V sum = S::sub(S::mul(S::mul(across, S::mul(over_least, over_most)), part),
                         S::mul(log_half, distance.over_r));
    const V more = S::keep(inside(mask, p), S::sub(S::inverse(radius), over_least));
    return S::keep(acts(mask, p), S::madd(counts_inside, more, S::mul(S::set1(0.5f), sum)));
  }
  V slope(V counts_inside, std::uint32_t mask, int p) const {
    const V r2 = S::mul(distance.r, distance.r), squares = S::madd(scaled, scaled, r2);
    const V over = S::mul(over_least, over_most);
    const V first =
        S::mul(S::mul(S::mul(S::set1(0.125f), squares), S::mul(across, both)), S::mul(over, over));
    const V bracket = S::sub(first, S::mul(S::set1(0.5f), log_half));
    const V sum = S::mul(S::mul(bracket, distance.over_r2), distance.over_r);
    const V less = S::mul(S::mul(over_least, over_least), distance.over_r);
    const V inner = S::keep(inside(mask, p), S::mul(S::sub(S::set1(1), counts_inside), less));
    return S::keep(acts(mask, p), S::sub(sum, inner));
  }

  const Distance<S>& distance;
  V radius, scaled, across, both, over_least, over_most, log_half;
};

/// height / (1 + 100 x^2 + 3e5 x^6), x = r - at, of Mongan, Simmerling, McCammon, Case and Onufriev (J. Chem.
/// Theory Comput. 3:156, 2007), and minus its derivative over r.
template <class S>
struct NeckTerms {
  using V = typename S::V;
  NeckTerms(const Distance<S>& d, V at, V height) {
    const V x = S::sub(d.r, at), x2 = S::mul(x, x), x4 = S::mul(x2, x2);
    const V wide = S::madd(S::set1(3e5f), x4, S::set1(100));
    const V over = S::inverse(S::madd(wide, x2, S::set1(1)));
    value = S::mul(height, over);
    const V bend = S::madd(S::set1(18e5f), x4, S::set1(200));
    slope = S::mul(S::mul(S::mul(value, over), S::mul(bend, x)), d.over_r);
  }
  V value, slope;
};

/// Of energies E of pairs: minus dE/dr over r, minus dE/dB times the Born radius, which is the same for both
/// particles, and minus E.
template <class S>
struct BornPairTerms {
  typename S::V force, slope, energy;
};

/// E = -q q (1/solute - exp(-kappa f)/solvent) (1/f - shift), f^2 = r^2 + B B exp(-r^2 / (4 B B)) (Still et
/// al., J. Am. Chem. Soc. 112:6127, 1990). Without salt `charges` holds the two dielectric constants too.
template <class S, bool kEnergy, bool kSalt>
BornPairTerms<S> born_pair_terms(typename S::V r2, typename S::V charges, typename S::V radii,
                                 typename S::V quarter_over_radii, const BornConstants& constants) {
  using V = typename S::V;
  const V depth = S::mul(r2, quarter_over_radii);
  const V gauss = exponential<S>(S::sub(S::zero(), depth));
  const V f2 = S::madd(radii, gauss, r2), over_f2 = S::inverse(f2), over_f = S::over_root(f2, over_f2);
  const V rest = S::sub(over_f, S::set1(constants.shift));
  BornPairTerms<S> terms{S::zero(), S::zero(), S::zero()};
  V strength;  // -(dE/df) / f
  if constexpr (kSalt) {
    const V f = S::mul(f2, over_f), kappa = S::set1(constants.kappa);
    const V salt =
        S::mul(exponential<S>(S::mul(S::sub(S::zero(), kappa), f)), S::set1(constants.over_solvent));
    const V screened = S::sub(S::set1(constants.over_solute), salt);
    const V inner = S::msub(S::mul(kappa, salt), rest, S::mul(screened, over_f2));
    strength = S::mul(S::mul(charges, inner), over_f);
    if constexpr (kEnergy) terms.energy = S::mul(charges, S::mul(screened, rest));
  } else {
    strength = S::sub(S::zero(), S::mul(S::mul(charges, over_f), over_f2));
    if constexpr (kEnergy) terms.energy = S::mul(charges, rest);
  }
  terms.force = S::mul(strength, S::madd(S::set1(-0.25f), gauss, S::set1(1)));
  terms.slope =
      S::mul(S::mul(S::mul(S::set1(0.5f), strength), S::mul(radii, gauss)), S::add(depth, S::set1(1)));
  return terms;
}

}  // namespace
}  // namespace dch::detail
