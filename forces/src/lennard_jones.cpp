// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/forces/lennard_jones.hpp>

#include "base/describe.hpp"
#include "lj_sums.hpp"
#include "simd/lj_task.hpp"

namespace dch {
namespace {

std::string pair_text(int a, int b) {
  return "Lennard-Jones pair of types " + std::to_string(a) + " and " + std::to_string(b);
}

void check_pair(const LennardJonesPair& pair, int a, int b) {
  if (!std::isfinite(pair.epsilon))
    throw InvalidParameter(pair_text(a, b) + ": epsilon is " + detail::describe(pair.epsilon) +
                           "; it must be finite");
  if (!(std::isfinite(pair.sigma) && pair.sigma >= 0))
    throw InvalidParameter(pair_text(a, b) + ": sigma is " + detail::describe(pair.sigma) +
                           "; it must be finite and not negative");
  if (!(std::isfinite(pair.cutoff) && pair.cutoff >= 0))
    throw InvalidParameter(pair_text(a, b) + ": the cutoff is " + detail::describe(pair.cutoff) +
                           "; it must be finite, and positive or 0 for pairs that do not interact");
}

/// In the order of detail::LjCoefficients; charges come later.
std::array<double, 7> coefficients_of(const LennardJonesPair& pair, bool shifted) {
  if (pair.cutoff == 0) return {};
  const double sigma6 = std::pow(pair.sigma, 6), sigma12 = sigma6 * sigma6;
  const double energy12 = 4 * pair.epsilon * sigma12, energy6 = 4 * pair.epsilon * sigma6;
  const double s3 = std::pow(pair.cutoff, -6);
  return {pair.cutoff * pair.cutoff,
          12 * energy12,
          6 * energy6,
          energy12,
          energy6,
          shifted ? s3 * (energy12 * s3 - energy6) : 0,
          0};
}

}  // namespace

LennardJones::LennardJones(LennardJonesPair pair, bool shifted)
    : LennardJones(1, std::vector<LennardJonesPair>{pair}, shifted) {}

LennardJones::LennardJones(int types, const std::vector<LennardJonesPair>& matrix, bool shifted)
    : types_(types), shifted_(shifted) {
  const auto side = static_cast<std::size_t>(std::max(types, 0));
  if (types < 1 || matrix.size() != side * side)
    throw InvalidParameter(std::to_string(matrix.size()) + " Lennard-Jones pairs given for " +
                           std::to_string(types) + " types; give a matrix of types x types, at least one");
  take_matrix(matrix, shifted);
}

LennardJones::LennardJones(double cutoff, Span<const LennardJonesParticle> particles) : mixes_(true) {
  if (!(std::isfinite(cutoff) && cutoff > 0))
    throw InvalidParameter("the cutoff of Lennard-Jones particles is " + detail::describe(cutoff) +
                           "; it must be finite and positive");
  take_matrix({{0, 0, cutoff}}, false);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const auto refuse = [&](const std::string& what, double value) {
      throw InvalidParameter(what + " of particle " + std::to_string(i) + " is " + detail::describe(value) +
                             "; it must be finite and not negative");
    };
    const LennardJonesParticle& p = particles[i];
    if (!(std::isfinite(p.epsilon) && p.epsilon >= 0)) refuse("epsilon", p.epsilon);
    if (!(std::isfinite(p.sigma) && p.sigma >= 0)) refuse("sigma", p.sigma);
    half_sigma_.push_back(0.5 * p.sigma);
    root_epsilon_.push_back(2 * std::sqrt(p.epsilon));
    fits_single_ = fits_single_ && detail::fits_in_single(half_sigma_.back() * half_sigma_.back()) &&
                   detail::fits_in_single(root_epsilon_.back() * root_epsilon_.back());
  }
}

void LennardJones::take_matrix(const std::vector<LennardJonesPair>& matrix, bool shifted) {
  const auto side = static_cast<std::size_t>(types_);
  for (int a = 0; a < types_; ++a) {
    for (int b = 0; b < types_; ++b) {
      const LennardJonesPair& pair = matrix[static_cast<std::size_t>(a) * side + static_cast<std::size_t>(b)];
      const LennardJonesPair& mirrored =
          matrix[static_cast<std::size_t>(b) * side + static_cast<std::size_t>(a)];
      check_pair(pair, a, b);
      if (pair.epsilon != mirrored.epsilon || pair.sigma != mirrored.sigma || pair.cutoff != mirrored.cutoff)
        throw InvalidParameter(pair_text(a, b) + " differs from that of types " + std::to_string(b) +
                               " and " + std::to_string(a) + "; give a symmetric matrix");
      const std::array<double, 7> coefficients = coefficients_of(pair, shifted);
      for (std::size_t k = 0; k < coefficients.size(); ++k) {
        if (!std::isfinite(coefficients[k]))
          throw InvalidParameter(pair_text(a, b) + ": epsilon " + detail::describe(pair.epsilon) +
                                 " and sigma " + detail::describe(pair.sigma) + " with the cutoff " +
                                 detail::describe(pair.cutoff) +
                                 " overflow double precision; use other units");
        fits_single_ = fits_single_ && detail::fits_in_single(coefficients[k]);
        full_[k].push_back(coefficients[k]);
        mixed_[k].push_back(static_cast<float>(coefficients[k]));
      }
      largest_cutoff_ = std::max(largest_cutoff_, pair.cutoff);
    }
  }
  constexpr std::size_t kMin = detail::kFewTypes * detail::kFewTypes;
  for (auto& table : full_) table.resize(std::max(table.size(), kMin));
  for (auto& table : mixed_) table.resize(std::max(table.size(), kMin));
}

double LennardJones::common_cutoff() const {
  const auto pairs = static_cast<std::ptrdiff_t>(types_) * types_;
  const auto all_are_largest = [&](const std::vector<double>& cutoffs2) {
    return std::all_of(cutoffs2.begin(), cutoffs2.begin() + pairs,
                       [&](double cutoff2) { return cutoff2 == largest_cutoff_ * largest_cutoff_; });
  };
  const bool same = all_are_largest(full_.front()) && (!has_charges_ || all_are_largest(full_.back()));
  return same ? largest_cutoff_ : 0;
}

void LennardJones::set_switch(double from) {
  const double cutoff = common_cutoff();
  if (cutoff == 0)
    throw InvalidParameter(
        "a switching function was asked for, but cutoffs differ; give all pairs and charges the same");
  if (!(from >= 0 && from < cutoff))
    throw InvalidParameter("the switching function begins at " + detail::describe(from) +
                           "; it must be at least 0 and below the cutoff " + detail::describe(cutoff));
  if (splitting_ > 0 && !has_series_)
    throw InvalidParameter(
        "a switching function beside an Ewald sum without series is not available; drop either or set "
        "by_series");
  if (has_dispersion_)
    throw InvalidParameter("a switching function beside a lattice sum of dispersion is not available");
  if (shifted_)
    throw InvalidParameter("a switched energy is 0 at the cutoff by itself; do not have it shifted");
  switch_from_ = from;
}

void LennardJones::set_coulomb(const CoulombTerm& term) {
  const auto refuse = [](const std::string& what, double value) {
    throw InvalidParameter("the " + what + " of Coulomb forces is " + detail::describe(value) +
                           "; it must be finite and not negative");
  };
  if (!(std::isfinite(term.constant) && term.constant >= 0)) refuse("constant", term.constant);
  if (!(std::isfinite(term.splitting) && term.splitting >= 0)) refuse("splitting parameter", term.splitting);
  if (!std::isfinite(term.quadratic) || !std::isfinite(term.offset))
    throw InvalidParameter("the reaction field's numbers are " + detail::describe(term.quadratic) + " and " +
                           detail::describe(term.offset) + "; they must be finite");
  const auto side = static_cast<std::size_t>(types_);
  if (term.cutoffs.size() != side * side)
    throw InvalidParameter(std::to_string(term.cutoffs.size()) + " Coulomb cutoffs given for " +
                           std::to_string(types_) + " types; give a matrix of types x types");
  for (std::size_t a = 0; a < side; ++a) {
    for (std::size_t b = 0; b < side; ++b) {
      const double cutoff = term.cutoffs[a * side + b];
      if (!(std::isfinite(cutoff) && cutoff >= 0)) refuse("cutoff", cutoff);
      if (cutoff != term.cutoffs[b * side + a])
        throw InvalidParameter(
            "the Coulomb cutoff of types " + std::to_string(a) + " and " + std::to_string(b) +
            " differs from that of the same types in the other order; give a symmetric matrix");
      fits_single_ = fits_single_ && detail::fits_in_single(cutoff * cutoff);
      full_.back()[a * side + b] = cutoff * cutoff;
      mixed_.back()[a * side + b] = static_cast<float>(cutoff * cutoff);
      largest_cutoff_ = std::max(largest_cutoff_, cutoff);
    }
  }
  has_charges_ = true;
  check_coulomb_kind(term);
  make_series(term);
  has_reaction_field_ = term.quadratic != 0 || term.offset != 0;
  charge_unit_ = std::sqrt(term.constant);
  splitting_ = term.splitting;
  quadratic_ = term.quadratic;
  offset_ = term.offset;
}

void LennardJones::check_coulomb_kind(const CoulombTerm& term) const {
  const bool has_field = term.quadratic != 0 || term.offset != 0;
  if (has_field && term.splitting > 0)
    throw InvalidParameter("a reaction field beside an Ewald sum (splitting parameter " +
                           detail::describe(term.splitting) + ") means nothing; drop either");
  const bool is_special = mixes_ || switch_from_ >= 0, is_series = term.splitting > 0 && term.by_series;
  if (is_special && term.splitting > 0 && !term.by_series)
    throw InvalidParameter("an Ewald sum (splitting parameter " + detail::describe(term.splitting) +
                           ") with parameters of particles or a switch is to be had with by_series only");
  if ((has_field || is_special || is_series) && common_cutoff() == 0)
    throw InvalidParameter(
        "with a reaction field, a series, parameters of particles or a switch all cutoffs have to be the "
        "same, those of charges too; the largest is " +
        detail::describe(largest_cutoff_));
}

detail::ForceKind LennardJones::kind() const {
  using detail::ForceKind;
  const bool is_switched = switch_from_ >= 0;
  if (!has_charges_) return is_switched ? ForceKind::switched : ForceKind::lennard_jones;
  if (has_dispersion_) return ForceKind::ewald_dispersion;
  if (splitting_ > 0 && is_switched) return ForceKind::switched_ewald;
  if (splitting_ > 0) return has_series_ ? ForceKind::ewald_series : ForceKind::ewald;
  // Bare charges are those in a reaction field of strength 0.
  if (is_switched) return ForceKind::switched_reaction_field;
  return has_reaction_field_ || mixes_ ? ForceKind::reaction_field : ForceKind::plain;
}

detail::LjParameters LennardJones::parameters() const {
  using detail::LjParameters;
  if (mixes_) return LjParameters::by_particle;
  return types_ == 1 ? LjParameters::one_type : LjParameters::by_type;
}

template <class Real>
detail::LjConstants<Real> LennardJones::constants() const {
  const double width = largest_cutoff_ - switch_from_;
  detail::LjConstants<Real> all{static_cast<Real>(splitting_), static_cast<Real>(quadratic_),
                                static_cast<Real>(offset_), static_cast<Real>(switch_from_),
                                static_cast<Real>(switch_from_ >= 0 ? 1 / width : 0)};
  if (!has_series_) return all;
  constexpr bool kSingle = sizeof(Real) == 4;
  all.series_scale = static_cast<Real>(2 / (largest_cutoff_ * largest_cutoff_));
  for (std::size_t k = 0; k < std::size_t{detail::kEwaldTerms<Real>}; ++k) {
    all.ewald_force[k] = static_cast<Real>((kSingle ? force_series_single_ : force_series_)[k]);
    all.ewald_energy[k] = static_cast<Real>((kSingle ? energy_series_single_ : energy_series_)[k]);
  }
  if (!has_dispersion_) return all;
  all.over_cutoff2 = static_cast<Real>(1 / (largest_cutoff_ * largest_cutoff_));
  for (std::size_t k = 0; k < std::size_t{detail::kEwaldTerms<Real>}; ++k) {
    all.dispersion_force[k] = static_cast<Real>((kSingle ? dispersion_force_single_ : dispersion_force_)[k]);
    all.dispersion_energy[k] =
        static_cast<Real>((kSingle ? dispersion_energy_single_ : dispersion_energy_)[k]);
  }
  return all;
}

template detail::LjConstants<double> LennardJones::constants() const;
template detail::LjConstants<float> LennardJones::constants() const;

template <class Pairs>
void LennardJones::check(const Pairs& pairs, std::size_t forces, std::size_t charges) const {
  if (forces != pairs.particles)
    throw InvalidParameter("room for " + std::to_string(forces) + " forces given for " +
                           std::to_string(pairs.particles) + " particles; give one each");
  if (charges != (has_charges_ ? pairs.particles : 0))
    throw InvalidParameter(
        std::to_string(charges) + " charges given for " + std::to_string(pairs.particles) +
        " particles; give " +
        (has_charges_ ? "one each" : "none, or say first with set_coulomb() how they act"));
  if (largest_cutoff_ > pairs.list_radius)
    throw InvalidParameter("the largest cutoff " + detail::describe(largest_cutoff_) +
                           " exceeds the radius " + detail::describe(pairs.list_radius) +
                           " of the pairs; make them with a larger one");
  if (types_ > 1 && pairs.types > types_)
    throw InvalidParameter("the pairs have " + std::to_string(pairs.types) +
                           " types, but Lennard-Jones pairs are given for " + std::to_string(types_) +
                           "; give one for each pair of types");
  if (has_dispersion_ && dispersion_.size() != pairs.particles)
    throw InvalidParameter(std::to_string(dispersion_.size()) +
                           " coefficients of dispersion given for pairs of " +
                           std::to_string(pairs.particles) + " particles; give one each");
  if (mixes_ && half_sigma_.size() != pairs.particles)
    throw InvalidParameter("Lennard-Jones parameters of " + std::to_string(half_sigma_.size()) +
                           " particles given for pairs of " + std::to_string(pairs.particles) +
                           " particles; give one each");
}

template void LennardJones::check(const ClusterPairs&, std::size_t, std::size_t) const;
template void LennardJones::check(const PairList&, std::size_t, std::size_t) const;

}  // namespace dch
