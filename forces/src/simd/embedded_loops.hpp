// SPDX-License-Identifier: MIT
//
// Embedded atoms over vector types; see cluster_loops.hpp. Pairs of a row within the cutoff are found first
// and put one behind the other, so that functions are looked up in full registers.
#pragma once

#include "simd/embedded_kernels.hpp"
#include "simd/records.hpp"

namespace dch::detail {
namespace {

/// Whether all types have the same functions.
template <bool kAlike>
struct Alike {};

/// Pairs whose functions are looked up at once, those of kLanes lanes.
template <class S>
struct Knots {
  using V = typename S::V;
  alignas(64) std::int32_t of_first[S::kLanes], of_second[S::kLanes];  ///< lines of both atoms
  V part;                                                              ///< of the way to the next knot

  template <bool kAlike>
  Knots(const EmbeddedTask& task, V r, std::int32_t i, const std::int32_t* j, Alike<kAlike>) {
    const V along = lesser(S::mul(r, S::set1(task.knots_per_length)), S::set1(task.last_knot));
    const V knot = S::floor(along);
    part = S::sub(along, knot);
    alignas(64) double knots[S::kLanes];
    S::store(knots, knot);
    for (int k = 0; k < S::kLanes; ++k) of_first[k] = static_cast<std::int32_t>(knots[k]);
    if constexpr (!kAlike) {
      const auto length = static_cast<std::int32_t>(task.last_knot) + 1;
      const std::int32_t own = task.type[i] - 1;
      for (int k = 0; k < S::kLanes; ++k) {
        const std::int32_t other = task.type[j[k]] - 1;
        of_second[k] = of_first[k] + length * (other * task.types + own);
        of_first[k] += length * (own * task.types + other);
      }
    }
  }
  static V lesser(V a, V b) { return S::sub(S::zero(), S::max(S::sub(S::zero(), a), S::sub(S::zero(), b))); }
};

/// a + p (b + p (c + p d))
template <class S>
typename S::V value(const typename S::V (&cubic)[4], typename S::V p) {
  return S::madd(S::madd(S::madd(cubic[3], p, cubic[2]), p, cubic[1]), p, cubic[0]);
}

/// b + p (2 c + 3 p d)
template <class S>
typename S::V slope(const typename S::V (&cubic)[4], typename S::V p) {
  const typename S::V twice = S::add(cubic[2], cubic[2]);
  return S::madd(S::madd(S::mul(cubic[3], S::set1(3)), p, twice), p, cubic[1]);
}

template <class S, bool kOfPair>
void load_cubics(const EmbeddedTask& task, const std::int32_t* lines, typename S::V (&cubics)[4]) {
  constexpr int kStride = sizeof(EmbeddedLine) / sizeof(double);
  const Cubic* const first = kOfPair ? &task.lines->pair : &task.lines->density;
  Records<S>::template load<kStride>(&first->a, lines, cubics);
}

template <class S>
typename S::V root_of(typename S::V a) {
  return S::over_root(a, a);
}

/// Displacements from second atoms to the first one, and the numbers beside second atoms.
template <class S>
struct Displacements {
  using V = typename S::V;
  V x, y, z, number;

  Displacements(const EmbeddedTask& task, std::int32_t i, const std::int32_t* j) {
    V at[4];
    Records<S>::template load<4>(&task.points->x, j, at);
    const PointAndNumber own = task.points[i];
    x = S::sub(S::set1(own.x), at[0]);
    y = S::sub(S::set1(own.y), at[1]);
    z = S::sub(S::set1(own.z), at[2]);
    number = at[3];
  }
  V squares() const { return S::add(S::add(S::mul(x, x), S::mul(y, y)), S::mul(z, z)); }
};

inline constexpr int kEmbeddedBlock = 512;  ///< neighbors of which those within the cutoff are found at once

template <class S>
inline constexpr std::uint32_t kEveryLane = (1u << S::kLanes) - 1;

/// Of so many neighbors from `first` on, those within the cutoff, with squares of their distances. Squares
/// are rounded one by one: all instruction sets find the same.
/// @returns how many; as many as registers hold are written behind them, copies of the last one
template <class S>
int find_near(const EmbeddedTask& task, std::int32_t i, const std::int32_t* first, int count,
              std::int32_t* near, double* squares) {
  using V = typename S::V;
  const V cutoff2 = S::set1(task.cutoff2);
  int found = 0;
  for (int at = 0; at < count; at += S::kLanes) {
    const int lanes = count - at < S::kLanes ? count - at : S::kLanes;
    alignas(64) std::int32_t j[S::kLanes];
    if (lanes == S::kLanes)
      for (int k = 0; k < S::kLanes; ++k) j[k] = first[at + k] & task.number_bits;
    else
      for (int k = 0; k < S::kLanes; ++k) j[k] = first[at + (k < lanes ? k : 0)] & task.number_bits;
    const V r2 = Displacements<S>(task, i, j).squares();
    const std::uint32_t is_near = S::bits(S::less(r2, cutoff2, kEveryLane<S> >> (S::kLanes - lanes), 0));
    found += Records<S>::append(is_near, j, r2, near + found, squares + found);
  }
  if (found == 0) return 0;
  for (int k = 0; k < S::kLanes; ++k) {
    near[found + k] = near[found - 1];
    squares[found + k] = squares[found - 1];
  }
  return found;
}

template <class S, bool kAlike>
typename S::V add_densities_of(EmbeddedTask& task, std::int32_t i, const std::int32_t* j, int count,
                               const double* squares) {
  using V = typename S::V;
  V sum = S::zero();
  for (int at = 0; at < count; at += S::kLanes) {
    const int lanes = count - at < S::kLanes ? count - at : S::kLanes;
    const Knots<S> knots(task, root_of<S>(S::load(squares + at)), i, j + at, Alike<kAlike>());
    V cubics[4];
    load_cubics<S, false>(task, knots.of_first, cubics);
    const V of_first = value<S>(cubics, knots.part);
    V of_second = of_first;
    if constexpr (!kAlike) {
      load_cubics<S, false>(task, knots.of_second, cubics);
      of_second = value<S>(cubics, knots.part);
    }
    alignas(64) double added[S::kLanes];
    S::store(added, of_second);
    if (lanes == S::kLanes) {
      sum = S::add(sum, of_first);
      for (int k = 0; k < S::kLanes; ++k) task.densities[j[at + k]] += added[k];
    } else {
      const V none = S::zero();
      sum =
          S::add(sum, S::keep(S::less(none, S::set1(1), kEveryLane<S> >> (S::kLanes - lanes), 0), of_first));
      for (int k = 0; k < lanes; ++k) task.densities[j[at + k]] += added[k];
    }
  }
  return sum;
}

template <class S, bool kAlike>
void embedded_densities_of(EmbeddedTask& task) {
  using V = typename S::V;
  alignas(64) double squares[kEmbeddedBlock + kBeyondNear];
  std::int32_t* near = task.near;
  for (std::int64_t row = 0; row < task.rows; ++row) {
    const std::int32_t i = task.atoms[row], count = task.counts[i];
    V sum = S::zero();
    std::int32_t* const first = near;
    for (std::int32_t at = 0; at < count; at += kEmbeddedBlock) {
      const int block = count - at < kEmbeddedBlock ? count - at : kEmbeddedBlock;
      const int found = find_near<S>(task, i, task.neighbors[i] + at, block, near, squares);
      sum = S::add(sum, add_densities_of<S, kAlike>(task, i, near, found, squares));
      near += found;
    }
    task.near_counts[i] = static_cast<std::int32_t>(near - first);
    task.densities[i] += S::sum(sum);
  }
}

/// Of kLanes pairs of atom i.
template <class S>
struct PairForces {
  using V = typename S::V;
  V x, y, z;  ///< on i
  V over_r;
  V energy;
};

template <class S, bool kAlike>
PairForces<S> forces_of(const EmbeddedTask& task, std::int32_t i, const std::int32_t* j,
                        const Displacements<S>& d, std::uint32_t lanes) {
  using V = typename S::V;
  const V r2 = d.squares(), r = root_of<S>(r2), over_r = S::inverse(r);
  const Knots<S> knots(task, r, i, j, Alike<kAlike>());
  V cubics[4];
  load_cubics<S, true>(task, knots.of_first, cubics);
  const V energy = S::mul(value<S>(cubics, knots.part), over_r);
  const V of_pair = slope<S>(cubics, knots.part);
  const V own = S::set1(task.points[i].number);
  load_cubics<S, false>(task, knots.of_first, cubics);
  V embedding;
  if constexpr (kAlike) {
    embedding = S::mul(S::add(own, d.number), slope<S>(cubics, knots.part));
  } else {
    embedding = S::mul(own, slope<S>(cubics, knots.part));
    load_cubics<S, false>(task, knots.of_second, cubics);
    embedding = S::madd(d.number, slope<S>(cubics, knots.part), embedding);
  }
  // Of phi = z / r the slope is (z' - phi) / r.
  const V scale = S::set1(task.knots_per_length);
  const V slope_of_pair = S::mul(S::msub(of_pair, scale, energy), over_r);
  const V pull = S::mul(S::madd(embedding, scale, slope_of_pair), over_r);
  const auto there = S::less(S::zero(), S::set1(1), lanes, 0);
  const V push = S::keep(there, S::sub(S::zero(), pull));
  return {S::mul(push, d.x), S::mul(push, d.y), S::mul(push, d.z), push, S::keep(there, energy)};
}

template <class S>
void write_pairs(std::int32_t i, const std::int32_t* j, int lanes, const Displacements<S>& d,
                 const PairForces<S>& forces, EmbeddedPair* pairs) {
  alignas(64) double x[S::kLanes], y[S::kLanes], z[S::kLanes], energy[S::kLanes], over_r[S::kLanes];
  S::store(x, d.x);
  S::store(y, d.y);
  S::store(z, d.z);
  S::store(energy, forces.energy);
  S::store(over_r, forces.over_r);
  for (int k = 0; k < lanes; ++k) pairs[k] = {i, j[k], {x[k], y[k], z[k]}, energy[k], over_r[k]};
}

template <class S, bool kAlike>
void embedded_forces_of(EmbeddedTask& task) {
  using V = typename S::V;
  V energy = S::zero();
  EmbeddedPair pairs[S::kLanes];
  const std::int32_t* near = task.near;
  for (std::int64_t row = 0; row < task.rows; ++row) {
    const std::int32_t i = task.atoms[row], count = task.near_counts[i];
    V x = S::zero(), y = S::zero(), z = S::zero();
    for (std::int32_t at = 0; at < count; at += S::kLanes) {
      const int lanes = count - at < S::kLanes ? count - at : S::kLanes;
      alignas(64) std::int32_t last[S::kLanes];
      const std::int32_t* j = near + at;
      if (lanes < S::kLanes) {
        for (int k = 0; k < S::kLanes; ++k) last[k] = j[k < lanes ? k : 0];
        j = last;
      }
      const Displacements<S> d(task, i, j);
      const PairForces<S> forces = forces_of<S, kAlike>(task, i, j, d, kEveryLane<S> >> (S::kLanes - lanes));
      x = S::add(x, forces.x);
      y = S::add(y, forces.y);
      z = S::add(z, forces.z);
      energy = S::add(energy, forces.energy);
      const V of_pairs[3] = {forces.x, forces.y, forces.z};
      Records<S>::subtract(of_pairs, j, lanes, &task.forces->x);
      if (task.visit) {
        write_pairs<S>(i, j, lanes, d, forces, pairs);
        task.visit(task.visitor, pairs, lanes);
      }
    }
    PointAndNumber& own = task.forces[i];
    own.x += S::sum(x);
    own.y += S::sum(y);
    own.z += S::sum(z);
    near += count;
  }
  task.energy += S::sum(energy);
}

template <class S>
void embedded_densities(EmbeddedTask& task) {
  if (task.types == 1)
    embedded_densities_of<S, true>(task);
  else
    embedded_densities_of<S, false>(task);
}

template <class S>
void embedded_forces(EmbeddedTask& task) {
  if (task.types == 1)
    embedded_forces_of<S, true>(task);
  else
    embedded_forces_of<S, false>(task);
}

template <class S>
inline constexpr EmbeddedKernels embedded_kernels_of{embedded_densities<S>, embedded_forces<S>};

}  // namespace
}  // namespace dch::detail
