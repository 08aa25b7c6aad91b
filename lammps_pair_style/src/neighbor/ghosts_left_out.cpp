// SPDX-License-Identifier: GPL-2.0-or-later
#include "ghosts_left_out.h"

#include <algorithm>
#include <numeric>

namespace LAMMPS_NS {
namespace {

constexpr std::size_t kSlabs = 64;

}  // namespace

std::size_t GhostsLeftOut::slab_of(double coordinate) const {
  const double slab = (coordinate - low_) * per_length_;
  return slab > 0 ? static_cast<std::size_t>(std::min(slab, double{kSlabs - 1})) : 0;
}

GhostsLeftOut::GhostsLeftOut(int type, dch::Span<const int> ghosts, const double* const* x)
    : ghosts_(ghosts.size()), first_(kSlabs + 1), type_(type) {
  if (ghosts.empty()) return;
  dch::Vec3 low{x[ghosts[0]][0], x[ghosts[0]][1], x[ghosts[0]][2]}, high = low;
  for (const int g : ghosts) {
    low = {std::min(low.x, x[g][0]), std::min(low.y, x[g][1]), std::min(low.z, x[g][2])};
    high = {std::max(high.x, x[g][0]), std::max(high.y, x[g][1]), std::max(high.z, x[g][2])};
  }
  const dch::Vec3 extent = high - low;
  axis_ = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  low_ = low[axis_];
  per_length_ = extent[axis_] > 0 ? kSlabs / extent[axis_] : 0;
  for (const int g : ghosts) ++first_[slab_of(x[g][axis_]) + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (const int g : ghosts) ghosts_[next[slab_of(x[g][axis_])]++] = {{x[g][0], x[g][1], x[g][2]}, g};
}

}  // namespace LAMMPS_NS
