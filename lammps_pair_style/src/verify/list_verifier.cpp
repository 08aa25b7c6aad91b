// SPDX-License-Identifier: GPL-2.0-or-later
#include "list_verifier.h"

#include <algorithm>
#include <atom.h>
#include <cmath>
#include <comm.h>
#include <domain.h>
#include <neigh_list.h>
#include <neighbor.h>
#include <type_traits>

namespace LAMMPS_NS {

using dch::lammps::AtomPair;
using dch::lammps::ListEntry;

static_assert(std::is_trivially_copyable_v<AtomPair>, "pairs travel between processes as bytes");

std::vector<ListEntry> ListVerifier::entries(const NeighList& list, const ServedList& served,
                                             PairLevel level) {
  std::vector<ListEntry> out;
  const LevelRows rows = rows_of(list, level);
  for (int row = 0; row < list.inum + (served.ghost ? list.gnum : 0); ++row) {
    const int i = rows.ilist[row];
    for (int k = 0; k < rows.numneigh[i]; ++k) {
      const int stored = rows.firstneigh[i][k];
      ListEntry entry{i, stored & NEIGHMASK, stored >> SBBITS & 3};
      if (!served.full && entry.i > entry.j) std::swap(entry.i, entry.j);
      out.push_back(entry);
    }
  }
  return out;
}

bool ListVerifier::may_differ(const ListEntry& entry, const ServedList& served, PairLevel level,
                              double rounding) const {
  const double *xi = atom->x[entry.i], *xj = atom->x[entry.j];
  const double distance = std::sqrt(norm2(dch::Vec3{xj[0] - xi[0], xj[1] - xi[1], xj[2] - xi[2]}));
  const double cutoff = served.by_radius
                            ? atom->radius[entry.i] + atom->radius[entry.j] + neighbor->skin
                            : std::sqrt(neighbor->cutneighsq[atom->type[entry.i]][atom->type[entry.j]]);
  const bool is_beyond = served.by_radius && distance > neighbor->cutneighmax - rounding;
  if (is_beyond || std::abs(distance - cutoff) <= rounding) return true;
  if (level == PairLevel::all) return false;
  const LevelBounds bounds = bounds_of(level, *neighbor);
  return std::abs(distance - std::sqrt(bounds.below)) <= rounding ||
         (bounds.above >= 0 && std::abs(distance - std::sqrt(bounds.above)) <= rounding);
}

void ListVerifier::append_pairs(const std::vector<ListEntry>& entries, bool native,
                                std::vector<AtomPair>& out) const {
  for (const ListEntry& e : entries) {
    const double *xi = atom->x[e.i], *xj = atom->x[e.j];
    out.push_back(dch::lammps::make_atom_pair(
        atom->tag[e.i], atom->tag[e.j], {xj[0] - xi[0], xj[1] - xi[1], xj[2] - xi[2]}, e.special, native));
  }
}

// To the process that a hash of the two IDs chooses.
std::vector<AtomPair> ListVerifier::exchange(const std::vector<AtomPair>& pairs) const {
  const int processes = comm->nprocs;
  const auto home = [&](const AtomPair& p) {
    const auto mixed =
        (static_cast<std::uint64_t>(p.low) * 0x9E3779B97F4A7C15u) ^ static_cast<std::uint64_t>(p.high);
    return static_cast<std::size_t>(mixed % static_cast<std::uint64_t>(processes));
  };
  MPI_Datatype pair_type;
  MPI_Type_contiguous(sizeof(AtomPair), MPI_BYTE, &pair_type);
  MPI_Type_commit(&pair_type);
  const auto n = static_cast<std::size_t>(processes);
  std::vector<int> send_count(n, 0), receive_count(n, 0), send_first(n + 1, 0), receive_first(n + 1, 0);
  for (const AtomPair& p : pairs) ++send_count[home(p)];
  MPI_Alltoall(send_count.data(), 1, MPI_INT, receive_count.data(), 1, MPI_INT, world);
  for (std::size_t k = 0; k < n; ++k) {
    send_first[k + 1] = send_first[k] + send_count[k];
    receive_first[k + 1] = receive_first[k] + receive_count[k];
  }
  std::vector<AtomPair> sent(pairs.size()), received(static_cast<std::size_t>(receive_first[n]));
  std::vector<int> next(send_first.begin(), send_first.end() - 1);
  for (const AtomPair& p : pairs) sent[static_cast<std::size_t>(next[home(p)]++)] = p;
  MPI_Alltoallv(sent.data(), send_count.data(), send_first.data(), pair_type, received.data(),
                receive_count.data(), receive_first.data(), pair_type, world);
  MPI_Type_free(&pair_type);
  return received;
}

// Images of one atom differ by whole box vectors, whose largest component is at least the box's shortest
// edge.
double ListVerifier::image_tolerance() const {
  double shortest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (domain->periodicity[axis] && (shortest == 0 || domain->prd[axis] < shortest))
      shortest = domain->prd[axis];
  }
  return shortest > 0 ? 1e-3 * shortest : 1e-3 * neighbor->cutneighmax;
}

std::string ListVerifier::first_difference(const std::vector<AtomPair>& differences) const {
  int mine = differences.empty() ? comm->nprocs : comm->me;
  int holder = 0;
  MPI_Allreduce(&mine, &holder, 1, MPI_INT, MPI_MIN, world);
  AtomPair pair;
  if (comm->me == holder) pair = differences.front();
  MPI_Bcast(&pair, sizeof pair, MPI_BYTE, holder, world);
  return dch::lammps::describe(pair);
}

std::string ListVerifier::compare(std::vector<ListEntry> native, std::vector<ListEntry> ours,
                                  const ServedList& served, PairLevel level, double rounding) const {
  dch::lammps::ListDifference local = dch::lammps::compare_entries(std::move(native), std::move(ours));
  for (std::vector<ListEntry>* const entries : {&local.native_only, &local.dch_only}) {
    entries->erase(std::remove_if(entries->begin(), entries->end(),
                                  [&](const ListEntry& e) { return may_differ(e, served, level, rounding); }),
                   entries->end());
  }
  std::vector<AtomPair> differences;
  append_pairs(local.native_only, true, differences);
  append_pairs(local.dch_only, false, differences);
  return compare_pairs(std::move(differences), served.newton, served.newton ? image_tolerance() : -1.0);
}

std::string ListVerifier::compare_pairs(std::vector<AtomPair> pairs, bool over_processes,
                                        double tolerance) const {
  if (over_processes) pairs = exchange(pairs);
  std::vector<AtomPair> differences = dch::lammps::unmatched(std::move(pairs), tolerance);
  dch::lammps::drop_at_cutoff(differences);
  bigint mine = static_cast<bigint>(differences.size()), all = 0;  // not const for LAMMPS's stand-in for MPI
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (all == 0) return {};
  return std::to_string(all) + " pairs differ, the first: " + first_difference(differences);
}

}  // namespace LAMMPS_NS
