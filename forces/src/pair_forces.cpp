// SPDX-License-Identifier: MIT
//
// LennardJones over pairs one by one.
#include <string>

#include <dch/base/error.hpp>
#include <dch/forces/lennard_jones.hpp>

#include "pair_list_run.hpp"
#include "simd/force_kernels.hpp"

namespace dch {

void LennardJones::add(const PairList& pairs, Span<const Vec3> positions, const Box& now, Span<Vec3> forces,
                       Span<const double> charges, LennardJonesSums* sums) const {
  check(pairs, forces.size(), charges.size());
  detail::PairListRun run(pairs, positions, now);
  const auto function =
      detail::force_kernels(instruction_set()).pairs.choose(kind(), parameters(), detail::wanted(sums));
  if (!function)
    throw InvalidParameter(
        "a pair list was given for a potential with a switch, a reaction field, a series or parameters of "
        "particles; use cluster pairs");
  detail::LjPairTask task{pairs.i.data(),
                          pairs.j.data(),
                          0,
                          0,
                          positions.data(),
                          {},
                          types_ > 1 ? run.types() : nullptr,
                          types_,
                          detail::pointers_to(full_),
                          charges.data(),
                          charge_unit_,
                          constants<double>(),
                          forces.data()};
  run.add(task, function, sums);
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
