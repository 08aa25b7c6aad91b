// SPDX-License-Identifier: MIT
//
// Switched Lennard-Jones forces, charges in a reaction field, what a lattice sum of dispersion leaves and
// parameters mixed from those of particles, on one thread and several, equal those of all pairs in plain
// double.
#include <gtest/gtest.h>

#include <dch/forces/lennard_jones.hpp>

#include "instruction_sets.hpp"
#include "listed_hierarchy.hpp"
#include "lj_oracle.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

constexpr double kGasCutoff = 2.4, kGasSkin = 0.3;

struct Terms {
  double switch_from = -1;  ///< negative: none
  bool has_charges = false;
  double quadratic = 0, offset = 0;
  double splitting = 0;
  double of_dispersion = 0;  ///< splitting
};

/// A gas of particles of several kinds, no two too close to each other, with charges.
struct Gas {
  std::vector<Vec3> points;
  std::vector<LennardJonesParticle> particles;
  std::vector<std::int32_t> kind;
  std::vector<double> charges;
  std::vector<LennardJonesParticle> of_kind;
};

Gas make_gas(const Box& box, std::size_t n, int kinds, std::uint64_t seed) {
  scenes::Random random(seed);
  Gas gas;
  for (int k = 0; k < kinds; ++k) gas.of_kind.push_back({k == 1 ? 0 : 0.5 + 0.1 * k, 0.8 + 0.02 * k});
  for (int trial = 0; trial < 200000 && gas.points.size() < n; ++trial) {
    const Vec3 p = scenes::from_fractional(box, {random.uniform(), random.uniform(), random.uniform()});
    bool fits = true;
    for (const Vec3 q : gas.points) fits = fits && norm2(box.nearest_image(p - q)) > 0.8 * 0.8;
    if (!fits) continue;
    gas.kind.push_back(static_cast<std::int32_t>(gas.points.size()) % kinds);
    gas.particles.push_back(gas.of_kind[static_cast<std::size_t>(gas.kind.back())]);
    gas.charges.push_back(random.uniform(-1, 1));
    gas.points.push_back(p);
  }
  return gas;
}

/// Any number: mixing rules for dispersion are not those of Lennard-Jones.
double coefficient_of(const LennardJonesParticle& p) {
  return 2 * std::pow(p.sigma, 3) * std::sqrt(p.epsilon) + 0.1;
}

double lennard_jones_energy(double sigma, double epsilon, double r) {
  return 4 * epsilon * (std::pow(sigma / r, 12) - std::pow(sigma / r, 6));
}

/// What reciprocal space has of two coefficients of 1.
double far_energy(double splitting, double r) {
  const double y = std::pow(splitting * r, 2);
  return (1 - std::exp(-y) * (1 + y + y * y / 2)) / std::pow(r, 6);
}

/// By the formulas, with a numerical look at nothing but pairs.
LennardJonesResult all_pairs_of(const Gas& gas, const Box& box, const Terms& terms) {
  LennardJonesResult result;
  result.force.resize(gas.points.size());
  for (std::size_t i = 0; i < gas.points.size(); ++i)
    for (std::size_t j = i + 1; j < gas.points.size(); ++j) {
      const Vec3 d = box.nearest_image(gas.points[j] - gas.points[i]);
      const double r = std::sqrt(norm2(d));
      if (r >= kGasCutoff) continue;
      const double sigma = (gas.particles[i].sigma + gas.particles[j].sigma) / 2;
      const double epsilon = std::sqrt(gas.particles[i].epsilon * gas.particles[j].epsilon);
      const double s6 = std::pow(sigma / r, 6);
      double energy = 4 * epsilon * (s6 * s6 - s6), force = 24 * epsilon * (2 * s6 * s6 - s6) / r;
      if (terms.switch_from >= 0 && r > terms.switch_from) {
        const double width = kGasCutoff - terms.switch_from, t = (r - terms.switch_from) / width;
        const double value = 1 - 10 * std::pow(t, 3) + 15 * std::pow(t, 4) - 6 * std::pow(t, 5);
        const double slope = (-30 * std::pow(t, 2) + 60 * std::pow(t, 3) - 30 * std::pow(t, 4)) / width;
        force = value * force - slope * energy;
        energy *= value;
      }
      if (terms.of_dispersion > 0) {
        const double product = coefficient_of(gas.particles[i]) * coefficient_of(gas.particles[j]);
        energy +=
            product * (far_energy(terms.of_dispersion, r) - far_energy(terms.of_dispersion, kGasCutoff));
        energy -= lennard_jones_energy(sigma, epsilon, kGasCutoff);
        const double y = std::pow(terms.of_dispersion * r, 2);
        force += product * 6 * (1 - std::exp(-y) * (1 + y + y * y / 2 + y * y * y / 6)) / std::pow(r, 7);
      }
      result.sums.energy += energy;
      if (terms.has_charges) {
        const double qq = 3.5 * gas.charges[i] * gas.charges[j];
        const double x = terms.splitting * r, gauss = 2 * x * std::exp(-x * x) / std::sqrt(M_PI);
        result.sums.coulomb_energy += qq * (std::erfc(x) / r + terms.quadratic * r * r - terms.offset);
        force += qq * ((std::erfc(x) + gauss) / (r * r) - 2 * terms.quadratic * r);
      }
      const Vec3 f = (force / r) * d;
      result.force[j] = result.force[j] + f;
      result.force[i] = result.force[i] - f;
      const double virial[6] = {d.x * f.x, d.y * f.y, d.z * f.z, d.x * f.y, d.x * f.z, d.y * f.z};
      for (std::size_t k = 0; k < 6; ++k) result.sums.virial[k] += virial[k];
    }
  return result;
}

/// The potential with parameters of particles, or with a table for all pairs of kinds.
LennardJones potential_of(const Gas& gas, const Terms& terms, bool by_particle) {
  const auto side = gas.of_kind.size();
  std::vector<LennardJonesPair> matrix;
  for (const LennardJonesParticle& a : gas.of_kind)
    for (const LennardJonesParticle& b : gas.of_kind)
      matrix.push_back({std::sqrt(a.epsilon * b.epsilon), 0.5 * (a.sigma + b.sigma), kGasCutoff});
  LennardJones potential = by_particle
                               ? LennardJones(kGasCutoff, gas.particles)
                               : LennardJones(static_cast<int>(side), matrix, terms.of_dispersion > 0);
  CoulombTerm coulomb;
  coulomb.constant = 3.5;
  coulomb.cutoffs.assign(by_particle ? 1 : side * side, kGasCutoff);
  coulomb.quadratic = terms.quadratic;
  coulomb.offset = terms.offset;
  coulomb.splitting = terms.splitting;
  coulomb.by_series = true;
  if (terms.has_charges) potential.set_coulomb(coulomb);
  if (terms.switch_from >= 0) potential.set_switch(terms.switch_from);
  DispersionTerm dispersion{terms.of_dispersion, {}};
  for (const LennardJonesParticle& p : gas.particles) dispersion.coefficients.push_back(coefficient_of(p));
  if (terms.of_dispersion > 0) potential.set_dispersion(dispersion);
  return potential;
}

/// @param exact  how far results in double may be off, relative to forces and sums
void expect_equal(const LennardJonesResult& expected, const ClusterPairs& pairs, LennardJones& potential,
                  const std::vector<double>& charges, double exact, const std::string& what) {
  const RestoreInstructionSet restore;
  for (const InstructionSet set : supported_sets())
    for (const ForcePrecision precision : {ForcePrecision::double_precision, ForcePrecision::mixed}) {
      set_instruction_set(set);
      const bool full = precision == ForcePrecision::double_precision;
      if (!full && !potential.fits_single()) continue;
      const std::string where = what + ", " + name(set) + (full ? ", full" : ", mixed");
      std::vector<Vec3> forces(expected.force.size()), once_more(expected.force.size());
      const LennardJonesSums sums = potential.add_forces_and_sum(pairs, precision, forces, charges);
      potential.add_forces(pairs, precision, once_more, charges);
      const double tolerance = full ? exact : 1e-5;
      EXPECT_LT(force_error(forces, expected.force), tolerance) << where;
      EXPECT_LT(force_error(once_more, expected.force), tolerance) << where;
      double scale = std::abs(expected.sums.energy) + std::abs(expected.sums.coulomb_energy);
      for (const double v : expected.sums.virial) scale += std::abs(v);
      EXPECT_NEAR(sums.energy, expected.sums.energy, tolerance * scale) << where;
      EXPECT_NEAR(sums.coulomb_energy, expected.sums.coulomb_energy, tolerance * scale) << where;
      for (std::size_t k = 0; k < 6; ++k)
        EXPECT_NEAR(sums.virial[k], expected.sums.virial[k], tolerance * scale) << where << k;
    }
}

TEST(LennardJonesMixingTest, EqualsAllPairs) {
  const std::vector<Terms> all_terms{
      {-1, false, 0, 0},         {-1, true, 0, 0},           {-1, true, 0.03, 0.5},
      {1.9, false, 0, 0},        {0, true, 0.03, 0.5},       {1.2, true, 0, 0},
      {-1, true, 0, 0, 1.1},     {1.6, true, 0, 0, 0.9},     {-1, true, 0, 0, 1.45},
      {-1, true, 0, 0, 1.8},     {-1, true, 0, 0, 1.1, 0.9}, {-1, true, 0, 0, 0.3, 1.45},
      {-1, true, 0, 0, 1.1, 1.8}};
  for (const Box& box : {Box::none(), Box::triclinic({7, 0, 0}, {1, 7, 0}, {0.5, -1, 7})})
    for (const int kinds : {1, 2, 6}) {
      const Box scatter = box.any_periodic() ? box : Box::orthorhombic({7, 7, 7});
      const Gas gas = make_gas(scatter, 300, kinds, static_cast<std::uint64_t>(kinds));
      HierarchyParams params;
      params.radius = kGasCutoff + kGasSkin;
      ListedHierarchy hierarchy(params);
      hierarchy.build(gas.points, box);
      ListParams request;
      request.skin = kGasSkin;
      const auto side = static_cast<std::size_t>(kinds);
      request.cutoffs = TypeCutoffs(kinds, std::vector<double>(side * side, kGasCutoff));
      request.types = gas.kind;
      ClusterPairs pairs;
      hierarchy.cluster_pairs(request, pairs);
      for (std::size_t t = 0; t < all_terms.size(); ++t) {
        const LennardJonesResult expected = all_pairs_of(gas, box, all_terms[t]);
        for (const bool by_particle : {false, true}) {
          LennardJones potential = potential_of(gas, all_terms[t], by_particle);
          // With 14 terms the series reaches that far.
          EXPECT_EQ(potential.fits_single(),
                    std::max(all_terms[t].splitting, all_terms[t].of_dispersion) * kGasCutoff < 3.6);
          const std::vector<double> charges = all_terms[t].has_charges ? gas.charges : std::vector<double>();
          const std::string what = std::to_string(kinds) + " kinds, terms " + std::to_string(t) +
                                   (by_particle ? ", by particle" : ", by type");
          const double exact = all_terms[t].splitting > 0 ? 1e-12 : 1e-13;
          expect_equal(expected, pairs, potential, charges, exact, what);
          const auto threads = make_thread_pool(3);
          potential.set_executor(threads.get());
          expect_equal(expected, pairs, potential, charges, exact, what + ", three threads");
        }
      }
    }
}

TEST(LennardJonesMixingTest, FewerParticlesThanThreads) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}};
  HierarchyParams params;
  params.radius = 2;
  ListedHierarchy hierarchy(params);
  hierarchy.build(points, Box::none());
  ListParams request;
  request.cutoffs = TypeCutoffs(2);
  ClusterPairs pairs;
  hierarchy.cluster_pairs(request, pairs);
  LennardJones potential({1, 1, 2});
  const auto threads = make_thread_pool(8);
  potential.set_executor(threads.get());
  std::vector<Vec3> forces(2);
  potential.add_forces(pairs, ForcePrecision::double_precision, forces);
  EXPECT_EQ(forces[1].x, 24);
  EXPECT_EQ(forces[0].x, -24);
}

}  // namespace
}  // namespace dch
