// SPDX-License-Identifier: MIT
//
// Energies of PairPotential, written once more and differentiated number by number.
#pragma once

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include <dch/forces/pair_potential.hpp>
#include <dch/geometry/box.hpp>
#include <dch/lists/list_params.hpp>

#include "colloid_oracle.hpp"
#include "dual.hpp"
#include "list_params.hpp"
#include "lj_oracle.hpp"
#include "scenes.hpp"
#include "table_oracle.hpp"

namespace dch::forms {

inline Dual lennard_jones(const std::array<double, 4>& n, Dual r) {
  const Dual s = n[1] / r, s6 = s * s * s * s * s * s;
  return 4 * n[0] * (s6 * s6 - s6);
}

constexpr bool is_switched(PairForm form) {
  return form == PairForm::charmm || form == PairForm::charmm_force;
}

/// 1 up to `from`, 0 at `to`.
inline Dual switched(Dual r, double from, double to) {
  if (r.value < from) return 1;
  const double f = from * from, t = to * to;
  const Dual x = r * r, left = t - x;
  return left * left * (t + 2 * x - 3 * f) / ((t - f) * (t - f) * (t - f));
}

/// Energy of Lennard-Jones whose terms 1/r^2n, n = 6 and 3, end at `to` with slope 0.
inline double force_switched(const std::array<double, 4>& n, double r, double from, double to) {
  const auto term = [&](int power) {
    const double at_r = std::pow(r, -power), end = std::pow(to, -power);
    if (r < from) return at_r * at_r - std::pow(from, -power) * end;
    return (at_r - end) * (at_r - end) / (1 - std::pow(from / to, power));
  };
  const double sigma6 = std::pow(n[1], 6);
  return 4 * n[0] * sigma6 * (sigma6 * term(6) - term(3));
}

inline Dual energy_of_form(const PairPotentialParams& all, const FormPair& pair, Dual r) {
  const auto& n = pair.numbers;
  const Dual r6 = r * r * r * r * r * r;
  switch (all.form) {
    case PairForm::lennard_jones:
      return lennard_jones(n, r);
    case PairForm::charmm:
      return lennard_jones(n, r) * switched(r, all.of_all, pair.cutoff);
    case PairForm::charmm_force:
      return {force_switched(n, r.value, all.of_all, pair.cutoff),
              lennard_jones(n, r).slope * switched(r, all.of_all, pair.cutoff).value};
    case PairForm::expanded:
      return lennard_jones(n, r - n[2]);
    case PairForm::buckingham:
      return n[0] * exp(-1 * r / n[1]) - n[2] / r6;
    case PairForm::morse: {
      const Dual e = exp(-n[1] * (r - n[2]));
      return n[0] * (e * e - 2 * e);
    }
    case PairForm::soft:
      return n[0] * (1 + cos(std::acos(-1.0) / pair.cutoff * r));
    case PairForm::yukawa:
      return n[0] * exp(-all.of_all * r) / r;
    case PairForm::table:
      return tabulated(all.tables[static_cast<std::size_t>(n[0])], r);
    case PairForm::spline:
      return splined(all.tables[static_cast<std::size_t>(n[0])], r);
    case PairForm::colloid:
      return energy_of_colloids(n, r);
  }
  return 0;
}

/// Without the charges.
inline Dual energy_of_charges(const PairPotentialParams& all, const FormPair& pair, double weight, Dual r) {
  const Dual bare = all.constant / r, screened = erfc(all.splitting * r) * bare;
  switch (all.charges) {
    case ChargeForm::none:
      return 0;
    case ChargeForm::bare:
      return weight * bare;
    case ChargeForm::ewald:
      return screened - (1 - weight) * bare;
    case ChargeForm::damped_shifted: {
      const double c = pair.charge_cutoff;
      const Dual end = erfc(all.splitting * Dual{c, 1}) * all.constant / Dual{c, 1};
      return screened - end.value - end.slope * (r - c) - (1 - weight) * bare;
    }
    case ChargeForm::switched: {
      const double factor = switched(r, all.switch_from, pair.charge_cutoff).value;
      return weight * factor * bare;
    }
  }
  return 0;
}

/// Of kinds of pairs, of a form and of charges.
inline constexpr std::array<double, 4> kWeight{1, 0, 0.3, 0.7}, kChargeWeight{1, 0.2, 0, 0.5};

struct Weights {
  double own = 1, charges = 1;
};

/// Points no closer than so much.
inline std::vector<Vec3> points_apart(const Box& box, std::size_t n, double closest) {
  scenes::Random random(91);
  std::vector<Vec3> points;
  for (int trial = 0; trial < 200000 && points.size() < n; ++trial) {
    const Vec3 p = scenes::from_fractional(box, {random.uniform(), random.uniform(), random.uniform()});
    bool fits = true;
    for (const Vec3 q : points) fits = fits && norm2(box.nearest_image(p - q)) > closest * closest;
    if (fits) points.push_back(p);
  }
  return points;
}

struct Scene {
  Box box = Box::orthorhombic({9, 8.5, 9.5});
  std::vector<Vec3> points;
  std::vector<std::int32_t> types;
  std::vector<double> charges;
  explicit Scene(int kinds) {
    points = points_apart(box, 400, 0.85);
    for (std::size_t i = 0; i < points.size(); ++i) {
      types.push_back(static_cast<std::int32_t>(i * i % static_cast<std::size_t>(kinds)));
      charges.push_back(i % 2 == 0 ? 0.8 : -0.7);
    }
  }
};

/// Adds what a pair adds; the displacement is that from i to j.
inline void add(const PairPotentialParams& all, const Scene& scene, std::size_t i, std::size_t j, Vec3 d,
                Weights weights, LennardJonesResult& result) {
  const auto a = static_cast<std::size_t>(scene.types[i]), b = static_cast<std::size_t>(scene.types[j]);
  const FormPair& pair = all.pairs[a * static_cast<std::size_t>(all.types) + b];
  const Dual r{std::sqrt(norm2(d)), 1};
  Dual own = 0, charged = 0;
  if (r.value < pair.cutoff) {
    own = energy_of_form(all, pair, r);
    if (all.shifted && !is_switched(all.form) && all.form != PairForm::soft && all.tables.empty())
      own = own - energy_of_form(all, pair, {pair.cutoff, 1}).value + pair.left_at_cutoff;
    own = weights.own * own;
  }
  if (r.value < pair.charge_cutoff)
    charged = scene.charges[i] * scene.charges[j] * energy_of_charges(all, pair, weights.charges, r);
  const Vec3 f = -(own.slope + charged.slope) / r.value * d;
  result.force[i] = result.force[i] - f;
  result.force[j] = result.force[j] + f;
  result.sums.energy += own.value;
  result.sums.coulomb_energy += charged.value;
  const double virial[6] = {d.x * f.x, d.y * f.y, d.z * f.z, d.x * f.y, d.x * f.z, d.y * f.z};
  for (std::size_t k = 0; k < 6; ++k) result.sums.virial[k] += virial[k];
}

inline LennardJonesResult all_pairs(const PairPotentialParams& all, const Scene& scene) {
  LennardJonesResult result;
  result.force.resize(scene.points.size());
  for (std::size_t i = 0; i < scene.points.size(); ++i)
    for (std::size_t j = i + 1; j < scene.points.size(); ++j)
      add(all, scene, i, j, scene.box.nearest_image(scene.points[j] - scene.points[i]), {}, result);
  return result;
}

/// A potential and how far formula 7.1.26 lets it be from the exact one.
struct Case {
  const char* name;
  PairPotentialParams params;
  double limit;
};

inline PairPotentialParams params(PairForm form, ChargeForm charges, int types, const FormPair& first) {
  PairPotentialParams all;
  all.form = form;
  all.charges = charges;
  all.types = types;
  all.constant = 1.3;
  all.splitting = charges == ChargeForm::ewald || charges == ChargeForm::damped_shifted ? 0.9 : 0;
  all.switch_from = 1.5;
  all.shifted = true;
  for (int a = 0; a < types; ++a)
    for (int b = 0; b < types; ++b) {
      FormPair pair = first;
      pair.numbers[0] *= std::sqrt((1 + 0.1 * a) * (1 + 0.1 * b));
      if (form == PairForm::lennard_jones || is_switched(form)) pair.numbers[1] -= 0.01 * (a + b);
      if (!is_switched(form)) pair.cutoff -= 0.05 * (a + b);
      all.pairs.push_back(pair);
    }
  return all;
}

/// Three tables, in turns for the pairs of types.
inline PairPotentialParams params_with_tables(int types) {
  PairPotentialParams all = params(PairForm::table, ChargeForm::none, types, {{0, 0, 0}, 2.4, 0});
  for (const int length : {150, 2, 97}) {
    PairTable table;
    table.inner = 0.8 - 1e-3 * length;
    table.outer = 2.4 + 1e-3 * length;
    for (int k = 0; k < length; ++k) {
      const double first = table.inner * table.inner, last = table.outer * table.outer;
      const double s = 1 / (first + (last - first) * k / (length - 1)), s3 = s * s * s;
      table.energy.push_back((s3 - 1) * s3 + 0.01 * length);
      table.force_over_r.push_back((11 * s3 - 5) * s3 * s - 0.002 * length);
    }
    all.tables.push_back(table);
  }
  for (int a = 0; a < types; ++a)
    for (int b = 0; b < types; ++b)
      all.pairs[static_cast<std::size_t>(a * types + b)].numbers[0] = (a + b) % 3;
  return all;
}

inline PairPotentialParams params_with_splines(int types) {
  PairPotentialParams all = params_with_tables(types);
  all.form = PairForm::spline;
  for (PairTable& table : all.tables) bend(table);
  return all;
}

inline std::vector<Case> cases() {
  constexpr double kExact = 2e-13, kFormula = 1e-6;
  using F = PairForm;
  using C = ChargeForm;
  std::vector<Case> all;
  const auto take = [&](const char* name, F form, C charges, int types, FormPair pair, double of_all = 0) {
    const bool by_formula = charges == C::ewald || charges == C::damped_shifted;
    all.push_back({name, params(form, charges, types, pair), by_formula ? kFormula : kExact});
    all.back().params.of_all = of_all;
  };
  take("Lennard-Jones", F::lennard_jones, C::none, 2, {{1, 1, 0}, 2.4, 0});
  take("of one type", F::lennard_jones, C::none, 1, {{1, 1, 0}, 2.4, 0});
  take("of six types", F::lennard_jones, C::none, 6, {{1, 1, 0}, 2.4, 0});
  take("with charges", F::lennard_jones, C::bare, 2, {{1, 1, 0}, 2.2, 2.4});
  take("Ewald", F::lennard_jones, C::ewald, 2, {{1, 1, 0}, 2.4, 2.3});
  take("damped", F::lennard_jones, C::damped_shifted, 2, {{1, 1, 0}, 2.2, 2.4});
  take("CHARMM", F::charmm, C::ewald, 2, {{1, 1, 0}, 2.2, 2.4}, 1.7);
  take("CHARMM, mixed by particle", F::charmm, C::ewald, 6, {{1, 1, 0}, 2.4, 2.2}, 1.7);
  take("CHARMM, switched charges", F::charmm, C::switched, 2, {{1, 1, 0}, 2.2, 2.4}, 1.7);
  take("CHARMM, switched charges, mixed", F::charmm, C::switched, 6, {{1, 1, 0}, 2.2, 2.4}, 1.7);
  take("CHARMM, forces switched", F::charmm_force, C::ewald, 2, {{1, 1, 0}, 2.2, 2.4}, 1.7);
  take("CHARMM, forces switched, mixed", F::charmm_force, C::ewald, 6, {{1, 1, 0}, 2.4, 2.2}, 1.7);
  take("CHARMM, forces switched from 0 on", F::charmm_force, C::ewald, 2, {{1, 1, 0}, 2.2, 2.4}, 0);
  for (const int types : {2, 6}) {
    take("CHARMM, forces switched, no charges act", F::charmm_force, C::ewald, types, {{1, 1, 0}, 2.2, 0},
         1.7);
    all.back().limit = kExact;
  }
  take("expanded", F::expanded, C::none, 2, {{1, 0.8, 0.2}, 2.4, 0});
  take("expanded, not shifted to 0", F::expanded, C::none, 2, {{1, 0.8, 0.2}, 2.4, 0, -0.03});
  take("Buckingham", F::buckingham, C::none, 2, {{400, 0.2, 1}, 2.4, 0});
  take("Buckingham, Ewald", F::buckingham, C::ewald, 2, {{400, 0.2, 1}, 2.3, 2.4});
  take("Morse", F::morse, C::none, 2, {{1, 5, 1.1}, 2.4, 0});
  take("soft", F::soft, C::none, 2, {{20, 0, 0}, 2.4, 0});
  take("Yukawa", F::yukawa, C::none, 2, {{10, 0, 0}, 2.4, 0}, 1.2);
  for (const int types : {1, 2, 6}) {
    all.push_back({"tables", params_with_tables(types), kExact});
    all.push_back({"splines", params_with_splines(types), kExact});
  }
  for (const int types : {1, 2, 3, 6}) {
    const PairPotentialParams all_alike = params(F::colloid, C::none, types, {{144, 0.9, 0, 0}, 2.4, 0});
    all.push_back({"colloids", with_diameters(all_alike), kExact});
  }
  return all;
}

inline void expect_near(const LennardJonesSums& sums, const LennardJonesSums& expected, double limit) {
  double scale = std::abs(expected.energy) + std::abs(expected.coulomb_energy);
  for (const double v : expected.virial) scale += std::abs(v);
  EXPECT_NEAR(sums.energy, expected.energy, limit * scale);
  EXPECT_NEAR(sums.coulomb_energy, expected.coulomb_energy, limit * scale);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(sums.virial[k], expected.virial[k], limit * scale) << k;
}

inline std::vector<double> charges_for(const Case& one, const Scene& scene) {
  return one.params.charges == ChargeForm::none ? std::vector<double>{} : scene.charges;
}

inline constexpr double kCutoff = 2.4, kSkin = 0.3;

inline ListParams request_of(const Case& one, const Scene& scene) {
  ListParams request = within_skin(kCutoff, kSkin);
  request.types = scene.types;
  request.cutoffs = TypeCutoffs(one.params.types, std::vector<double>(one.params.pairs.size(), kCutoff));
  return request;
}

}  // namespace dch::forms
