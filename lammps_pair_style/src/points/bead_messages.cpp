// SPDX-License-Identifier: GPL-2.0-or-later
#include "bead_messages.h"

namespace LAMMPS_NS {
namespace {

/// Where each part begins, and where the last one ends.
std::vector<int> starts(const std::vector<int>& counts, Error& error) {
  bigint total = 0;
  std::vector<int> first;
  for (const int count : counts) {
    first.push_back(static_cast<int>(total));
    total += count;
    if (total > INT_MAX)
      error.one(FLERR, std::string("Compute necklace/contact would send or get more than ") +
                           std::to_string(INT_MAX) +
                           " numbers on one process; take more processes or a smaller group");
  }
  first.push_back(static_cast<int>(total));
  return first;
}

}  // namespace

std::vector<double> exchange(const std::vector<std::vector<double> >& parts, Error& error, MPI_Comm world) {
  std::vector<int> sent, got(parts.size());
  for (const auto& part : parts) sent.push_back(static_cast<int>(part.size()));
  MPI_Alltoall(sent.data(), 1, MPI_INT, got.data(), 1, MPI_INT, world);
  std::vector<int> from = starts(sent, error), to = starts(got, error);
  std::vector<double> out, in(static_cast<std::size_t>(to.back()));
  out.reserve(static_cast<std::size_t>(from.back()));
  for (const auto& part : parts) out.insert(out.end(), part.begin(), part.end());
  MPI_Alltoallv(out.data(), sent.data(), from.data(), MPI_DOUBLE, in.data(), got.data(), to.data(),
                MPI_DOUBLE, world);
  return in;
}

}  // namespace LAMMPS_NS
