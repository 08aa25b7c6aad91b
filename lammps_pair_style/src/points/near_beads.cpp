// SPDX-License-Identifier: GPL-2.0-or-later
#include "near_beads.h"

#include <algorithm>
#include <atom.h>
#include <cmath>
#include <comm.h>
#include <numeric>
#include <utility>

namespace LAMMPS_NS {
namespace {

/// Of a region and of a bead, as they travel.
constexpr int kRegionNumbers = 7;
constexpr std::size_t kBeadNumbers = 5;

/// Beads farther out than so many boxes are sent to all: rounding makes their images uncertain.
constexpr double kFar = 1e5;
constexpr double kRounding = 1e-9;

/// Fractional coordinates, by vectors that are made once; lengths if nothing is periodic.
class Cell {
 public:
  explicit Cell(const dch::Box& box) {
    if (box.kind() == dch::Box::Kind::none) return;
    for (int k = 0; k < 3; ++k) {
      const dch::Vec3 normal = cross(box.vector((k + 1) % 3), box.vector((k + 2) % 3));
      dual_[static_cast<std::size_t>(k)] = 1 / dot(normal, box.vector(k)) * normal;
      periodic_[static_cast<std::size_t>(k)] = box.periodic(k);
    }
  }
  double coordinate(std::size_t axis, dch::Vec3 p) const { return dot(dual_[axis], p); }
  /// How far a distance goes at most along a vector of the box.
  double extent(std::size_t axis, double distance) const { return distance * std::sqrt(norm2(dual_[axis])); }

  /// Whether an image of f lies between low - t and high + t.
  bool reaches(std::size_t axis, double f, double low, double high, double t) const {
    if (!(std::abs(f) < kFar && low > -kFar && high < kFar)) return true;
    const double from = f - (low - t), width = high - low + 2 * t;
    return (periodic_[axis] ? from - std::floor(from) : from) <= width && (periodic_[axis] || from >= 0);
  }

 private:
  std::array<dch::Vec3, 3> dual_{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::array<bool, 3> periodic_{};
};

}  // namespace

std::vector<NearBeads::Bead> NearBeads::own_beads(const ChainMap& chains, const Wanted& wanted) const {
  std::vector<Bead> own;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & wanted.group_bit)) continue;
    const std::int32_t bead = chains.bead_of(atom->tag[i]);
    if (bead < 0 || chains.place_of(bead) < 0) continue;
    const double* const x = atom->x[i];
    const double radius = wanted.radius_of_type.empty()
                              ? atom->radius[i]
                              : wanted.radius_of_type[static_cast<std::size_t>(atom->type[i])];
    own.push_back({static_cast<double>(bead), x[0], x[1], x[2], radius});
  }
  return own;
}

void NearBeads::exchange_beads(const ChainMap& chains, const dch::Box& box, const Wanted& wanted) {
  std::vector<Bead> beads = own_beads(chains, wanted);
  const std::size_t own = beads.size();
  const Cell cell(box);
  std::vector<std::array<double, 3> > at;
  Region mine;
  for (const Bead& bead : beads) {
    const dch::Vec3 p{bead.x, bead.y, bead.z};
    at.push_back({cell.coordinate(0, p), cell.coordinate(1, p), cell.coordinate(2, p)});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool first = at.size() == 1;
      mine.low[axis] = first ? at.back()[axis] : std::min(mine.low[axis], at.back()[axis]);
      mine.high[axis] = first ? at.back()[axis] : std::max(mine.high[axis], at.back()[axis]);
    }
    mine.radius = std::max(mine.radius, bead.radius);
  }
  const auto processes = static_cast<std::size_t>(comm->nprocs);
  std::array<double, kRegionNumbers> numbers{mine.low[0],  mine.low[1],  mine.low[2], mine.high[0],
                                             mine.high[1], mine.high[2], mine.radius};
  std::vector<double> regions(kRegionNumbers * processes);
  MPI_Allgather(numbers.data(), kRegionNumbers, MPI_DOUBLE, regions.data(), kRegionNumbers, MPI_DOUBLE,
                world);
  std::vector<std::vector<double> > parts(processes);
  largest_radius_ = 0;
  bytes_ = static_cast<bigint>((processes - 1) * sizeof(numbers));
  for (std::size_t process = 0; process < processes; ++process) {
    const double* const region = regions.data() + kRegionNumbers * process;
    largest_radius_ = std::max(largest_radius_, region[6]);
    if (process == static_cast<std::size_t>(comm->me)) continue;
    if (!wanted.everything && region[0] > region[3]) continue;
    for (std::size_t k = 0; k < own; ++k) {
      const Bead& bead = beads[k];
      const double reach = bead.radius + region[6] + wanted.gap;
      bool near = true;
      for (std::size_t axis = 0; axis < 3 && near && !wanted.everything; ++axis)
        near = cell.reaches(axis, at[k][axis], region[axis], region[3 + axis],
                            (1 + kRounding) * cell.extent(axis, reach) + kRounding);
      if (near) parts[process].insert(parts[process].end(), {bead.bead, bead.x, bead.y, bead.z, bead.radius});
    }
    bytes_ += static_cast<bigint>(parts[process].size() * sizeof(double));
  }
  if (processes > 1) {
    const std::vector<double> got = exchange(parts, *error, world);
    for (std::size_t k = 0; k + kBeadNumbers <= got.size(); k += kBeadNumbers)
      beads.push_back({got[k], got[k + 1], got[k + 2], got[k + 3], got[k + 4]});
  }
  received_ = beads.size() - own;
  take(std::move(beads), own);
}

/// In ascending order. The first so many are this process's own.
void NearBeads::take(std::vector<Bead> beads, std::size_t own) {
  std::vector<std::size_t> order(beads.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return beads[a].bead < beads[b].bead; });
  beads_.clear();
  positions_.clear();
  radii_.clear();
  own_.clear();
  for (const std::size_t k : order) {
    const Bead& bead = beads[k];
    beads_.push_back(static_cast<std::int32_t>(bead.bead));
    positions_.push_back({bead.x, bead.y, bead.z});
    radii_.push_back(bead.radius);
    own_.push_back(k < own);
  }
}

std::ptrdiff_t NearBeads::index_of(std::int32_t bead) const {
  const auto found = std::lower_bound(beads_.begin(), beads_.end(), bead);
  return found != beads_.end() && *found == bead ? found - beads_.begin() : -1;
}

}  // namespace LAMMPS_NS
