// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_colloid_dch.h"

#include <atom.h>
#include <cmath>
#include <cstddef>
#include <error.h>
#include <string>

namespace LAMMPS_NS {

void PairColloidDCH::check_forces() {
  if (forces_are_finite()) return;
  // Other forces may be no numbers too. Rounding in single precision may have brought a pair closer than it
  // is.
  const dch::PairPotentialParams all = kernel_params();
  const auto types = static_cast<std::size_t>(atom->ntypes);
  for_each_pair([&](int i, int j, dch::Vec3 apart, int) {
    const auto a = static_cast<std::size_t>(atom->type[i] - 1),
               b = static_cast<std::size_t>(atom->type[j] - 1);
    const auto& numbers = all.pairs[a * types + b].numbers;
    const double d1 = numbers[2], d2 = numbers[3], contact = 0.5 * (d1 + d2);
    if (contact == 0 || !(std::sqrt(norm2(apart)) <= (1 + 1e-6) * contact)) return;
    const std::string kinds = d1 == 0 || d2 == 0 ? "small/large" : "large/large";
    error->one(FLERR, "Overlapping " + kinds + " in pair colloid");
  });
}

}  // namespace LAMMPS_NS
