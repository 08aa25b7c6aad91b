// SPDX-License-Identifier: MIT
//
// What PairPotential refuses.
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <string>

#include <dch/base/error.hpp>
#include <dch/forces/pair_potential.hpp>

#include "form_oracle.hpp"
#include "listed_hierarchy.hpp"

namespace dch::forms {
namespace {

void expect_refused(const PairPotentialParams& params, const std::string& words) {
  try {
    PairPotential potential(params);
    ADD_FAILURE() << "taken: " << words;
  } catch (const InvalidParameter& e) {
    EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
  }
}

TEST(PairPotential, WrongNumbersAreRefused) {
  const auto changed = [](PairForm form, ChargeForm charges,
                          const std::function<void(PairPotentialParams&)>& change) {
    PairPotentialParams all = params(form, charges, 2, {{1, 1, 1}, 2.2, 2.4});
    all.of_all = 1.7;
    change(all);
    return all;
  };
  using F = PairForm;
  using C = ChargeForm;
  const double nan = std::nan("");
  expect_refused(changed(F::morse, C::ewald, [](auto&) {}), "do not go together");
  expect_refused(changed(F::morse, C::none, [](auto& p) { p.types = 3; }), "give a matrix of types x types");
  expect_refused(changed(F::morse, C::none, [](auto& p) { p.types = 0; }), "give a matrix of types x types");
  expect_refused(changed(F::morse, C::none, [](auto& p) { p.pairs[1].cutoff = 2; }), "symmetric matrix");
  expect_refused(changed(F::morse, C::none, [](auto& p) { p.pairs[0].cutoff = -1; }),
                 "cutoff of a pair potential");
  expect_refused(changed(F::lennard_jones, C::bare, [&](auto& p) { p.pairs[0].charge_cutoff = nan; }),
                 "cutoff of charges");
  expect_refused(changed(F::morse, C::none, [&](auto& p) { p.pairs[0].numbers[1] = nan; }), "must be finite");
  expect_refused(changed(F::expanded, C::none, [&](auto& p) { p.pairs[0].left_at_cutoff = nan; }),
                 "energy left at the cutoff");
  expect_refused(changed(F::expanded, C::none, [](auto& p) { p.pairs[1].left_at_cutoff = 1; }), "symmetric");
  expect_refused(changed(F::morse, C::none,
                         [](auto& p) {
                           p.pairs[0].numbers = {1, 400, 1};
                         }),
                 "at most 700");
  expect_refused(changed(F::lennard_jones, C::none, [](auto& p) { p.pairs[0].numbers[1] = 1e200; }),
                 "overflow double precision");
  expect_refused(changed(F::yukawa, C::none, [&](auto& p) { p.of_all = nan; }), "number for all pairs");
  expect_refused(changed(F::charmm, C::ewald, [](auto& p) { p.pairs[3].cutoff = 2; }),
                 "the same for all pairs");
  expect_refused(changed(F::charmm, C::ewald, [](auto& p) { p.of_all = 2.2; }), "switch's beginning");
  expect_refused(changed(F::charmm_force, C::ewald, [](auto& p) { p.of_all = 2.2; }), "switch's beginning");
  expect_refused(changed(F::charmm_force, C::ewald, [](auto& p) { p.pairs[3].cutoff = 2; }),
                 "the same for all pairs");
  expect_refused(changed(F::charmm_force, C::none, [](auto&) {}), "do not go together");
  expect_refused(changed(F::charmm, C::switched, [](auto& p) { p.switch_from = 2.4; }), "switch's beginning");
  expect_refused(changed(F::charmm, C::switched, [](auto& p) { p.pairs[3].charge_cutoff = 2; }),
                 "for charges that end so");
  expect_refused(changed(F::lennard_jones, C::ewald, [](auto& p) { p.constant = -1; }),
                 "constant of charges");
  expect_refused(changed(F::lennard_jones, C::ewald, [](auto& p) { p.splitting = -1; }),
                 "splitting parameter");
}

TEST(PairPotential, WrongTablesAreRefused) {
  const auto refuse = [](const std::string& words, const std::function<void(PairPotentialParams&)>& change) {
    PairPotentialParams all = params_with_tables(2);
    change(all);
    expect_refused(all, words);
  };
  refuse("none is number 3", [](auto& p) { p.pairs[0].numbers[0] = 3; });
  refuse("none is number -1", [](auto& p) { p.pairs[0].numbers[0] = -1; });
  refuse("none is number 0.5", [](auto& p) { p.pairs[0].numbers[0] = 0.5; });
  refuse("beyond the end of its table", [](auto& p) { p.pairs[0].cutoff = 2.6; });
  refuse("must begin at 0 or more", [](auto& p) { p.tables[1].inner = -0.1; });
  refuse("must begin at 0 or more", [](auto& p) { p.tables[1].inner = std::nan(""); });
  refuse("must begin at 0 or more", [](auto& p) { p.tables[1].outer = p.tables[1].inner; });
  refuse("must begin at 0 or more",
         [](auto& p) { p.tables[1].outer = std::numeric_limits<double>::infinity(); });
  refuse("as many of each, two or more", [](auto& p) { p.tables[1].energy.pop_back(); });
  refuse("as many of each, two or more",
         [](auto& p) { p.tables[1].energy = p.tables[1].force_over_r = {1}; });
  refuse("give finite ones", [](auto& p) { p.tables[1].energy[1] = std::nan(""); });
  refuse("give finite ones", [](auto& p) { p.tables[2].force_over_r[96] = std::nan(""); });
  refuse("too near to its end", [](auto& p) { p.tables[1].inner = std::nextafter(p.tables[1].outer, 0); });
  refuse("give 0 of each", [](auto& p) { p.tables[1].force_bend.push_back(1); });
  refuse("give 0 of each",
         [](auto& p) { p.form = PairForm::table, p.tables = params_with_splines(2).tables; });
  refuse("give 150 of each", [](auto& p) { p.form = PairForm::spline; });
  PairPotentialParams of_all = params_with_tables(2);
  EXPECT_TRUE(PairPotential(of_all).fits_single());
  of_all.tables[2].energy[3] = 1e-60;
  EXPECT_TRUE(PairPotential(of_all).fits_single());
  of_all.tables[2].energy[3] = -1e39;
  EXPECT_FALSE(PairPotential(of_all).fits_single());
}

TEST(PairPotential, WrongSplinesAreRefused) {
  const auto refuse = [](const std::string& words, const std::function<void(PairPotentialParams&)>& change) {
    PairPotentialParams all = params_with_splines(2);
    change(all);
    expect_refused(all, words);
  };
  refuse("149 second derivatives of forces", [](auto& p) { p.tables[0].force_bend.pop_back(); });
  refuse("151 of energies", [](auto& p) { p.tables[0].energy_bend.push_back(1); });
  refuse("give finite ones", [](auto& p) { p.tables[2].energy_bend[96] = std::nan(""); });
  refuse("give finite ones", [](auto& p) { p.tables[1].force_bend[0] = std::nan(""); });
  refuse("overflow double precision", [](auto& p) { p.tables[1].force_bend[0] = -1e308; });
  refuse("none is number 3", [](auto& p) { p.pairs[0].numbers[0] = 3; });
  PairPotentialParams of_all = params_with_splines(2);
  EXPECT_TRUE(PairPotential(of_all).fits_single());
  of_all.tables[1].energy_bend[0] = -1e39;
  EXPECT_FALSE(PairPotential(of_all).fits_single());
}

TEST(PairPotential, WrongArraysAreRefused) {
  const Scene scene(2);
  ListedHierarchy hierarchy = hierarchy_of(scene.points, scene.box, kCutoff + kSkin);
  Case one{"", params(PairForm::lennard_jones, ChargeForm::bare, 2, {{1, 1, 0}, 2.2, 2.4}), 0};
  ClusterPairs pairs;
  hierarchy.cluster_pairs(request_of(one, scene), pairs);
  const auto mixed = ForcePrecision::mixed;
  std::vector<Vec3> forces(scene.points.size()), few(3);
  PairPotential potential(one.params);
  EXPECT_THROW(potential.add_forces(pairs, mixed, few, scene.charges), InvalidParameter);
  EXPECT_THROW(potential.add_forces(pairs, mixed, forces), InvalidParameter);
  std::vector<LennardJonesSums> few_halves(3);
  EXPECT_THROW(potential.add_forces_and_tally(pairs, mixed, forces, few_halves, scene.charges),
               InvalidParameter);
  EXPECT_THROW(
      potential.add_weighted({{}, {}, {}, {}, scene.types}, scene.points, forces, scene.charges, nullptr),
      InvalidParameter);
  one.params.pairs[0].charge_cutoff = 3;
  EXPECT_THROW(PairPotential(one.params).add_forces(pairs, mixed, forces, scene.charges), InvalidParameter);
  PairPotential of_tiny(params(PairForm::lennard_jones, ChargeForm::none, 2, {{1e-30, 0.01, 0}, 2.2, 0}));
  EXPECT_FALSE(of_tiny.fits_single());
  EXPECT_THROW(of_tiny.add_forces(pairs, mixed, forces), InvalidParameter);
  PairPotential of_one(params(PairForm::morse, ChargeForm::none, 1, {{1, 50, 1}, 2.2, 0}));
  EXPECT_FALSE(of_one.fits_single());
}

}  // namespace
}  // namespace dch::forms
