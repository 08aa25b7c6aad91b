// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

#include <dch/error.hpp>
#include <dch/lennard_jones.hpp>

#include "describe.hpp"
#include "simd/cluster_kernels.hpp"

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

bool fits_single(double v) {
  using Limits = std::numeric_limits<float>;
  return v == 0 || (std::abs(v) >= double{Limits::min()} && std::abs(v) <= double{Limits::max()});
}

template <class Real>
detail::LjCoefficients<Real> pointers_to(const std::array<std::vector<Real>, 7>& tables) {
  return {tables[0].data(), tables[1].data(), tables[2].data(), tables[3].data(),
          tables[4].data(), tables[5].data(), tables[6].data()};
}

template <class Real>
void add_cluster_forces(const ClusterPairs& pairs, const std::vector<ClusterOfFour<Real>>& cluster_forces,
                        Span<Vec3> forces) {
  for (std::size_t c = 0; c < cluster_forces.size(); ++c) {
    const ClusterOfFour<Real>& force = cluster_forces[c];
    for (std::size_t slot = 0; slot < ClusterPairs::kSlots; ++slot) {
      const std::int32_t i = pairs.particle[c * ClusterPairs::kSlots + slot];
      if (i < 0) continue;
      Vec3& to = forces[static_cast<std::size_t>(i)];
      to = to + Vec3{double{force.x[slot]}, double{force.y[slot]}, double{force.z[slot]}};
    }
  }
}

template <class Real>
struct Kernels;

template <>
struct Kernels<double> {
  static const auto& functions(const detail::ClusterKernels& kernels) { return kernels.full; }
  static const auto& at(const ClusterPairs& pairs) { return pairs.at; }
  static const auto& shift(const ClusterPairs& pairs) { return pairs.shift_vector; }
};

template <>
struct Kernels<float> {
  static const auto& functions(const detail::ClusterKernels& kernels) { return kernels.mixed; }
  static const auto& at(const ClusterPairs& pairs) { return pairs.at_float; }
  static const auto& shift(const ClusterPairs& pairs) { return pairs.shift_vector_float; }
};

detail::CoulombKind coulomb_kind(bool has_charges, double splitting) {
  if (!has_charges) return detail::CoulombKind::none;
  return splitting > 0 ? detail::CoulombKind::ewald : detail::CoulombKind::plain;
}

void give(const detail::LjSums& found, LennardJonesSums* sums) {
  if (!sums) return;
  sums->energy = found.energy;
  sums->coulomb_energy = found.coulomb_energy;
  std::copy_n(found.virial, 6, sums->virial.begin());
}

template <class FourCharges>
void sort_by_slot(const ClusterPairs& pairs, Span<const double> charges, double unit,
                  std::vector<FourCharges>& slots) {
  slots.resize(static_cast<std::size_t>(pairs.clusters()));
  for (std::size_t c = 0; c < slots.size(); ++c) {
    for (std::size_t slot = 0; slot < ClusterPairs::kSlots; ++slot) {
      const std::int32_t i = pairs.particle[c * ClusterPairs::kSlots + slot];
      auto& q = slots[c].q[slot];
      q = i < 0 ? 0 : static_cast<std::decay_t<decltype(q)>>(unit * charges[static_cast<std::size_t>(i)]);
    }
  }
}

}  // namespace

LennardJones::LennardJones(LennardJonesPair pair, bool shifted)
    : LennardJones(1, std::vector<LennardJonesPair>{pair}, shifted) {}

LennardJones::LennardJones(int types, const std::vector<LennardJonesPair>& matrix, bool shifted)
    : types_(types) {
  const auto side = static_cast<std::size_t>(std::max(types, 0));
  if (types < 1 || matrix.size() != side * side)
    throw InvalidParameter(std::to_string(matrix.size()) + " Lennard-Jones pairs given for " +
                           std::to_string(types) + " types; give a matrix of types x types, at least one");
  for (int a = 0; a < types; ++a) {
    for (int b = 0; b < types; ++b) {
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
        fits_single_ = fits_single_ && fits_single(coefficients[k]);
        full_[k].push_back(coefficients[k]);
        mixed_[k].push_back(static_cast<float>(coefficients[k]));
      }
      largest_cutoff_ = std::max(largest_cutoff_, pair.cutoff);
    }
  }
  constexpr std::size_t kLeast = detail::kFewTypes * detail::kFewTypes;
  for (auto& table : full_) table.resize(std::max(table.size(), kLeast));
  for (auto& table : mixed_) table.resize(std::max(table.size(), kLeast));
}

void LennardJones::set_coulomb(const CoulombTerm& term) {
  const auto refuse = [](const std::string& what, double value) {
    throw InvalidParameter("the " + what + " of Coulomb forces is " + detail::describe(value) +
                           "; it must be finite and not negative");
  };
  if (!(std::isfinite(term.constant) && term.constant >= 0)) refuse("constant", term.constant);
  if (!(std::isfinite(term.splitting) && term.splitting >= 0)) refuse("splitting parameter", term.splitting);
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
      fits_single_ = fits_single_ && fits_single(cutoff * cutoff);
      full_.back()[a * side + b] = cutoff * cutoff;
      mixed_.back()[a * side + b] = static_cast<float>(cutoff * cutoff);
      largest_cutoff_ = std::max(largest_cutoff_, cutoff);
    }
  }
  has_charges_ = true;
  charge_unit_ = std::sqrt(term.constant);
  splitting_ = term.splitting;
}

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
}

template <class Real>
void LennardJones::run(const ClusterPairs& pairs, Span<const double> charges, const Tables<Real>& tables,
                       Scratch<Real>& scratch, Span<Vec3> forces, LennardJonesSums* sums) const {
  using Of = Kernels<Real>;
  scratch.force.assign(Of::at(pairs).size(), ClusterOfFour<Real>());
  if (has_charges_) sort_by_slot(pairs, charges, charge_unit_, scratch.charge);
  const detail::LjTask<Real> task{pairs.rows.data(),
                                  static_cast<std::int64_t>(pairs.rows.size()) - 1,
                                  pairs.entries.data(),
                                  Of::at(pairs).data(),
                                  Of::shift(pairs).data(),
                                  pairs.type.data(),
                                  types_,
                                  pointers_to(tables),
                                  has_charges_ ? scratch.charge.data()->q : nullptr,
                                  static_cast<Real>(splitting_),
                                  scratch.force.data()};
  detail::LjSums found;
  const auto kind = coulomb_kind(has_charges_, splitting_);
  Of::functions(detail::cluster_kernels(instruction_set()))
      .choose(kind, types_ == 1, sums != nullptr)(task, found);
  add_cluster_forces(pairs, scratch.force, forces);
  give(found, sums);
}

void LennardJones::add(const ClusterPairs& pairs, ForcePrecision precision, Span<Vec3> forces,
                       Span<const double> charges, LennardJonesSums* sums) {
  check(pairs, forces.size(), charges.size());
  if (precision == ForcePrecision::mixed && !fits_single_)
    throw InvalidParameter(
        "a coefficient or squared cutoff is outside 1.2e-38..3.4e38, the range of single precision; use "
        "other "
        "units or ForcePrecision::full");
  if (pairs.rows.empty()) return;
  if (precision == ForcePrecision::mixed) {
    run(pairs, charges, mixed_, scratch_float_, forces, sums);
  } else {
    run(pairs, charges, full_, scratch_, forces, sums);
  }
}

void LennardJones::add_forces(const ClusterPairs& pairs, ForcePrecision precision, Span<Vec3> forces,
                              Span<const double> charges) {
  add(pairs, precision, forces, charges, nullptr);
}

LennardJonesSums LennardJones::add_forces_and_sum(const ClusterPairs& pairs, ForcePrecision precision,
                                                  Span<Vec3> forces, Span<const double> charges) {
  LennardJonesSums sums;
  add(pairs, precision, forces, charges, &sums);
  return sums;
}

void LennardJones::add(const PairList& pairs, Span<const Vec3> positions, const Box& now, Span<Vec3> forces,
                       Span<const double> charges, LennardJonesSums* sums) const {
  check(pairs, forces.size(), charges.size());
  if (positions.size() != pairs.particles)
    throw InvalidParameter(std::to_string(positions.size()) + " positions given for a pair list of " +
                           std::to_string(pairs.particles) +
                           " particles; make the list anew for another number");
  if (!same_periodicity(now, pairs.box))
    throw InvalidBox("a pair list made in the box " + pairs.box.description() + " was used in the box " +
                     now.description() + "; make it anew for another periodicity");
  const auto function =
      detail::cluster_kernels(instruction_set())
          .pairs.choose(coulomb_kind(has_charges_, splitting_), types_ == 1, sums != nullptr);
  // Pairs without types are all of type 0, as in clusters.
  std::vector<std::int32_t> none;
  if (types_ > 1 && pairs.type.empty()) none.assign(pairs.particles, 0);
  detail::LjPairTask task{pairs.i.data(),
                          pairs.j.data(),
                          0,
                          0,
                          positions.data(),
                          {},
                          none.empty() ? pairs.type.data() : none.data(),
                          types_,
                          pointers_to(full_),
                          charges.data(),
                          charge_unit_,
                          splitting_,
                          forces.data()};
  detail::LjSums found;
  for (std::size_t g = 0; g + 1 < pairs.groups.size(); ++g) {
    task.first = pairs.groups[g].first;
    task.last = pairs.groups[g + 1].first;
    task.shift = pairs.shift(pairs.groups[g], now);
    if (task.first < task.last) function(task, found);
  }
  give(found, sums);
}

void LennardJones::add_forces(const PairList& pairs, Span<const Vec3> positions, const Box& now,
                              Span<Vec3> forces, Span<const double> charges) const {
  add(pairs, positions, now, forces, charges, nullptr);
}

LennardJonesSums LennardJones::add_forces_and_sum(const PairList& pairs, Span<const Vec3> positions,
                                                  const Box& now, Span<Vec3> forces,
                                                  Span<const double> charges) const {
  LennardJonesSums sums;
  add(pairs, positions, now, forces, charges, &sums);
  return sums;
}

}  // namespace dch
