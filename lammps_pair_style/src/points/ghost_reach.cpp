// SPDX-License-Identifier: GPL-2.0-or-later
#include "ghost_reach.h"

#include <algorithm>
#include <atom.h>
#include <limits>
#include <neighbor.h>

namespace LAMMPS_NS {

void GhostReach::gather() {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  around_.clear();
  for (int type = 1; type <= atom->ntypes; ++type)
    around_.push_back({type, {kFar, kFar, kFar}, {-kFar, -kFar, -kFar}});
  for (int i = 0; i < atom->nlocal; ++i) {
    Around& own = around_[static_cast<std::size_t>(atom->type[i] - 1)];
    const double* const x = atom->x[i];
    own.low = {std::min(own.low.x, x[0]), std::min(own.low.y, x[1]), std::min(own.low.z, x[2])};
    own.high = {std::max(own.high.x, x[0]), std::max(own.high.y, x[1]), std::max(own.high.z, x[2])};
  }
  around_.erase(
      std::remove_if(around_.begin(), around_.end(), [](const Around& a) { return !(a.low.x <= a.high.x); }),
      around_.end());
}

bool GhostReach::is_within(int ghost) const {
  constexpr double kRounding = 1 + 1e-12;
  const double* const x = atom->x[ghost];
  const int type = atom->type[ghost];
  return std::any_of(around_.begin(), around_.end(), [&](const Around& own) {
    const dch::Vec3 off{std::max({own.low.x - x[0], x[0] - own.high.x, 0.0}),
                        std::max({own.low.y - x[1], x[1] - own.high.y, 0.0}),
                        std::max({own.low.z - x[2], x[2] - own.high.z, 0.0})};
    const double cutoff2 =
        std::max(neighbor->cutneighsq[type][own.type], neighbor->cutneighsq[own.type][type]);
    return norm2(off) <= kRounding * cutoff2;
  });
}

}  // namespace LAMMPS_NS
