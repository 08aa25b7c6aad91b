// SPDX-License-Identifier: GPL-2.0-or-later
#include "gathered_beads.h"

#include <algorithm>
#include <atom.h>
#include <climits>
#include <comm.h>
#include <error.h>
#include <force.h>
#include <numeric>
#include <string>
#include <utility>

namespace LAMMPS_NS {
namespace {

/// Of a bead, as they travel: tag, x, y, z, radius.
constexpr std::size_t kNumbers = 5;

/// The parts of all processes, one behind the other. What is sent is not const: LAMMPS's replacement for MPI
/// in serial builds does not take that.
template <class T>
std::vector<T> gather_all(std::vector<T> mine, MPI_Datatype type, Error& error, MPI_Comm world) {
  int processes = 0;
  MPI_Comm_size(world, &processes);
  auto count = static_cast<bigint>(mine.size());
  bigint total = 0;
  MPI_Allreduce(&count, &total, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (total > INT_MAX)
    error.all(FLERR, "Compute necklace/contact would gather " + std::to_string(total) +
                         " numbers, but at most " + std::to_string(INT_MAX) +
                         " can be; choose a smaller group");
  std::vector<int> counts(static_cast<std::size_t>(processes)), first(counts.size());
  int own = static_cast<int>(count);
  MPI_Allgather(&own, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  std::exclusive_scan(counts.begin(), counts.end(), first.begin(), 0);
  std::vector<T> all(static_cast<std::size_t>(total));
  MPI_Allgatherv(mine.data(), own, type, all.data(), counts.data(), first.data(), type, world);
  return all;
}

}  // namespace

void GatheredBeads::gather(int group_bit, const std::vector<double>& radius_of_type) {
  gather_beads(group_bit, radius_of_type);
  gather_bonds(group_bit);
}

void GatheredBeads::gather_beads(int group_bit, const std::vector<double>& radius_of_type) {
  std::vector<double> mine;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & group_bit)) continue;
    const double* const x = atom->x[i];
    const double radius =
        radius_of_type.empty() ? atom->radius[i] : radius_of_type[static_cast<std::size_t>(atom->type[i])];
    mine.insert(mine.end(), {static_cast<double>(atom->tag[i]), x[0], x[1], x[2], radius});
  }
  const std::vector<double> numbers = gather_all(std::move(mine), MPI_DOUBLE, *error, world);
  std::vector<const double*> rows;
  for (std::size_t k = 0; k < numbers.size(); k += kNumbers) rows.push_back(numbers.data() + k);
  std::sort(rows.begin(), rows.end(), [](const double* a, const double* b) { return a[0] < b[0]; });
  tags_.clear();
  radii_.clear();
  positions_.clear();
  for (const double* const row : rows) {
    tags_.push_back(static_cast<tagint>(row[0]));
    positions_.push_back({row[1], row[2], row[3]});
    radii_.push_back(row[4]);
  }
}

// With newton on for bonds one of the two atoms has a bond, else both have it.
void GatheredBeads::gather_bonds(int group_bit) {
  std::vector<tagint> mine;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & group_bit)) continue;
    for (int m = 0; m < atom->num_bond[i]; ++m) {
      const tagint other = atom->bond_atom[i][m];
      if (atom->bond_type[i][m] == 0 || (!force->newton_bond && other < atom->tag[i])) continue;
      mine.insert(mine.end(), {atom->tag[i], other});
    }
  }
  const std::vector<tagint> ends = gather_all(std::move(mine), MPI_LMP_TAGINT, *error, world);
  bonds_.clear();
  for (std::size_t k = 0; k + 1 < ends.size(); k += 2) {
    const std::int32_t i = bead_of(ends[k]), j = bead_of(ends[k + 1]);
    if (i >= 0 && j >= 0) bonds_.push_back({std::min(i, j), std::max(i, j)});
  }
  std::sort(bonds_.begin(), bonds_.end());
}

std::int32_t GatheredBeads::bead_of(tagint tag) const {
  const auto found = std::lower_bound(tags_.begin(), tags_.end(), tag);
  if (found == tags_.end() || *found != tag) return -1;
  return static_cast<std::int32_t>(found - tags_.begin());
}

}  // namespace LAMMPS_NS
