// SPDX-License-Identifier: MIT
//
// Contacts of grains over vector types; see cluster_loops.hpp. Of a block of listed pairs those that touch
// are found first, then their forces are computed, as many at once as a register has lanes.
#pragma once

#include <algorithm>
#include <limits>

#include "clusters/simd/cluster_loops.hpp"
#include "simd/contact_kernels.hpp"

namespace dch::detail {
namespace {

/// Vectors of three axes.
template <class S>
struct Axes {
  using V = typename S::V;
  V x, y, z;

  static Axes load(const Vec3* from, const std::int32_t* at) { return load(&from->x, at); }
  static Axes load(const double* from, const std::int32_t* at) {
    Axes a;
    S::gather_xyz(from, at, a.x, a.y, a.z);
    return a;
  }
  friend Axes operator+(const Axes& a, const Axes& b) {
    return {S::add(a.x, b.x), S::add(a.y, b.y), S::add(a.z, b.z)};
  }
  friend Axes operator-(const Axes& a, const Axes& b) {
    return {S::sub(a.x, b.x), S::sub(a.y, b.y), S::sub(a.z, b.z)};
  }
  Axes times(V f) const { return {S::mul(x, f), S::mul(y, f), S::mul(z, f)}; }
  /// f times this, and b.
  Axes times_plus(V f, const Axes& b) const {
    return {S::madd(x, f, b.x), S::madd(y, f, b.y), S::madd(z, f, b.z)};
  }
  V dot(const Axes& b) const { return S::madd(x, b.x, S::madd(y, b.y, S::mul(z, b.z))); }
  Axes cross(const Axes& b) const {
    return {S::msub(y, b.z, S::mul(z, b.y)), S::msub(z, b.x, S::mul(x, b.z)),
            S::msub(x, b.y, S::mul(y, b.x))};
  }
};

/// Numbers of lanes that are stored.
template <class S>
struct StoredAxes {
  alignas(64) double x[S::kLanes], y[S::kLanes], z[S::kLanes];

  explicit StoredAxes(const Axes<S>& a) {
    S::store(x, a.x);
    S::store(y, a.y);
    S::store(z, a.z);
  }
  Vec3 operator[](int k) const { return {x[k], y[k], z[k]}; }
};

inline constexpr std::uint32_t kAllLanes = 0xFFFF;

/// Vectors of double precision have exact roots.
template <class S>
typename S::V root(typename S::V a) {
  return S::over_root(a, a);
}

template <class S>
typename S::V negative(typename S::V a) {
  return S::sub(S::zero(), a);
}

/// a where flag is 1, b where it is 0.
template <class S>
typename S::V choose(typename S::V flag, typename S::V a, typename S::V b) {
  const typename S::V half = S::set1(0.5);
  return S::add(S::keep(S::less(half, flag, kAllLanes, 0), a), S::keep(S::less(flag, half, kAllLanes, 0), b));
}

inline constexpr int kContactBlock = 256;  ///< pairs of which those that touch are found at once

/// Which pairs touch, by squares that are rounded one by one: all instruction sets find the same.
template <class S>
std::uint32_t touching_lanes(const ContactTask& task, const std::int32_t* i, const std::int32_t* j,
                             std::uint32_t mask) {
  using V = typename S::V;
  const double* const bodies = &task.bodies->radius;
  const Axes<S> d = Axes<S>::load(task.positions, i) - Axes<S>::load(task.positions, j);
  const V reach = S::add(Axes<S>::load(bodies, i).x, Axes<S>::load(bodies, j).x);
  const V r2 = S::add(S::add(S::mul(d.x, d.x), S::mul(d.y, d.y)), S::mul(d.z, d.z));
  return S::bits(S::less(r2, S::mul(reach, reach), mask, 0));
}

/// Writes which of the pairs from `first` on touch, ascending, and returns how many.
template <class S, bool kHistory>
int find_touching(const ContactTask& task, std::int64_t first, int count, std::int32_t* contacts) {
  int found = 0;
  for (int at = 0; at < count; at += S::kLanes) {
    const int lanes = std::min(count - at, S::kLanes);
    const std::int32_t *i = task.i + first + at, *j = task.j + first + at;
    std::int32_t last_i[S::kLanes], last_j[S::kLanes];
    if (lanes < S::kLanes) {
      for (int k = 0; k < S::kLanes; ++k) {
        last_i[k] = i[std::min(k, lanes - 1)];
        last_j[k] = j[std::min(k, lanes - 1)];
      }
      i = last_i;
      j = last_j;
    }
    const std::uint32_t touching =
        touching_lanes<S>(task, i, j, ((1u << S::kLanes) - 1) >> (S::kLanes - lanes));
    for (int k = 0; k < lanes; ++k) {
      const std::int64_t pair = first + at + k;
      const auto touches = static_cast<std::int32_t>(touching >> k & 1);
      if constexpr (kHistory) {
        if (task.touching[pair] > touches) task.slips[pair] = {};
        task.touching[pair] = touches;
      }
      contacts[found] = static_cast<std::int32_t>(pair);
      found += touches;
    }
  }
  return found;
}

/// One lane after the other, since a grain may stand in several.
template <class S, bool kHistory>
void add_contacts(const ContactTask& task, std::uint32_t mask, const std::int32_t* pair,
                  const std::int32_t* i, const std::int32_t* j, const Axes<S>& force, const Axes<S>& torque,
                  const Axes<S>& slip, const Axes<S>& from_j_to_i) {
  const StoredAxes<S> forces(force), torques(torque), slips(slip);
  for (std::uint32_t lanes = mask; lanes != 0; lanes &= lanes - 1) {
    const int k = __builtin_ctz(lanes);
    const Vec3 f = forces[k], t = torques[k];
    task.forces[i[k]] = task.forces[i[k]] + f;
    task.torques[i[k]] = task.torques[i[k]] - task.bodies[i[k]].radius * t;
    if (j[k] < task.owned) {
      task.forces[j[k]] = task.forces[j[k]] - f;
      task.torques[j[k]] = task.torques[j[k]] - task.bodies[j[k]].radius * t;
    }
    if constexpr (kHistory) task.slips[pair[k]] = slips[k];
  }
  if (!task.found) return;
  const StoredAxes<S> apart(from_j_to_i);
  for (std::uint32_t lanes = mask; lanes != 0; lanes &= lanes - 1) {
    const int k = __builtin_ctz(lanes);
    task.found->push_back({i[k], j[k], apart[k], forces[k]});
  }
}

/// A contact, but for its history.
template <class S>
struct Touch {
  using V = typename S::V;
  Axes<S> d;  ///< from j to i
  V r, over_r;
  V mass;         ///< the effective one
  V hertz;        ///< the factor of Hertz; only of its form
  Axes<S> speed;  ///< across d, spins included
  V push;         ///< the force along d, over r

  template <bool kHertz>
  static Touch of(const ContactTask& task, const std::int32_t* i, const std::int32_t* j) {
    const ContactParams& params = task.params;
    const double* const bodies = &task.bodies->radius;
    Touch at;
    at.d = Axes<S>::load(task.positions, i) - Axes<S>::load(task.positions, j);
    const Axes<S> body_i = Axes<S>::load(bodies, i), body_j = Axes<S>::load(bodies, j);
    const V radius_i = body_i.x, radius_j = body_j.x, reach = S::add(radius_i, radius_j);
    at.r = root<S>(at.d.dot(at.d));
    // Of m_i m_j / (m_i + m_j); of a pair with a frozen grain the mass of the other, over 1.
    const V mass_i = body_i.y, mass_j = body_j.y, one = S::set1(1);
    const V above = choose<S>(body_j.z, mass_i, choose<S>(body_i.z, mass_j, S::mul(mass_i, mass_j)));
    const V below = choose<S>(body_j.z, one, choose<S>(body_i.z, one, S::add(mass_i, mass_j)));
    // One division for all.
    const V product = S::mul(at.r, below);
    const V inverse = S::inverse(kHertz ? S::mul(product, reach) : product);
    const V of_product = kHertz ? S::mul(inverse, reach) : inverse;
    at.over_r = S::mul(of_product, below);
    at.mass = S::mul(above, S::mul(of_product, at.r));
    const Axes<S> v = Axes<S>::load(task.velocities, i) - Axes<S>::load(task.velocities, j);
    const Axes<S> spin =
        Axes<S>::load(task.spins, i).times(radius_i) + Axes<S>::load(task.spins, j).times(radius_j);
    const V along = S::mul(v.dot(at.d), S::mul(at.over_r, at.over_r));
    at.speed = v - at.d.times(along) + at.d.cross(spin.times(at.over_r));
    const V overlap = S::sub(reach, at.r);
    at.push = S::sub(S::mul(S::set1(params.stiffness), S::mul(overlap, at.over_r)),
                     S::mul(S::mul(at.mass, S::set1(params.damping)), along));
    if constexpr (kHertz) {
      at.hertz = root<S>(S::mul(overlap, S::mul(S::mul(radius_i, radius_j), S::mul(inverse, product))));
      at.push = S::mul(at.push, at.hertz);
    }
    if (params.limits_damping) at.push = S::max(at.push, S::zero());
    return at;
  }

  /// The largest force across d.
  V friction(double coefficient) const {
    const V force = S::mul(push, r);
    return S::mul(S::set1(coefficient), S::max(force, negative<S>(force)));
  }
};

/// What a division by has to be kept from 0.
template <class S>
typename S::V not_zero(typename S::V a) {
  return S::max(a, S::set1(std::numeric_limits<double>::min()));
}

template <class S>
typename S::V lesser(typename S::V a, typename S::V b) {
  return negative<S>(S::max(negative<S>(a), negative<S>(b)));
}

/// The force across d of contacts without history.
template <class S>
Axes<S> drag(const ContactTask& task, const Touch<S>& at) {
  using V = typename S::V;
  const V speed = root<S>(at.speed.dot(at.speed));
  const V most = S::mul(at.friction(task.params.friction), S::inverse(not_zero<S>(speed)));
  return at.speed.times(negative<S>(lesser<S>(most, S::mul(at.mass, S::set1(task.params.shear_damping)))));
}

/// The same of contacts with history, which slips on.
template <class S, bool kHertz>
Axes<S> friction(const ContactTask& task, const Touch<S>& at, Axes<S>& slip) {
  using V = typename S::V;
  const ContactParams& params = task.params;
  if (task.advances) slip = at.speed.times_plus(S::set1(task.timestep), slip);
  const V length2 = slip.dot(slip);
  if (task.advances) {
    const V out_of_plane = S::mul(slip.dot(at.d), S::mul(at.over_r, at.over_r));
    slip = slip - at.d.times(out_of_plane);
  }
  const V shear_damping = S::mul(at.mass, S::set1(params.shear_damping));
  const Axes<S> wanted = slip.times(S::set1(params.shear_stiffness)) + at.speed.times(shear_damping);
  const V hertz = kHertz ? at.hertz : S::set1(1);
  const Axes<S> force = wanted.times(kHertz ? negative<S>(hertz) : S::set1(-1));
  const V strength = root<S>(force.dot(force)), most = at.friction(params.friction);
  const auto slides = S::less(most, strength, kAllLanes, 0);
  if (S::bits(slides) == 0) return force;
  // A contact that slides is as long as friction holds it; one that has not slipped yet has no force.
  const V one = S::set1(1), none = S::zero();
  const V share = lesser<S>(S::mul(most, S::inverse(not_zero<S>(strength))), one);
  const auto has_slip = S::less(none, length2, kAllLanes, 0);
  const V kept = S::add(S::keep(slides, S::keep(has_slip, share)), S::sub(one, S::keep(slides, one)));
  const V lost = S::keep(slides, S::keep(has_slip, S::sub(share, one)));
  const V over_stiffness = S::mul(shear_damping, S::set1(1 / params.shear_stiffness));
  const Axes<S> change = (slip + at.speed.times(over_stiffness)).times(lost);
  const auto of_sliding = [&](V a) { return S::keep(slides, S::keep(has_slip, a)); };
  slip = slip + Axes<S>{of_sliding(change.x), of_sliding(change.y), of_sliding(change.z)};
  return force.times(kept);
}

template <class S, ContactForm kForm>
void compute_contacts(const ContactTask& task) {
  constexpr bool kHistory = kForm != ContactForm::hooke, kHertz = kForm == ContactForm::hertz_history;
  std::int32_t contacts[kContactBlock + S::kLanes];
  for (std::int64_t first = 0; first < task.count; first += kContactBlock) {
    const int count = static_cast<int>(std::min<std::int64_t>(task.count - first, kContactBlock));
    const int found = find_touching<S, kHistory>(task, first, count, contacts);
    if (found == 0) continue;
    std::fill_n(contacts + found, S::kLanes, contacts[found - 1]);
    for (int at = 0; at < found; at += S::kLanes) {
      const std::int32_t* const pair = contacts + at;
      std::int32_t i[S::kLanes], j[S::kLanes];
      for (int k = 0; k < S::kLanes; ++k) {
        i[k] = task.i[pair[k]];
        j[k] = task.j[pair[k]];
      }
      const auto touch = Touch<S>::template of<kHertz>(task, i, j);
      Axes<S> slip{S::zero(), S::zero(), S::zero()}, across;
      if constexpr (kHistory) {
        slip = Axes<S>::load(task.slips, pair);
        across = friction<S, kHertz>(task, touch, slip);
      } else {
        across = drag<S>(task, touch);
      }
      const Axes<S> force = touch.d.times_plus(touch.push, across);
      const Axes<S> torque = touch.d.cross(across).times(touch.over_r);
      const int lanes = std::min(found - at, S::kLanes);
      add_contacts<S, kHistory>(task, ((1u << S::kLanes) - 1) >> (S::kLanes - lanes), pair, i, j, force,
                                torque, slip, touch.d);
    }
  }
}

template <class S>
inline constexpr ContactKernels contact_kernels_of{compute_contacts<S, ContactForm::hooke>,
                                                   compute_contacts<S, ContactForm::hooke_history>,
                                                   compute_contacts<S, ContactForm::hertz_history>};

}  // namespace
}  // namespace dch::detail
