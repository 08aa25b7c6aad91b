// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>

#include <dch/base/error.hpp>
#include <dch/forces/pair_potential.hpp>

#include "base/describe.hpp"
#include "lj_sums.hpp"
#include "simd/form_kernels.hpp"
#include "style_of.hpp"

namespace dch {
namespace {

constexpr double kPi = 3.14159265358979323846;

[[noreturn]] void refuse(const std::string& what, double value, const std::string& limit) {
  throw InvalidParameter("the " + what + " of a pair potential is " + detail::describe(value) +
                         "; it must be " + limit);
}

std::string types_text(std::size_t a, std::size_t b) {
  return " of types " + std::to_string(a) + " and " + std::to_string(b);
}

void check_cutoff(const std::string& what, double cutoff) {
  if (!(std::isfinite(cutoff) && cutoff >= 0)) refuse(what, cutoff, "finite and not negative");
}

/// The numbers of a switch between two distances: of CharmmForm, and of SwitchedCharges.
std::array<double, 3> way_between(double from, double to) {
  if (!(from >= 0 && from < to))
    refuse("switch's beginning", from, "at least 0 and below the cutoff " + detail::describe(to));
  const double width = to * to - from * from;
  return {from * from, to * to, 1 / (width * width * width)};
}

/// The same, and those that CharmmForceForm has besides.
std::array<double, 7> ways_between(double from, double to) {
  const std::array<double, 3> way = way_between(from, to);
  const double from3 = from * from * from, to3 = to * to * to, ratio3 = from3 / to3;
  // Of pairs within a switch that begins so near 0 the last number would not show, and it could overflow.
  return {way[0],
          way[1],
          way[2],
          1 / to3,
          1 / (1 - ratio3 * ratio3),
          1 / (1 - ratio3),
          from > 1e-6 * to ? 1 / (from3 * to3) : 0};
}

}  // namespace

PairPotential::PairPotential(const PairPotentialParams& params) : params_(params) {
  const auto side = static_cast<std::size_t>(std::max(params.types, 0));
  if (params.types < 1 || params.pairs.size() != side * side)
    throw InvalidParameter(std::to_string(params.pairs.size()) + " pairs of types given for " +
                           std::to_string(params.types) + " types; give a matrix of types x types");
  if (detail::style_of(params).batch == nullptr)
    throw InvalidParameter("this form of a pair potential and charges that act so do not go together");
  for (const FormPair& pair : params.pairs) {
    check_cutoff("cutoff", pair.cutoff);
    check_cutoff("cutoff of charges", pair.charge_cutoff);
    largest_cutoff_ = std::max({largest_cutoff_, pair.cutoff, pair.charge_cutoff});
  }
  take_way();
  if (has_charges()) take_charges();
  if (has_tables()) take_tables();
  for (auto& table : full_)
    table.resize(std::max(side * side, std::size_t{detail::kFewTypes * detail::kFewTypes}));
  for (std::size_t a = 0; a < side; ++a)
    for (std::size_t b = 0; b < side; ++b) take_pair(a, b);
  for (std::size_t k = 0; k < full_.size(); ++k)
    for (const double number : full_[k]) {
      fits_single_ = fits_single_ && detail::fits_in_single(number);
      mixed_[k].push_back(static_cast<float>(number));
    }
  find_mixing();
  params_.tables.clear();  // which stand in knots_ now
}

/// What the form has for all pairs.
void PairPotential::take_way() {
  if (!std::isfinite(params_.of_all)) refuse("number for all pairs", params_.of_all, "finite");
  of_form_[0] = params_.of_all;
  if (params_.form != PairForm::charmm && params_.form != PairForm::charmm_force) return;
  double cutoff = 0;
  for (const FormPair& pair : params_.pairs) cutoff = std::max(cutoff, pair.cutoff);
  for (const FormPair& pair : params_.pairs)
    if (pair.cutoff != 0 && pair.cutoff != cutoff)
      refuse("cutoff", pair.cutoff, "0 or the same for all pairs where they are switched off");
  if (cutoff > 0) of_form_ = ways_between(params_.of_all, cutoff);
}

void PairPotential::take_charges() {
  if (!(std::isfinite(params_.constant) && params_.constant >= 0))
    refuse("constant of charges", params_.constant, "finite and not negative");
  if (!(std::isfinite(params_.splitting) && params_.splitting >= 0))
    refuse("splitting parameter", params_.splitting, "finite and not negative");
  charge_unit_ = std::sqrt(params_.constant);
  if (params_.charges == ChargeForm::bare || params_.charges == ChargeForm::ewald) return;
  double cutoff = 0;
  for (const FormPair& pair : params_.pairs) cutoff = std::max(cutoff, pair.charge_cutoff);
  for (const FormPair& pair : params_.pairs)
    if (pair.charge_cutoff != 0 && pair.charge_cutoff != cutoff)
      refuse("cutoff of charges", pair.charge_cutoff, "0 or the same for all pairs, for charges that end so");
  if (cutoff == 0) return;
  if (params_.charges == ChargeForm::switched) {
    of_charges_ = way_between(params_.switch_from, cutoff);
    return;
  }
  const double x = params_.splitting * cutoff, root_pi = std::sqrt(kPi);
  const double force =
      -(std::erfc(x) / (cutoff * cutoff) + 2 / root_pi * params_.splitting * std::exp(-x * x) / cutoff);
  const double energy = std::erfc(x) / cutoff - force * cutoff;
  of_charges_ = {force, energy, 0};
  self_energy_ = -(energy / 2 + params_.splitting / root_pi) * params_.constant;
}

void PairPotential::take_pair(std::size_t a, std::size_t b) {
  const auto side = static_cast<std::size_t>(params_.types);
  const std::size_t k = a * side + b;
  const FormPair &pair = params_.pairs[k], &mirrored = params_.pairs[b * side + a];
  const auto& style = detail::style_of(params_);
  for (const double number : pair.numbers)
    if (!std::isfinite(number)) refuse("number" + types_text(a, b), number, "finite");
  if (!std::isfinite(pair.left_at_cutoff))
    refuse("energy left at the cutoff" + types_text(a, b), pair.left_at_cutoff, "finite");
  if (pair.cutoff != mirrored.cutoff || pair.charge_cutoff != mirrored.charge_cutoff ||
      pair.numbers != mirrored.numbers || pair.left_at_cutoff != mirrored.left_at_cutoff)
    throw InvalidParameter("the pair" + types_text(a, b) +
                           " differs from the same in the other order; give a " + "symmetric matrix");
  if (params_.form == PairForm::colloid)
    for (const double diameter : {pair.numbers[2], pair.numbers[3]})
      if (!(diameter >= 0)) refuse("diameter" + types_text(a, b), diameter, "at least 0");
  full_.front()[k] = pair.cutoff * pair.cutoff;
  full_.back()[k] = pair.charge_cutoff * pair.charge_cutoff;
  if (pair.cutoff == 0) return;
  double numbers[4]{};
  const std::array<double, 4> given = given_to_form(pair);
  const double exponent = style.prepare(given.data(), pair.cutoff, numbers);
  for (std::size_t n = 0; n < 4; ++n) {
    if (!std::isfinite(numbers[n]))
      throw InvalidParameter("the numbers" + types_text(a, b) +
                             " overflow double precision; use other units");
    full_[1 + n][k] = numbers[n];
  }
  if (!(exponent <= 700)) refuse("exponent at no distance" + types_text(a, b), exponent, "at most 700");
  fits_single_ = fits_single_ && exponent <= 80;
  if (params_.shifted && style.has_shift) full_[5][k] = energy_at(k, pair.cutoff) - pair.left_at_cutoff;
}

/// By the form, before it is shifted.
double PairPotential::energy_at(std::size_t k, double r) const {
  const double beyond = 2 * r * r, none = 0;
  const double one[4] = {1, 1, 1, 1};
  PairBatch batch;
  batch.r2[0] = r * r;
  detail::style_of(params_).batch(
      {{&beyond, &full_[1][k], &full_[2][k], &full_[3][k], &full_[4][k], &none, &none},
       constants<double>(),
       0,
       one,
       one},
      batch);
  return batch.energy[0];
}

/// Whether all pairs are mixed from those of equal types, by the rules of Lorentz and Berthelot: then two
/// numbers by particle serve where tables are too large for registers.
void PairPotential::find_mixing() {
  const int types = params_.types;
  if (types <= detail::kFewTypes || detail::style_of(params_).full.of_parameters[2][0] == nullptr) return;
  const auto side = static_cast<std::size_t>(types);
  const auto at = [&](std::size_t a, std::size_t b) -> const FormPair& {
    return params_.pairs[a * side + b];
  };
  const auto is_near = [](double a, double b) {
    return std::abs(a - b) <= 1e-14 * std::max(std::abs(a), std::abs(b));
  };
  for (std::size_t a = 0; a < side; ++a) {
    if (!(at(a, a).numbers[0] >= 0 && at(a, a).numbers[1] >= 0)) return;
    for (std::size_t b = 0; b < side; ++b) {
      const bool mixed = is_near(at(a, b).numbers[0], std::sqrt(at(a, a).numbers[0] * at(b, b).numbers[0])) &&
                         (is_near(at(a, b).numbers[1], 0.5 * (at(a, a).numbers[1] + at(b, b).numbers[1])) ||
                          at(a, b).numbers[0] == 0);
      if (!mixed || at(a, b).cutoff != at(0, 0).cutoff || at(a, b).charge_cutoff != at(0, 0).charge_cutoff)
        return;
    }
  }
  if (at(0, 0).cutoff == 0) return;
  for (std::size_t a = 0; a < side; ++a) {
    half_sigma_.push_back(0.5 * at(a, a).numbers[1]);
    root_epsilon_.push_back(2 * std::sqrt(at(a, a).numbers[0]));
    fits_single_ = fits_single_ && detail::fits_in_single(half_sigma_.back() * half_sigma_.back()) &&
                   detail::fits_in_single(root_epsilon_.back() * root_epsilon_.back());
  }
}

template <class Real>
detail::LjConstants<Real> PairPotential::constants() const {
  detail::LjConstants<Real> all;
  all.splitting = static_cast<Real>(params_.splitting);
  for (std::size_t n = 0; n < of_form_.size(); ++n) all.of_form[n] = static_cast<Real>(of_form_[n]);
  for (std::size_t n = 0; n < of_charges_.size(); ++n) all.of_charges[n] = static_cast<Real>(of_charges_[n]);
  const auto take = [&](const auto& knots) {
    all.table_force = knots.force.data();
    all.table_energy = knots.energy.data();
  };
  if constexpr (std::is_same_v<Real, float>)
    take(knots_float_);
  else
    take(knots_);
  return all;
}

template detail::LjConstants<double> PairPotential::constants() const;
template detail::LjConstants<float> PairPotential::constants() const;

}  // namespace dch
