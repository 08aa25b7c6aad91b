// SPDX-License-Identifier: MIT
//
// The loops of Lennard-Jones and Coulomb forces over pairs one by one; see cluster_loops.hpp.
#pragma once

#include "simd/lj_kernels_loops.hpp"
#include "simd/pair_forces_loops.hpp"

namespace dch::detail {
namespace {

/// The pairs of kLanes lanes: which particles they are of, whose position the second one has, where their
/// types stand in the matrices, and their kinds; the last two of weighted pairs only.
struct LanePairs {
  const std::int32_t *i, *j, *at, *types, *kind;
};

/// The coefficients of kLanes pairs; those of one type are the same for all.
template <class S, LjParameters kParameters>
struct LaneCoefficients;

template <class S>
struct LaneCoefficients<S, LjParameters::one_type> : PairCoefficients<S, LjParameters::one_type> {
  using PairCoefficients<S, LjParameters::one_type>::PairCoefficients;
  void choose(const LjPairTask&, const LanePairs&) {}
};

template <class S>
struct LaneCoefficients<S, LjParameters::by_type> {
  static constexpr bool kMixes = false;
  using V = typename S::V;
  explicit LaneCoefficients(const LjCoefficients<double>& c)
      : table{c.cutoff2, c.force12, c.force6, c.energy12, c.energy6, c.energy_shift, c.coulomb_cutoff2} {}
  void choose(const LjPairTask& task, const LanePairs& pairs) {
    for (int k = 0; k < S::kLanes; ++k)
      at[k] = pairs.types ? pairs.types[k] : task.type[pairs.i[k]] * task.types + task.type[pairs.j[k]];
  }
  V operator()(int k, int) const { return S::gather(table[k], at); }

  const double* table[kCoefficients];
  alignas(32) std::int32_t at[S::kLanes]{};
};

/// What pairs are multiplied by, and how far their charges act.
template <class S>
struct PairWeights {
  typename S::V own, charges;
};

template <class S>
struct LaneSums {
  LaneSums() : energy(S::zero()), coulomb_energy(S::zero()) {
    for (auto& v : virial) v = S::zero();
  }
  template <Wanted kFound, class Kind>
  void give(LjSums& sums) const {
    if constexpr (kFound == Wanted::forces) return;
    sums.energy += S::sum(energy);
    if constexpr (Kind::kHasCharges) sums.coulomb_energy += S::sum(coulomb_energy);
    for (int v = 0; v < 6; ++v) sums.virial[v] += S::sum(virial[v]);
  }
  typename S::V energy, coulomb_energy, virial[6];
};

template <class S>
Coordinates<S> shift_of(const LjPairTask& task) {
  Coordinates<S> shift;
  shift.x[0] = S::set1(task.shift.x);
  shift.y[0] = S::set1(task.shift.y);
  shift.z[0] = S::set1(task.shift.z);
  return shift;
}

/// Adds half of the numbers of pairs, those of `lanes` alone, to each of their two particles.
template <class S>
void add_halves_to_both(std::uint32_t lanes, const std::int32_t* i, const std::int32_t* j,
                        const typename S::V* numbers, double* tallies) {
  alignas(64) double half[kTallied][S::kLanes];
  for (int n = 0; n < kTallied; ++n) S::store(half[n], S::mul(S::set1(0.5), numbers[n]));
  for (; lanes != 0; lanes &= lanes - 1) {
    const int k = __builtin_ctz(lanes);
    double* const of_i = tallies + kTallied * static_cast<std::ptrdiff_t>(i[k]);
    double* const of_j = tallies + kTallied * static_cast<std::ptrdiff_t>(j[k]);
    for (int n = 0; n < kTallied; ++n) of_i[n] += half[n][k];
    for (int n = 0; n < kTallied; ++n) of_j[n] += half[n][k];
  }
}

/// kLanes pairs of which only those in `mask` act.
template <class S, Wanted kFound, bool kWeighted, class Kind, class Coefficients>
void add_pairs(const LjPairTask& task, const LanePairs& pairs, std::uint32_t mask,
               const Coordinates<S>& shift, const Constants<S>& constants, Coefficients& coefficient,
               LaneSums<S>& sum) {
  using V = typename S::V;
  const double* const positions = &task.positions->x;
  V xi, yi, zi, xj, yj, zj;
  S::gather_xyz(positions, pairs.i, xi, yi, zi);
  S::gather_xyz(positions, pairs.at, xj, yj, zj);
  const V dx = S::add(S::sub(xj, xi), shift.x[0]), dy = S::add(S::sub(yj, yi), shift.y[0]),
          dz = S::add(S::sub(zj, zi), shift.z[0]);
  V r2 = S::madd(dx, dx, S::madd(dy, dy, S::mul(dz, dz)));
  if constexpr (Kind::kActsAtZero) r2 = S::max(r2, S::set1(kNearZero<double>));
  coefficient.choose(task, pairs);
  V reach2 = coefficient(kCutoff2, 0);
  if constexpr (Kind::kHasCharges) reach2 = S::max(reach2, coefficient(kCoulombCutoff2, 0));
  const auto near = S::less(r2, reach2, mask, 0);
  const std::uint32_t lanes = S::bits(near);
  if (lanes == 0) return;
  const V s = S::keep(near, S::inverse(r2));
  V charge = S::zero();
  if constexpr (Kind::kHasCharges)
    charge = S::mul(S::mul(S::gather(task.charge, pairs.i), S::gather(task.charge, pairs.j)),
                    S::set1(task.charge_unit * task.charge_unit));
  const Products<S> products{charge, S::zero()};
  constexpr bool kSums = kFound != Wanted::forces;
  PairTerms<S> terms;
  if constexpr (kWeighted)
    terms = Kind::template weighted_terms<S, kSums>(
        coefficient, 0, r2, s, products, constants,
        {S::gather(task.weight, pairs.kind), S::gather(task.charge_weight, pairs.kind)});
  else
    terms = Kind::template terms<S, kSums>(coefficient, 0, r2, s, products, constants);
  const V fx = S::mul(terms.force, dx), fy = S::mul(terms.force, dy), fz = S::mul(terms.force, dz);
  if constexpr (kSums) {
    sum.energy = S::add(sum.energy, terms.energy);
    if constexpr (Kind::kHasCharges) sum.coulomb_energy = S::add(sum.coulomb_energy, terms.coulomb_energy);
    sum.virial[0] = S::madd(dx, fx, sum.virial[0]);
    sum.virial[1] = S::madd(dy, fy, sum.virial[1]);
    sum.virial[2] = S::madd(dz, fz, sum.virial[2]);
    sum.virial[3] = S::madd(dx, fy, sum.virial[3]);
    sum.virial[4] = S::madd(dx, fz, sum.virial[4]);
    sum.virial[5] = S::madd(dy, fz, sum.virial[5]);
  }
  if constexpr (kFound == Wanted::tallies) {
    const V coulomb_energy = Kind::kHasCharges ? terms.coulomb_energy : S::zero();
    const V tallied[kTallied] = {terms.energy,   coulomb_energy, S::mul(dx, fx), S::mul(dy, fy),
                                 S::mul(dz, fz), S::mul(dx, fy), S::mul(dx, fz), S::mul(dy, fz)};
    add_halves_to_both<S>(lanes, pairs.i, pairs.j, tallied, task.tallies);
  }
  add_to_both<S>(lanes, pairs.i, pairs.j, fx, fy, fz, task.forces);
}

template <bool kWeighted>
LanePairs lanes_from(const LjPairTask& task, std::int64_t k) {
  if constexpr (kWeighted)
    return {task.i + k, task.j + k, task.at + k, task.pair_of_types + k, task.kind + k};
  return {task.i + k, task.j + k, task.j + k, nullptr, nullptr};
}

template <class S, LjParameters kParameters, Wanted kFound, class Kind, bool kWeighted = false>
DCH_FLATTEN void lennard_jones_of_pairs(const LjPairTask& task, LjSums& sums) {
  LaneCoefficients<S, kParameters> coefficient(task.coefficients);
  const Constants<S> constants(task.constants);
  const Coordinates<S> shift = shift_of<S>(task);
  LaneSums<S> sum;
  constexpr std::uint32_t kAll = (1u << S::kLanes) - 1;
  std::int64_t k = task.first;
  for (; k + S::kLanes <= task.last; k += S::kLanes)
    add_pairs<S, kFound, kWeighted, Kind>(task, lanes_from<kWeighted>(task, k), kAll, shift, constants,
                                          coefficient, sum);
  if (k < task.last) {
    // Lanes without a pair repeat the first one, whose mask bit they lack.
    std::int32_t lanes[5][S::kLanes]{};
    for (int lane = 0; lane < S::kLanes; ++lane) {
      const LanePairs from = lanes_from<kWeighted>(task, k + lane < task.last ? k + lane : k);
      lanes[0][lane] = *from.i;
      lanes[1][lane] = *from.j;
      lanes[2][lane] = *from.at;
      if constexpr (kWeighted) lanes[3][lane] = *from.types, lanes[4][lane] = *from.kind;
    }
    const LanePairs pairs{lanes[0], lanes[1], lanes[2], kWeighted ? lanes[3] : nullptr, lanes[4]};
    const auto mask = kAll >> (S::kLanes - (task.last - k));
    add_pairs<S, kFound, kWeighted, Kind>(task, pairs, mask, shift, constants, coefficient, sum);
  }
  sum.template give<kFound, Kind>(sums);
}

template <class S, class Kind>
constexpr LjFunctions<LjPairTask>::OfKind lj_pair_functions_of_kind{
    {{lennard_jones_of_pairs<S, LjParameters::one_type, Wanted::forces, Kind>,
      lennard_jones_of_pairs<S, LjParameters::one_type, Wanted::sums, Kind>},
     {lennard_jones_of_pairs<S, LjParameters::by_type, Wanted::forces, Kind>,
      lennard_jones_of_pairs<S, LjParameters::by_type, Wanted::sums, Kind>},
     {}}};

template <class S>
constexpr LjFunctions<LjPairTask> lj_pair_functions_of{
    {lj_pair_functions_of_kind<S, LjKind<ForceKind::lennard_jones>>,
     lj_pair_functions_of_kind<S, LjKind<ForceKind::plain>>,
     lj_pair_functions_of_kind<S, LjKind<ForceKind::ewald>>,
     {},
     {},
     {},
     {},
     {},
     {}}};

}  // namespace
}  // namespace dch::detail
