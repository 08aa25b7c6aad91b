// SPDX-License-Identifier: MIT
//
// LennardJones over cluster pairs.
#include <string>

#include <dch/base/error.hpp>
#include <dch/forces/lennard_jones.hpp>

#include "cluster_run.hpp"
#include "lj_sums.hpp"
#include "simd/force_kernels.hpp"

namespace dch {

template <class Real>
void LennardJones::run(const ClusterPairs& pairs, Span<const double> charges, const Tables<Real>& tables,
                       detail::ClusterScratch<Real>& scratch, Span<Vec3> forces,
                       LennardJonesSums* sums) const {
  const auto& kernels = detail::force_kernels(instruction_set());
  const auto& functions = [&]() -> const auto& {
    if constexpr (sizeof(Real) == sizeof(float))
      return kernels.mixed;
    else
      return kernels.full;
  }
  ();
  detail::SlotNumbers numbers;
  numbers.charge_unit = charge_unit_;
  numbers.dispersion_unit = dispersion_unit_;
  if (has_charges_) numbers.charges = charges;
  if (has_dispersion_) numbers.dispersion = {dispersion_.data(), dispersion_.size()};
  if (mixes_) {
    numbers.half_sigma = {half_sigma_.data(), half_sigma_.size()};
    numbers.root_epsilon = {root_epsilon_.data(), root_epsilon_.size()};
  }
  const detail::ClusterKernel<Real> kernel{functions.choose(kind(), parameters(), detail::wanted(sums)),
                                           functions.wants_lanes, types_, detail::pointers_to(tables),
                                           constants<Real>()};
  detail::ClusterRun<Real>(pairs, kernel, numbers, executor_, unresolved_, scratch).add(forces, sums);
}

void LennardJones::add(const ClusterPairs& pairs, ForcePrecision precision, Span<Vec3> forces,
                       Span<const double> charges, LennardJonesSums* sums) {
  check(pairs, forces.size(), charges.size());
  if (precision == ForcePrecision::mixed && !fits_single_)
    throw InvalidParameter(
        "a series has a splitting times cutoff of 3.6 or more, or a coefficient or squared cutoff is "
        "outside 1.2e-38..3.4e38, the range of single precision; use other units or "
        "ForcePrecision::double_precision");
  if (unresolved_) unresolved_->clear();
  if (pairs.tasks.size() < 2) return;
  if (precision == ForcePrecision::mixed) {
    run(pairs, charges, mixed_, scratch_float_, forces, sums);
  } else {
    run(pairs, charges, full_, scratch_, forces, sums);
  }
}

ClusterPairs::EntryOrder LennardJones::wanted_order(ForcePrecision precision) {
  using Order = ClusterPairs::EntryOrder;
  const detail::ForceKernels& kernels = detail::force_kernels(instruction_set());
  const auto of = [](const auto& functions, Order halves) {
    if (functions.wants_lanes) return Order::joined;
    return functions.leaves_out_halves ? halves : Order::as_found;
  };
  return precision == ForcePrecision::mixed ? of(kernels.mixed, Order::by_image_and_halves)
                                            : of(kernels.full, Order::by_halves);
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

}  // namespace dch
