// SPDX-License-Identifier: MIT
//
// The terms of LennardJones that are series: Ewald sums of charges and of dispersion.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/forces/lennard_jones.hpp>

#include "base/describe.hpp"
#include "ewald_series.hpp"
#include "lj_sums.hpp"

namespace dch {

void LennardJones::make_series(const CoulombTerm& term) {
  if (!(term.splitting > 0 && term.by_series)) {
    has_series_ = false;
    return;
  }
  constexpr double kMaxErrorSingle = 2e-7, kMaxError = 2e-9;
  using detail::kEwaldTerms;
  detail::EwaldSeries exact = detail::make_ewald_series(term.splitting, largest_cutoff_, kEwaldTerms<double>);
  detail::EwaldSeries single = detail::make_ewald_series(term.splitting, largest_cutoff_, kEwaldTerms<float>);
  if (!(exact.error <= kMaxError))
    throw InvalidParameter("the splitting parameter " + detail::describe(term.splitting) +
                           " times the cutoff " + detail::describe(largest_cutoff_) +
                           " is over 6, for which the series has too few terms");
  fits_single_ = fits_single_ && single.error <= kMaxErrorSingle;
  force_series_ = std::move(exact.force);
  energy_series_ = std::move(exact.energy);
  force_series_single_ = std::move(single.force);
  energy_series_single_ = std::move(single.energy);
  has_series_ = true;
}

void LennardJones::check_dispersion(const DispersionTerm& term) const {
  if (!(std::isfinite(term.splitting) && term.splitting > 0))
    throw InvalidParameter("the splitting parameter of dispersion is " + detail::describe(term.splitting) +
                           "; it must be finite and positive");
  for (std::size_t i = 0; i < term.coefficients.size(); ++i)
    if (!std::isfinite(term.coefficients[i]))
      throw InvalidParameter("the coefficient of dispersion of particle " + std::to_string(i) + " is " +
                             detail::describe(term.coefficients[i]) + "; it must be finite");
  if (!has_series_)
    throw InvalidParameter(
        "a lattice sum of dispersion was asked for, but none of charges by a series; call "
        "set_coulomb() with splitting and by_series first");
  if (switch_from_ >= 0)
    throw InvalidParameter("a lattice sum of dispersion beside a switching function is not available");
  if (!mixes_ && !shifted_)
    throw InvalidParameter(
        "a lattice sum of dispersion lowers energies by what they are at the cutoff; have "
        "those of Lennard-Jones pairs shifted too");
}

void LennardJones::set_dispersion(const DispersionTerm& term) {
  check_dispersion(term);
  constexpr double kMaxErrorSingle = 5e-7, kMaxError = 5e-9;
  using detail::kEwaldTerms;
  const double cutoff = largest_cutoff_;
  detail::EwaldSeries exact = detail::make_dispersion_series(term.splitting, cutoff, kEwaldTerms<double>);
  detail::EwaldSeries single = detail::make_dispersion_series(term.splitting, cutoff, kEwaldTerms<float>);
  if (!(exact.error <= kMaxError))
    throw InvalidParameter("the splitting parameter " + detail::describe(term.splitting) +
                           " of dispersion times the cutoff " + detail::describe(cutoff) +
                           " is over 6, for which the series has too few terms");
  dispersion_unit_ = term.splitting * term.splitting * term.splitting;
  fits_single_ = fits_single_ && single.error <= kMaxErrorSingle &&
                 std::all_of(term.coefficients.begin(), term.coefficients.end(), [&](double coefficient) {
                   const double number = dispersion_unit_ * coefficient;
                   return detail::fits_in_single(number * number);
                 });
  dispersion_ = term.coefficients;
  dispersion_force_ = std::move(exact.force);
  dispersion_energy_ = std::move(exact.energy);
  dispersion_force_single_ = std::move(single.force);
  dispersion_energy_single_ = std::move(single.energy);
  has_dispersion_ = true;
}

}  // namespace dch
