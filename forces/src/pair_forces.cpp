// SPDX-License-Identifier: MIT
//
// LennardJones over pairs one by one.
#include <string>

#include <dch/base/error.hpp>
#include <dch/forces/lennard_jones.hpp>

#include "lj_sums.hpp"
#include "simd/force_kernels.hpp"

namespace dch {

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
      detail::force_kernels(instruction_set()).pairs.choose(kind(), parameters(), sums != nullptr);
  if (!function)
    throw InvalidParameter(
        "a pair list was given for a potential with a switch, a reaction field, a series or parameters of "
        "particles; use cluster pairs");
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
                          detail::pointers_to(full_),
                          charges.data(),
                          charge_unit_,
                          constants<double>(),
                          forces.data()};
  detail::LjSums found;
  for (std::size_t g = 0; g + 1 < pairs.groups.size(); ++g) {
    task.first = pairs.groups[g].first;
    task.last = pairs.groups[g + 1].first;
    task.shift = PairList::shift(pairs.groups[g], now);
    if (task.first < task.last) function(task, found);
  }
  if (sums) detail::give(found, *sums);
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
