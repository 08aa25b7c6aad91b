// SPDX-License-Identifier: MIT
//
// The loops of Lennard-Jones and Coulomb forces over vector types; see cluster_kernels_loops.hpp.
#pragma once

#include "cluster_kernels_loops.hpp"

namespace dch::detail {
namespace {

enum Coefficient {
  kCutoff2,
  kForce12,
  kForce6,
  kEnergy12,
  kEnergy6,
  kEnergyShift,
  kCoulombCutoff2,
  kCoefficients
};

/// The coefficients of 16 pairs, part by part; those of one type are the same for all.
template <class S, LjParameters kParameters>
struct PairCoefficients;

template <class S>
struct PairCoefficients<S, LjParameters::one_type> {
  static constexpr bool kMixes = false;
  using V = typename S::V;
  using Real = typename S::Real;
  explicit PairCoefficients(const LjTask<Real>& task) : PairCoefficients(task.coefficients) {}
  explicit PairCoefficients(const LjCoefficients<Real>& c) {
    const Real* const from[kCoefficients] = {c.cutoff2, c.force12,      c.force6,         c.energy12,
                                             c.energy6, c.energy_shift, c.coulomb_cutoff2};
    for (int k = 0; k < kCoefficients; ++k) value[k] = S::set1(*from[k]);
  }
  void choose_i(std::int32_t) {}
  void choose_j(std::int32_t) {}
  V operator()(int k, int) const { return value[k]; }

  V value[kCoefficients];
};

template <class S>
struct PairCoefficients<S, LjParameters::by_type> {
  static constexpr bool kMixes = false;
  using V = typename S::V;
  using Real = typename S::Real;
  explicit PairCoefficients(const LjTask<Real>& task)
      : type(task.type), types(task.types), c(task.coefficients), table{c.cutoff2,        c.force12,
                                                                        c.force6,         c.energy12,
                                                                        c.energy6,        c.energy_shift,
                                                                        c.coulomb_cutoff2} {}
  void choose_i(std::int32_t cluster) {
    for (int a = 0; a < 4; ++a) row[a] = type[4 * cluster + a] * types;
  }
  void choose_j(std::int32_t cluster) { of_j = type + 4 * cluster; }
  V operator()(int k, int part) const { return S::lookup(table[k], types, row, of_j, part); }

  const std::int32_t* type;
  std::int32_t types;
  LjCoefficients<Real> c;
  const Real* table[kCoefficients];
  std::int32_t row[4]{};
  const std::int32_t* of_j = nullptr;
};

/// Mixed by the rules of Lorentz and Berthelot: mean sigma, geometric mean of epsilon. One cutoff for all.
template <class S>
struct PairCoefficients<S, LjParameters::by_particle> {
  static constexpr bool kMixes = true;
  using V = typename S::V;
  using Real = typename S::Real;
  explicit PairCoefficients(const LjTask<Real>& task)
      : half_sigma(task.half_sigma),
        root_epsilon(task.root_epsilon),
        cutoff2(S::set1(*task.coefficients.cutoff2)) {}
  void choose_i(std::int32_t cluster) {
    for (int p = 0; p < S::kParts; ++p) {
      sigma_of_i[p] = S::spread(half_sigma + 4 * cluster, p);
      epsilon_of_i[p] = S::spread(root_epsilon + 4 * cluster, p);
    }
  }
  void choose_j(std::int32_t cluster) { of_j = 4 * cluster; }
  V operator()(int, int) const { return cutoff2; }
  V sigma(int p) const { return S::add(sigma_of_i[p], S::repeat(half_sigma + of_j)); }
  V four_epsilon(int p) const { return S::mul(epsilon_of_i[p], S::repeat(root_epsilon + of_j)); }

  const Real *half_sigma, *root_epsilon;
  V cutoff2, sigma_of_i[S::kParts], epsilon_of_i[S::kParts];
  std::int32_t of_j = 0;
};

/// Displacements, squared distances and their inverse of an entry's pairs; the latter are 0 where nothing
/// acts.
template <class S>
struct Separations {
  Coordinates<S> d;
  typename S::V r2[S::kParts], s[S::kParts];
};

/// e^y for y <= 0, to a unit in the last place or two; not less than the least normal number.
template <class S>
typename S::V exp_of_negative(typename S::V y) {
  using V = typename S::V;
  using Real = typename S::Real;
  constexpr bool kSingle = sizeof(Real) == 4;
  // Added to a small integer, this leaves it in the last bits.
  constexpr Real kInteger = kSingle ? Real(0x1.8p23) : Real(0x1.8p52);
  constexpr Real kLog2OfE = Real(1.4426950408889634);
  // ln 2 in two parts, the first so short that integers times it are exact.
  constexpr Real kLn2High = kSingle ? Real(0x1.62ep-1) : Real(0x1.62e42feep-1);
  constexpr Real kLn2Low = kSingle ? Real(0x1.0bfbe8p-15) : Real(0x1.a39ef35793c76p-33);
  constexpr Real kLeast = kSingle ? Real(-87) : Real(-708);
  // 1/k!, highest first: the remainder is below 0.35^8/8! (single) or 0.35^14/14! (double).
  constexpr double kSeries[] = {
      1.0 / 6227020800, 1.0 / 479001600, 1.0 / 39916800, 1.0 / 3628800, 1.0 / 362880, 1.0 / 40320, 1.0 / 5040,
      1.0 / 720,        1.0 / 120,       1.0 / 24,       1.0 / 6,       0.5,          1.0,         1.0};
  y = S::max(y, S::set1(kLeast));
  const V shifted = S::madd(y, S::set1(kLog2OfE), S::set1(kInteger));
  const V n = S::sub(shifted, S::set1(kInteger));
  const V rest = S::madd(n, S::set1(-kLn2Low), S::madd(n, S::set1(-kLn2High), y));
  constexpr int kFirst = kSingle ? 6 : 0;
  V sum = S::set1(Real(kSeries[kFirst]));
  for (int k = kFirst + 1; k < 14; ++k) sum = S::madd(sum, rest, S::set1(Real(kSeries[k])));
  return S::mul(sum, S::power_of_two(n));
}

/// What an Ewald sum leaves to a pair, relative to the bare Coulomb term.
template <class S>
struct EwaldFactors {
  typename S::V energy, force;
};

/// erfc(x) and erfc(x) + 2 x e^(-x^2) / sqrt(pi), by formula 7.1.26 of Abramowitz and Stegun, Handbook of
/// Mathematical Functions (1964), which is within 1.5e-7. The digits are those of LAMMPS's pair styles, with
/// which the results have to agree.
template <class S>
EwaldFactors<S> ewald_factors(typename S::V x) {
  using V = typename S::V;
  using Real = typename S::Real;
  const V expm2 = exp_of_negative<S>(S::mul(S::sub(S::zero(), x), x));
  const V t = S::inverse(S::madd(S::set1(Real(0.3275911)), x, S::set1(1)));
  V poly = S::madd(t, S::set1(Real(1.061405429)), S::set1(Real(-1.453152027)));
  poly = S::madd(t, poly, S::set1(Real(1.421413741)));
  poly = S::madd(t, poly, S::set1(Real(-0.284496736)));
  poly = S::madd(t, poly, S::set1(Real(0.254829592)));
  const V erfc = S::mul(S::mul(t, poly), expm2);
  return {erfc, S::madd(S::mul(S::set1(Real(1.12837917)), x), expm2, erfc)};
}

/// LjConstants in all lanes.
template <class S>
struct Constants {
  explicit Constants(const LjConstants<typename S::Real>& c)
      : splitting(S::set1(c.splitting)),
        quadratic(S::set1(c.quadratic)),
        offset(S::set1(c.offset)),
        switch_from(S::set1(c.switch_from)),
        over_width(S::set1(c.over_width)) {}
  typename S::V splitting, quadratic, offset, switch_from, over_width;
};

/// Charges of a row's cluster, for the pairs of each part.
template <class S>
struct RowCharges {
  typename S::V of_i[S::kParts];
};

template <class S, LjParameters kParameters, ForceKind kKind>
Separations<S> measure(const LjTask<typename S::Real>& task, const ClusterPairs::Row& row,
                       const Coordinates<S>& i, const ClusterPairs::Entry& entry,
                       PairCoefficients<S, kParameters>& coefficient) {
  using V = typename S::V;
  const auto j = S::load_cluster(task.at[entry.cluster], task.shift[row.first_shift + entry.shift],
                                 task.at[row.cluster]);
  coefficient.choose_j(entry.cluster);
  Separations<S> found;
  for (int p = 0; p < S::kParts; ++p) {
    const V dx = S::sub(j.x, i.x[p]), dy = S::sub(j.y, i.y[p]), dz = S::sub(j.z, i.z[p]);
    const V r2 = S::madd(dx, dx, S::madd(dy, dy, S::mul(dz, dz)));
    found.d.x[p] = dx;
    found.d.y[p] = dy;
    found.d.z[p] = dz;
    found.r2[p] = r2;
    V reach2 = coefficient(kCutoff2, p);
    if constexpr (has_two_cutoffs(kKind)) reach2 = S::max(reach2, coefficient(kCoulombCutoff2, p));
    found.s[p] = S::keep(S::less(r2, reach2, entry.mask, p), S::inverse(r2));
  }
  return found;
}

/// What a part's pairs add: force / r, energies.
template <class S>
struct PairTerms {
  typename S::V force, energy, coulomb_energy;
};

/// Of Lennard-Jones alone. The energy is not shifted, and not computed unless it is wanted.
template <class S, bool kEnergy, class Coefficients>
PairTerms<S> lennard_jones_terms(const Coefficients& coefficient, int p, typename S::V s) {
  using V = typename S::V;
  using Real = typename S::Real;
  PairTerms<S> terms{S::zero(), S::zero(), S::zero()};
  if constexpr (Coefficients::kMixes) {
    const V sigma = coefficient.sigma(p), s2 = S::mul(S::mul(sigma, sigma), s);
    const V s6 = S::mul(S::mul(s2, s2), s2), attraction = S::mul(coefficient.four_epsilon(p), s6);
    const V inner = S::msub(S::set1(Real(12)), s6, S::set1(Real(6)));
    terms.force = S::mul(S::mul(attraction, inner), s);
    if constexpr (kEnergy) terms.energy = S::msub(attraction, s6, attraction);
  } else {
    const V s3 = S::mul(S::mul(s, s), s);
    terms.force = S::mul(S::mul(s3, s), S::msub(coefficient(kForce12, p), s3, coefficient(kForce6, p)));
    if constexpr (kEnergy)
      terms.energy = S::mul(s3, S::msub(coefficient(kEnergy12, p), s3, coefficient(kEnergy6, p)));
  }
  return terms;
}

/// Multiplies the energy by 1 + t^3 (-10 + t (15 - 6 t)), t = max(0, (r - from) / width); nothing acts beyond
/// t = 1.
template <class S>
void switch_off(typename S::V r, typename S::V over_r, const Constants<S>& constants, PairTerms<S>& terms) {
  using V = typename S::V;
  using Real = typename S::Real;
  const V t = S::max(S::zero(), S::mul(S::sub(r, constants.switch_from), constants.over_width));
  const V t2 = S::mul(t, t);
  const V tail = S::madd(t, S::madd(t, S::set1(Real(-6)), S::set1(Real(15))), S::set1(Real(-10)));
  const V value = S::madd(S::mul(t2, t), tail, S::set1(Real(1)));
  const V bend = S::madd(t, S::madd(t, S::set1(Real(-30)), S::set1(Real(60))), S::set1(Real(-30)));
  const V slope = S::mul(S::mul(t2, bend), constants.over_width);
  terms.force = S::msub(value, terms.force, S::mul(S::mul(slope, terms.energy), over_r));
  terms.energy = S::mul(value, terms.energy);
}

/// Charges in a reaction field, which ends where Lennard-Jones does.
template <class S, bool kSums>
void add_reaction_field(typename S::V r2, typename S::V s, typename S::V over_r, typename S::V charge,
                        const Constants<S>& constants, PairTerms<S>& terms) {
  using V = typename S::V;
  const V field = S::mul(constants.quadratic, r2);
  terms.force = S::madd(S::mul(charge, s), S::sub(over_r, S::add(field, field)), terms.force);
  if constexpr (kSums) {
    const V energy = S::mul(charge, S::add(over_r, S::sub(field, constants.offset)));
    terms.coulomb_energy = S::keep(S::less(S::zero(), s, 0xFFFF, 0), energy);
  }
}

/// S::over_root gives 1/r from these two, and 0 where s is.
/// @param s inverse squared distances, 0 where nothing acts
/// @param charge products of charges
template <class S, bool kSums, ForceKind kKind, class Coefficients>
PairTerms<S> pair_terms(const Coefficients& coefficient, int p, typename S::V r2, typename S::V s,
                        typename S::V charge, const Constants<S>& constants) {
  using V = typename S::V;
  PairTerms<S> terms = lennard_jones_terms < S, kSums || is_switched(kKind) > (coefficient, p, s);
  if constexpr (kSums && !is_switched(kKind) && !Coefficients::kMixes) {
    const V above = S::keep(S::less(S::zero(), s, 0xFFFF, p), coefficient(kEnergyShift, p));
    terms.energy = S::sub(terms.energy, above);
  }
  if constexpr (has_charges(kKind) || is_switched(kKind)) {
    const V over_r = S::over_root(r2, s);
    if constexpr (is_switched(kKind)) switch_off<S>(S::mul(r2, over_r), over_r, constants, terms);
    if constexpr (has_reaction_field(kKind))
      add_reaction_field<S, kSums>(r2, s, over_r, charge, constants, terms);
    if constexpr (has_two_cutoffs(kKind)) {
      const auto is_near = S::less(r2, coefficient(kCutoff2, p), 0xFFFF, p);
      const auto charges_are_near = S::less(r2, coefficient(kCoulombCutoff2, p), 0xFFFF, p);
      const V bare = S::mul(charge, over_r);
      EwaldFactors<S> factors{bare, bare};
      if constexpr (kKind == ForceKind::ewald) {
        const EwaldFactors<S> ewald = ewald_factors<S>(S::mul(constants.splitting, S::mul(r2, over_r)));
        factors = {S::mul(bare, ewald.energy), S::mul(bare, ewald.force)};
      }
      terms.force =
          S::add(S::keep(is_near, terms.force), S::keep(charges_are_near, S::mul(factors.force, s)));
      if constexpr (kSums) {
        terms.energy = S::keep(is_near, terms.energy);
        terms.coulomb_energy = S::keep(charges_are_near, factors.energy);
      }
    }
  }
  return terms;
}

template <class S>
struct RowSums {
  Coordinates<S> force;
  typename S::V energy, coulomb_energy, virial[6];
};

/// Whether forces on clusters J are kept lane by lane, in memory, while rows are computed. Where one register
/// holds all 16 pairs this takes a fused operation for each axis; to sum up over cluster I, which is put off
/// to the end, takes nine more, and shuffles among them.
template <class S>
constexpr bool kWantsLanes = S::kParts == 1;

/// Adds force / r times displacements to an entry's lanes and to what the row has summed up.
template <class S>
void add_to_lanes(typename S::V force, const Coordinates<S>& d, Coordinates<S>& sum,
                  typename S::Real* lanes) {
  static_assert(S::kParts == 1);
  sum.x[0] = S::madd(force, d.x[0], sum.x[0]);
  sum.y[0] = S::madd(force, d.y[0], sum.y[0]);
  sum.z[0] = S::madd(force, d.z[0], sum.z[0]);
  S::store(lanes, S::madd(force, d.x[0], S::load(lanes)));
  S::store(lanes + 16, S::madd(force, d.y[0], S::load(lanes + 16)));
  S::store(lanes + 32, S::madd(force, d.z[0], S::load(lanes + 32)));
}

/// Sums up the lanes of clusters and leaves them 0.
template <class S>
void fold_lanes(const LjTask<typename S::Real>& task, ClusterPairs::Range clusters) {
  for (std::int32_t c = clusters.first; c < clusters.last; ++c) {
    auto* const lanes = task.lanes + kNumbersOfLanes * c;
    Coordinates<S> force;
    force.x[0] = S::load(lanes);
    force.y[0] = S::load(lanes + 16);
    force.z[0] = S::load(lanes + 32);
    S::add_over_i(force, task.force[c]);
    for (int axis = 0; axis < 3; ++axis) S::store(lanes + 16 * axis, S::zero());
  }
}

/// Adds the forces of an entry to those of its cluster J, and to what the row has summed up.
template <class S, LjParameters kParameters, bool kSums, ForceKind kKind>
void apply(const LjTask<typename S::Real>& task, const ClusterPairs::Entry& entry,
           const Separations<S>& separation, PairCoefficients<S, kParameters>& coefficient,
           const RowCharges<S>& charges, const Constants<S>& constants, RowSums<S>& sum) {
  using V = typename S::V;
  coefficient.choose_j(entry.cluster);
  Coordinates<S> force;
  for (int p = 0; p < S::kParts; ++p) {
    const V dx = separation.d.x[p], dy = separation.d.y[p], dz = separation.d.z[p], s = separation.s[p];
    V charge = S::zero();
    if constexpr (has_charges(kKind))
      charge = S::mul(charges.of_i[p], S::repeat(task.charge + 4 * entry.cluster));
    const PairTerms<S> terms =
        pair_terms<S, kSums, kKind>(coefficient, p, separation.r2[p], s, charge, constants);
    // The force on J, which the displacement points to.
    force.x[p] = S::mul(terms.force, dx);
    force.y[p] = S::mul(terms.force, dy);
    force.z[p] = S::mul(terms.force, dz);
    if constexpr (kWantsLanes<S>) {
      add_to_lanes<S>(terms.force, separation.d, sum.force, task.lanes + kNumbersOfLanes * entry.cluster);
    } else {
      sum.force.x[p] = S::add(sum.force.x[p], force.x[p]);
      sum.force.y[p] = S::add(sum.force.y[p], force.y[p]);
      sum.force.z[p] = S::add(sum.force.z[p], force.z[p]);
    }
    if constexpr (kSums) {
      sum.energy = S::add(sum.energy, terms.energy);
      if constexpr (has_charges(kKind)) sum.coulomb_energy = S::add(sum.coulomb_energy, terms.coulomb_energy);
      sum.virial[0] = S::madd(dx, force.x[p], sum.virial[0]);
      sum.virial[1] = S::madd(dy, force.y[p], sum.virial[1]);
      sum.virial[2] = S::madd(dz, force.z[p], sum.virial[2]);
      sum.virial[3] = S::madd(dx, force.y[p], sum.virial[3]);
      sum.virial[4] = S::madd(dx, force.z[p], sum.virial[4]);
      sum.virial[5] = S::madd(dy, force.z[p], sum.virial[5]);
    }
  }
  if constexpr (!kWantsLanes<S>) S::add_over_i(force, task.force[entry.cluster]);
}

/// Separations are measured one entry ahead: the chain of dependent operations through one entry is longer
/// than what a processor can look ahead over.
template <class S, LjParameters kParameters, bool kSums, ForceKind kKind>
void lennard_jones(const LjTask<typename S::Real>& task, LjSums& sums) {
  PairCoefficients<S, kParameters> coefficient(task);
  const Constants<S> constants(task.constants);
  RowCharges<S> charges{};
  for (std::int64_t r = 0; r < task.row_count; ++r) {
    const ClusterPairs::Row row = task.rows[r];
    const Coordinates<S> i = spread<S>(task.at[row.cluster]);
    coefficient.choose_i(row.cluster);
    if constexpr (has_charges(kKind))
      for (int p = 0; p < S::kParts; ++p) charges.of_i[p] = S::spread(task.charge + 4 * row.cluster, p);
    RowSums<S> sum;
    for (int p = 0; p < S::kParts; ++p) sum.force.x[p] = sum.force.y[p] = sum.force.z[p] = S::zero();
    sum.energy = sum.coulomb_energy = S::zero();
    for (auto& v : sum.virial) v = S::zero();
    const ClusterPairs::Entry* entry = task.entries + row.first;
    const ClusterPairs::Entry* const last = task.entries + task.rows[r + 1].first - 1;
    Separations<S> separation = measure<S, kParameters, kKind>(task, row, i, *entry, coefficient);
    for (; entry != last; ++entry) {
      const Separations<S> next = measure<S, kParameters, kKind>(task, row, i, entry[1], coefficient);
      apply<S, kParameters, kSums, kKind>(task, *entry, separation, coefficient, charges, constants, sum);
      separation = next;
    }
    apply<S, kParameters, kSums, kKind>(task, *entry, separation, coefficient, charges, constants, sum);
    S::subtract_over_j(sum.force, task.force[row.cluster]);
    if constexpr (kSums) {
      sums.energy += S::sum(sum.energy);
      if constexpr (has_charges(kKind)) sums.coulomb_energy += S::sum(sum.coulomb_energy);
      for (int k = 0; k < 6; ++k) sums.virial[k] += S::sum(sum.virial[k]);
    }
  }
  if constexpr (kWantsLanes<S>) {
    fold_lanes<S>(task, task.own);
    for (const ClusterPairs::Range& range : task.later) fold_lanes<S>(task, range);
  }
}

template <class S, ForceKind kKind>
constexpr typename LjFunctions<LjTask<typename S::Real>>::OfKind lj_functions_of_kind{
    {{lennard_jones<S, LjParameters::one_type, false, kKind>,
      lennard_jones<S, LjParameters::one_type, true, kKind>},
     {lennard_jones<S, LjParameters::by_type, false, kKind>,
      lennard_jones<S, LjParameters::by_type, true, kKind>},
     {nullptr, nullptr}}};

/// With parameters by particle too.
template <class S, ForceKind kKind>
constexpr typename LjFunctions<LjTask<typename S::Real>>::OfKind lj_functions_that_mix{
    {{lennard_jones<S, LjParameters::one_type, false, kKind>,
      lennard_jones<S, LjParameters::one_type, true, kKind>},
     {lennard_jones<S, LjParameters::by_type, false, kKind>,
      lennard_jones<S, LjParameters::by_type, true, kKind>},
     {lennard_jones<S, LjParameters::by_particle, false, kKind>,
      lennard_jones<S, LjParameters::by_particle, true, kKind>}}};

template <class S>
constexpr LjFunctions<LjTask<typename S::Real>> lj_functions_of{
    {lj_functions_that_mix<S, ForceKind::lennard_jones>, lj_functions_of_kind<S, ForceKind::plain>,
     lj_functions_of_kind<S, ForceKind::ewald>, lj_functions_that_mix<S, ForceKind::reaction_field>,
     lj_functions_that_mix<S, ForceKind::switched>,
     lj_functions_that_mix<S, ForceKind::switched_reaction_field>},
    kWantsLanes<S>};

}  // namespace
}  // namespace dch::detail
