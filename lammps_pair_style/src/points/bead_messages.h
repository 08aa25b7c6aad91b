// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <climits>
#include <error.h>
#include <lammps_host.h>
#include <numeric>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/// Bytes that all processes send to others, and how many beads reach the one that gets the most of them.
struct BeadTraffic {
  bigint bytes = 0;
  bigint most_beads = 0;
};

/// The parts of all processes, one behind the other, on every process. What is sent is not const: LAMMPS's
/// replacement for MPI in serial builds does not take that.
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

/// Sends numbers to each process, and gets those that are for this one, in the order of the senders.
/// @param parts by process
std::vector<double> exchange(const std::vector<std::vector<double> >& parts, Error& error, MPI_Comm world);

}  // namespace LAMMPS_NS
