// SPDX-License-Identifier: MIT
//
// The loops of forces of angles over vector types; see cluster_loops.hpp. A lane is an angle.
#pragma once

#include "clusters/simd/cluster_loops.hpp"
#include "simd/angle_task.hpp"

namespace dch::detail {
namespace {

/// 2 atan(t) / t in powers of t^2, from Chebyshev's nodes of t^2 in 0..1. Good to 6e-17.
constexpr double kTwiceArcTangent[] = {2,
                                       -0.66666666666665719,
                                       0.39999999999859892,
                                       -0.28571428563185386,
                                       0.22222221964174252,
                                       -0.18181813211313796,
                                       0.1538455111041126,
                                       -0.13332742375442197,
                                       0.11760684004803086,
                                       -0.10505451114645149,
                                       0.094394479846422241,
                                       -0.084251447927710651,
                                       0.073021627054420696,
                                       -0.059401435472468463,
                                       0.043480427661516267,
                                       -0.027348278576798956,
                                       0.014077292405979627,
                                       -0.005609531106340263,
                                       0.0016067208363252053,
                                       -0.00029234176327250027,
                                       2.5262356860954852e-05};

/// The root of x >= 0.
template <class S>
typename S::V root_of(typename S::V x) {
  return S::over_root(S::inverse(x), x);
}

/// The angle in 0..pi of a sine >= 0 and a cosine. The tangent of half the angle to the nearer end of the
/// axis is at most 1, and no bit of a small angle is lost in it, as it would be in an arc cosine.
template <class S>
typename S::V angle_between(typename S::V sine, typename S::V cosine) {
  using V = typename S::V;
  const V size = S::max(cosine, S::sub(S::zero(), cosine));
  const V t = S::mul(sine, S::inverse(S::add(S::set1(1), size))), t2 = S::mul(t, t);
  constexpr int kTerms = sizeof kTwiceArcTangent / sizeof *kTwiceArcTangent;
  V sum = S::set1(kTwiceArcTangent[kTerms - 1]);
  for (int k = kTerms - 2; k >= 0; --k) sum = S::madd(sum, t2, S::set1(kTwiceArcTangent[k]));
  const V to_axis = S::mul(sum, t);
  const V supplement = S::sub(S::set1(3.14159265358979324), S::add(to_axis, to_axis));
  return S::add(to_axis, S::keep(S::less(cosine, S::zero(), 0xFFFF, 0), supplement));
}

/// -(dE / d theta) / sin(theta).
template <class S>
struct HarmonicAngleTerms {
  using V = typename S::V;
  static constexpr int kTables = 2;  ///< 2 k, theta0

  template <class Coefficient>
  static V over_sine(V sine, V cosine, Coefficient coefficient) {
    const V excess = S::sub(coefficient(1), angle_between<S>(sine, cosine));
    return S::mul(S::mul(coefficient(0), excess), S::inverse(S::max(sine, S::set1(0.001))));
  }
};

template <class S>
struct CosineAngleTerms {
  using V = typename S::V;
  static constexpr int kTables = 1;  ///< k

  template <class Coefficient>
  static V over_sine(V, V, Coefficient coefficient) {
    return coefficient(0);
  }
};

template <class S>
struct LanesOfAngles {
  std::int32_t i[S::kLanes], apex[S::kLanes], k[S::kLanes], type[S::kLanes];
  int count;

  /// Lanes without an angle repeat the last one.
  LanesOfAngles(const AngleTask& task, std::int64_t first)
      : count(task.count - first < S::kLanes ? static_cast<int>(task.count - first) : S::kLanes) {
    for (int lane = 0; lane < S::kLanes; ++lane) {
      const AngleOfType& angle = task.angles[first + (lane < count ? lane : count - 1)];
      i[lane] = angle.i;
      apex[lane] = angle.apex;
      k[lane] = angle.k;
      type[lane] = angle.type - task.first_type;
    }
  }
};

template <class S>
struct Arm {
  using V = typename S::V;
  V x, y, z;
};

template <class S>
typename S::V dot(const Arm<S>& a, const Arm<S>& b) {
  return S::madd(a.x, b.x, S::madd(a.y, b.y, S::mul(a.z, b.z)));
}

template <class S>
Arm<S> combined(typename S::V p, const Arm<S>& a, typename S::V q, const Arm<S>& b) {
  return {S::madd(p, a.x, S::mul(q, b.x)), S::madd(p, a.y, S::mul(q, b.y)), S::madd(p, a.z, S::mul(q, b.z))};
}

/// One lane after the other, since a particle may stand in several.
template <class S>
void add_to_three(const LanesOfAngles<S>& lanes, const Arm<S>& of_i, const Arm<S>& of_k, Vec3* forces) {
  alignas(64) double out[6][S::kLanes];
  S::store(out[0], of_i.x);
  S::store(out[1], of_i.y);
  S::store(out[2], of_i.z);
  S::store(out[3], of_k.x);
  S::store(out[4], of_k.y);
  S::store(out[5], of_k.z);
  for (int lane = 0; lane < lanes.count; ++lane) {
    Vec3 &i = forces[lanes.i[lane]], &apex = forces[lanes.apex[lane]], &k = forces[lanes.k[lane]];
    i.x += out[0][lane];
    i.y += out[1][lane];
    i.z += out[2][lane];
    apex.x -= out[0][lane] + out[3][lane];
    apex.y -= out[1][lane] + out[4][lane];
    apex.z -= out[2][lane] + out[5][lane];
    k.x += out[3][lane];
    k.y += out[4][lane];
    k.z += out[5][lane];
  }
}

template <class S>
Arm<S> gathered(const AngleTask& task, const std::int32_t* particles) {
  Arm<S> at;
  S::gather_xyz(&task.positions->x, particles, at.x, at.y, at.z);
  return at;
}

template <class S>
Arm<S> difference(const Arm<S>& a, const Arm<S>& b) {
  return {S::sub(a.x, b.x), S::sub(a.y, b.y), S::sub(a.z, b.z)};
}

/// Six sums of the products of both bonds and the forces on their ends.
template <class S>
void add_virial(const Arm<S>& a, const Arm<S>& of_i, const Arm<S>& b, const Arm<S>& of_k,
                typename S::V* virial) {
  using V = typename S::V;
  const auto add = [&](int k, V p, V q, V r, V s) {
    virial[k] = S::add(virial[k], S::madd(p, q, S::mul(r, s)));
  };
  add(0, a.x, of_i.x, b.x, of_k.x);
  add(1, a.y, of_i.y, b.y, of_k.y);
  add(2, a.z, of_i.z, b.z, of_k.z);
  add(3, a.x, of_i.y, b.x, of_k.y);
  add(4, a.x, of_i.z, b.x, of_k.z);
  add(5, a.y, of_i.z, b.y, of_k.z);
}

template <class S, class Terms, bool kOneType, bool kVirial>
void add_angles(const AngleTask& task, const LanesOfAngles<S>& lanes, const typename S::V* of_one_type,
                typename S::V* virial) {
  using V = typename S::V;
  const auto coefficient = [&](int k) {
    return kOneType ? of_one_type[k] : S::gather(task.table[k], lanes.type);
  };
  const Arm<S> apex = gathered<S>(task, lanes.apex);
  const Arm<S> a = difference<S>(gathered<S>(task, lanes.i), apex);
  const Arm<S> b = difference<S>(gathered<S>(task, lanes.k), apex);
  const V a2 = dot<S>(a, a), b2 = dot<S>(b, b), product = S::mul(a2, b2);
  // One division for three: of 1/a2, 1/b2 and 1 over the product of both lengths.
  const V inverse = S::inverse(product), over_lengths = S::over_root(product, inverse);
  const V cosine = S::mul(dot<S>(a, b), over_lengths);
  const Arm<S> normal{S::msub(a.y, b.z, S::mul(a.z, b.y)), S::msub(a.z, b.x, S::mul(a.x, b.z)),
                      S::msub(a.x, b.y, S::mul(a.y, b.x))};
  const V sine = S::mul(root_of<S>(dot<S>(normal, normal)), over_lengths);
  const V pull = Terms::over_sine(sine, cosine, coefficient), along = S::mul(S::mul(pull, cosine), inverse);
  const auto has_arms = S::less(S::zero(), product, (1u << lanes.count) - 1, 0);
  const V across = S::keep(has_arms, S::sub(S::zero(), S::mul(pull, over_lengths)));
  const Arm<S> of_i = combined<S>(S::keep(has_arms, S::mul(along, b2)), a, across, b);
  const Arm<S> of_k = combined<S>(S::keep(has_arms, S::mul(along, a2)), b, across, a);
  add_to_three<S>(lanes, of_i, of_k, task.forces);
  if constexpr (kVirial) add_virial<S>(a, of_i, b, of_k, virial);
}

template <class S, class Terms, bool kOneType, bool kVirial>
void angles_of_types(const AngleTask& task) {
  typename S::V one[Terms::kTables], virial[6];
  for (int k = 0; k < Terms::kTables; ++k) one[k] = S::set1(*task.table[k]);
  for (auto& sum : virial) sum = S::zero();
  for (std::int64_t first = 0; first < task.count; first += S::kLanes)
    add_angles<S, Terms, kOneType, kVirial>(task, LanesOfAngles<S>(task, first), one, virial);
  if constexpr (kVirial)
    for (int k = 0; k < 6; ++k) task.virial[k] += S::sum(virial[k]);
}

template <class S, class Terms>
void angles(const AngleTask& task) {
  const bool one = task.types == 1;
  if (task.virial)
    one ? angles_of_types<S, Terms, true, true>(task) : angles_of_types<S, Terms, false, true>(task);
  else
    one ? angles_of_types<S, Terms, true, false>(task) : angles_of_types<S, Terms, false, false>(task);
}

template <class S>
inline constexpr AngleKernels angle_kernels{angles<S, HarmonicAngleTerms<S>>, angles<S, CosineAngleTerms<S>>};

}  // namespace
}  // namespace dch::detail
