// SPDX-License-Identifier: MIT
//
// PairPotential over cluster pairs, pairs one by one, weighted pairs and batches.
#include <string>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/forces/pair_potential.hpp>

#include "base/describe.hpp"
#include "cluster_run.hpp"
#include "lj_sums.hpp"
#include "pair_list_run.hpp"
#include "simd/form_kernels.hpp"
#include "style_of.hpp"

namespace dch {
namespace {

template <class Real>
const auto& functions_of(const detail::FormKernels::OfStyle& style) {
  if constexpr (sizeof(Real) == sizeof(float))
    return style.mixed;
  else
    return style.full;
}

detail::LjFunctions<detail::LjPairTask>::Function choose(
    const detail::LjFunctions<detail::LjPairTask>::OfKind& of, int types, detail::Wanted wanted) {
  const auto k = static_cast<std::size_t>(wanted);
  const auto one = of.of_parameters[0][k];
  return types == 1 && one ? one : of.of_parameters[1][k];
}

void check_tallies(std::size_t particles, std::size_t room) {
  if (room != particles)
    throw InvalidParameter("room for " + std::to_string(room) + " tallies given for " +
                           std::to_string(particles) + " particles; give one each");
}

}  // namespace

template <class Pairs>
void PairPotential::check(const Pairs& pairs, std::size_t forces, std::size_t charges) const {
  if (forces != pairs.particles)
    throw InvalidParameter("room for " + std::to_string(forces) + " forces given for " +
                           std::to_string(pairs.particles) + " particles; give one each");
  if (charges != (has_charges() ? pairs.particles : 0))
    throw InvalidParameter(std::to_string(charges) + " charges given for " + std::to_string(pairs.particles) +
                           " particles; give one each where charges act, else none");
  if (largest_cutoff_ > pairs.list_radius)
    throw InvalidParameter("the largest cutoff " + detail::describe(largest_cutoff_) +
                           " exceeds the radius " + detail::describe(pairs.list_radius) +
                           " of the pairs; make them with a larger one");
  if (params_.types > 1 && pairs.types > params_.types)
    throw InvalidParameter("the pairs have " + std::to_string(pairs.types) +
                           " types, but numbers are given for " + std::to_string(params_.types) +
                           "; give them for each pair of types");
}

template <class Real>
void PairPotential::run(const ClusterPairs& pairs, const Tables<Real>& tables,
                        detail::ClusterScratch<Real>& scratch, Span<Vec3> forces, Span<const double> charges,
                        LennardJonesSums* sums, Span<LennardJonesSums> halves) const {
  const auto& kernels = detail::form_kernels(instruction_set());
  const auto& of = functions_of<Real>(detail::style_of(params_));
  const auto with = static_cast<std::size_t>(detail::wanted(sums, halves));
  auto function = of.of_parameters[1][with];
  if (params_.types == 1 && of.of_parameters[0][with]) function = of.of_parameters[0][with];
  if (!half_sigma_.empty() && of.of_parameters[2][with]) function = of.of_parameters[2][with];
  detail::SlotNumbers numbers;
  numbers.charges = charges;
  numbers.charge_unit = charge_unit_;
  numbers.half_sigma_of_type = half_sigma_;
  numbers.root_epsilon_of_type = root_epsilon_;
  const bool wants_lanes =
      sizeof(Real) == sizeof(float) ? kernels.mixed_wants_lanes : kernels.full_wants_lanes;
  const detail::ClusterKernel<Real> kernel{function, wants_lanes, params_.types, detail::pointers_to(tables),
                                           constants<Real>()};
  detail::ClusterRun<Real>(pairs, kernel, numbers, executor_, nullptr, scratch).add(forces, sums, halves);
}

void PairPotential::add(const ClusterPairs& pairs, ForcePrecision precision, Span<Vec3> forces,
                        Span<const double> charges, LennardJonesSums* sums, Span<LennardJonesSums> halves) {
  check(pairs, forces.size(), charges.size());
  if (precision == ForcePrecision::mixed && !fits_single_)
    throw InvalidParameter(
        "a number of the pair potential or a squared cutoff is outside 1.2e-38..3.4e38, or an exponent over "
        "80, the range of single precision; use other units or ForcePrecision::double_precision");
  if (pairs.tasks.size() < 2) return;
  if (precision == ForcePrecision::mixed) {
    run(pairs, mixed_, scratch_float_, forces, charges, sums, halves);
  } else {
    run(pairs, full_, scratch_, forces, charges, sums, halves);
  }
}

void PairPotential::add(const PairList& pairs, Span<const Vec3> positions, const Box& now, Span<Vec3> forces,
                        Span<const double> charges, LennardJonesSums* sums,
                        Span<LennardJonesSums> halves) const {
  check(pairs, forces.size(), charges.size());
  detail::PairListRun run(pairs, positions, now);
  detail::LjPairTask task{pairs.i.data(),
                          pairs.j.data(),
                          0,
                          0,
                          positions.data(),
                          {},
                          run.types(),
                          params_.types,
                          detail::pointers_to(full_),
                          charges.data(),
                          charge_unit_,
                          constants<double>(),
                          forces.data()};
  task.tallies = detail::numbers_of(halves);
  const auto function = choose(detail::style_of(params_).pairs, params_.types, detail::wanted(sums, halves));
  run.add(task, function, sums);
}

void PairPotential::add_weighted(const WeightedPairs& pairs, Span<const Vec3> positions, Span<Vec3> forces,
                                 Span<const double> charges, LennardJonesSums* sums,
                                 Span<LennardJonesSums> halves) const {
  const std::size_t count = pairs.i.size();
  if (pairs.j.size() != count || pairs.at.size() != count || pairs.types.size() != count ||
      pairs.kind.size() != count)
    throw InvalidParameter("weighted pairs have " + std::to_string(count) +
                           " first particles, but not so many of the rest; give each pair all of them");
  if (count == 0) return;
  detail::LjPairTask task{pairs.i.data(),
                          pairs.j.data(),
                          0,
                          static_cast<std::int64_t>(count),
                          positions.data(),
                          {},
                          nullptr,
                          params_.types,
                          detail::pointers_to(full_),
                          charges.data(),
                          charge_unit_,
                          constants<double>(),
                          forces.data()};
  task.at = pairs.at.data();
  task.pair_of_types = pairs.types.data();
  task.kind = pairs.kind.data();
  task.weight = pairs.weight.data();
  task.charge_weight = pairs.charge_weight.data();
  task.tallies = detail::numbers_of(halves);
  detail::LjSums found;
  detail::style_of(params_).weighted[static_cast<std::size_t>(detail::wanted(sums, halves))](task, found);
  if (sums) detail::give(found, *sums);
}

void PairPotential::compute(PairBatch& pairs, const std::array<double, 4>& weight,
                            const std::array<double, 4>& charge_weight) const {
  detail::style_of(params_).batch({detail::pointers_to(full_), constants<double>(), params_.constant,
                                   weight.data(), charge_weight.data()},
                                  pairs);
}

void PairPotential::add_forces(const ClusterPairs& pairs, ForcePrecision precision, Span<Vec3> forces,
                               Span<const double> charges) {
  add(pairs, precision, forces, charges, nullptr, {});
}

LennardJonesSums PairPotential::add_forces_and_sum(const ClusterPairs& pairs, ForcePrecision precision,
                                                   Span<Vec3> forces, Span<const double> charges) {
  LennardJonesSums sums;
  add(pairs, precision, forces, charges, &sums, {});
  return sums;
}

LennardJonesSums PairPotential::add_forces_and_tally(const ClusterPairs& pairs, ForcePrecision precision,
                                                     Span<Vec3> forces, Span<LennardJonesSums> halves,
                                                     Span<const double> charges) {
  check_tallies(pairs.particles, halves.size());
  LennardJonesSums sums;
  add(pairs, precision, forces, charges, &sums, halves);
  return sums;
}

void PairPotential::add_forces(const PairList& pairs, Span<const Vec3> positions, const Box& now,
                               Span<Vec3> forces, Span<const double> charges) const {
  add(pairs, positions, now, forces, charges, nullptr, {});
}

LennardJonesSums PairPotential::add_forces_and_sum(const PairList& pairs, Span<const Vec3> positions,
                                                   const Box& now, Span<Vec3> forces,
                                                   Span<const double> charges) const {
  LennardJonesSums sums;
  add(pairs, positions, now, forces, charges, &sums, {});
  return sums;
}

LennardJonesSums PairPotential::add_forces_and_tally(const PairList& pairs, Span<const Vec3> positions,
                                                     const Box& now, Span<Vec3> forces,
                                                     Span<LennardJonesSums> halves,
                                                     Span<const double> charges) const {
  check_tallies(pairs.particles, halves.size());
  LennardJonesSums sums;
  add(pairs, positions, now, forces, charges, &sums, halves);
  return sums;
}

}  // namespace dch
