// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

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

/// In the order of detail::LjCoefficients.
std::array<double, 6> coefficients_of(const LennardJonesPair& pair, bool shifted) {
  if (pair.cutoff == 0) return {};
  const double sigma6 = std::pow(pair.sigma, 6), sigma12 = sigma6 * sigma6;
  const double energy12 = 4 * pair.epsilon * sigma12, energy6 = 4 * pair.epsilon * sigma6;
  const double s3 = std::pow(pair.cutoff, -6);
  return {pair.cutoff * pair.cutoff,
          12 * energy12,
          6 * energy6,
          energy12,
          energy6,
          shifted ? s3 * (energy12 * s3 - energy6) : 0};
}

bool fits_single(double v) {
  using Limits = std::numeric_limits<float>;
  return v == 0 || (std::abs(v) >= double{Limits::min()} && std::abs(v) <= double{Limits::max()});
}

template <class Real>
detail::LjCoefficients<Real> pointers_to(const std::array<std::vector<Real>, 6>& tables) {
  return {tables[0].data(), tables[1].data(), tables[2].data(),
          tables[3].data(), tables[4].data(), tables[5].data()};
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
void run(const detail::LjFunctions<Real>& functions, const ClusterPairs& pairs,
         const std::vector<ClusterOfFour<Real>>& at, const std::vector<ClusterShift<Real>>& shift,
         const std::array<std::vector<Real>, 6>& tables, int types, std::vector<ClusterOfFour<Real>>& scratch,
         Span<Vec3> forces, LennardJonesSums* sums) {
  scratch.assign(at.size(), ClusterOfFour<Real>());
  const detail::LjTask<Real> task{pairs.rows.data(),
                                  static_cast<std::int64_t>(pairs.rows.size()) - 1,
                                  pairs.entries.data(),
                                  at.data(),
                                  shift.data(),
                                  pairs.type.data(),
                                  types,
                                  pointers_to(tables),
                                  scratch.data()};
  detail::LjSums found;
  functions.choose(types == 1, sums != nullptr)(task, found);
  add_cluster_forces(pairs, scratch, forces);
  if (!sums) return;
  sums->energy = found.energy;
  std::copy_n(found.virial, 6, sums->virial.begin());
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
      const std::array<double, 6> coefficients = coefficients_of(pair, shifted);
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

void LennardJones::check(const ClusterPairs& pairs, ForcePrecision precision, std::size_t forces) const {
  if (forces != pairs.particles)
    throw InvalidParameter("room for " + std::to_string(forces) + " forces given for " +
                           std::to_string(pairs.particles) + " particles; give one each");
  if (largest_cutoff_ > pairs.list_radius)
    throw InvalidParameter("the Lennard-Jones cutoff " + detail::describe(largest_cutoff_) +
                           " exceeds the radius " + detail::describe(pairs.list_radius) +
                           " of the cluster pairs; make them with a larger one");
  if (types_ > 1 && pairs.types > types_)
    throw InvalidParameter("the cluster pairs have " + std::to_string(pairs.types) +
                           " types, but Lennard-Jones pairs are given for " + std::to_string(types_) +
                           "; give one for each pair of types");
  if (precision == ForcePrecision::mixed && !fits_single_)
    throw InvalidParameter(
        "a Lennard-Jones coefficient is outside 1.2e-38..3.4e38, the range of single precision; use other "
        "units or ForcePrecision::full");
}

void LennardJones::add(const ClusterPairs& pairs, ForcePrecision precision, Span<Vec3> forces,
                       LennardJonesSums* sums) {
  check(pairs, precision, forces.size());
  const detail::ClusterKernels& kernels = detail::cluster_kernels(instruction_set());
  if (pairs.rows.empty()) return;
  if (precision == ForcePrecision::mixed) {
    run(kernels.mixed, pairs, pairs.at_float, pairs.shift_vector_float, mixed_, types_, force_float_, forces,
        sums);
  } else {
    run(kernels.full, pairs, pairs.at, pairs.shift_vector, full_, types_, force_, forces, sums);
  }
}

void LennardJones::add_forces(const ClusterPairs& pairs, ForcePrecision precision, Span<Vec3> forces) {
  add(pairs, precision, forces, nullptr);
}

LennardJonesSums LennardJones::add_forces_and_sum(const ClusterPairs& pairs, ForcePrecision precision,
                                                  Span<Vec3> forces) {
  LennardJonesSums sums;
  add(pairs, precision, forces, &sums);
  return sums;
}

}  // namespace dch
