// SPDX-License-Identifier: GPL-2.0-or-later
#include "crossing_log.h"

#include <algorithm>
#include <comm.h>
#include <tuple>

#include "id_numbers.h"

namespace LAMMPS_NS {
namespace {

/// Of a crossing, as they travel: four IDs, step, place, sign.
constexpr std::size_t kNumbers = 9;
/// Of an atom: how many bonds, and two partners.
constexpr std::size_t kOfAtom = 3;

}  // namespace

void CrossingLog::gather(const std::vector<BondCrossing>& mine, const MovingAtoms& atoms, double begin,
                         double end) {
  collect(mine, begin, end);
  if (events_.empty()) return;
  find_neighbors(atoms);
  for (CrossingEvent& event : events_)
    event.sign *= direction(event.tags[0], event.tags[1]) * direction(event.tags[2], event.tags[3]);
}

void CrossingLog::collect(const std::vector<BondCrossing>& mine, double begin, double end) {
  std::vector<double> numbers;
  for (const BondCrossing& crossing : mine) {
    for (const tagint tag : crossing.tags) numbers.push_back(in_double(tag));
    numbers.insert(numbers.end(), {begin + crossing.time * (end - begin), crossing.place.x, crossing.place.y,
                                   crossing.place.z, static_cast<double>(crossing.sign)});
  }
  const auto processes = static_cast<std::size_t>(comm->nprocs);
  std::vector<int> counts(processes), first(processes);
  int own = static_cast<int>(numbers.size());
  MPI_Allgather(&own, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  int total = 0;
  for (std::size_t p = 0; p < processes; ++p) {
    first[p] = total;
    total += counts[p];
  }
  std::vector<double> all(static_cast<std::size_t>(total));
  MPI_Allgatherv(numbers.data(), own, MPI_DOUBLE, all.data(), counts.data(), first.data(), MPI_DOUBLE, world);
  events_.clear();
  for (std::size_t p = 0; p < processes; ++p) {
    const double* at = all.data() + first[p];
    for (int k = 0; k < counts[p]; k += static_cast<int>(kNumbers), at += kNumbers) {
      CrossingEvent event;
      for (std::size_t n = 0; n < 4; ++n) event.tags[n] = from_double<tagint>(at[n]);
      event.step = at[4];
      event.place = {at[5], at[6], at[7]};
      event.sign = static_cast<int>(at[8]);
      event.process = static_cast<int>(p);
      events_.push_back(event);
    }
  }
  std::sort(events_.begin(), events_.end(), [](const CrossingEvent& a, const CrossingEvent& b) {
    return std::tie(a.step, a.tags) < std::tie(b.step, b.tags);
  });
}

/// The owner of an atom sees all its bonds: those that it holds, and those that neighbors hold.
void CrossingLog::find_neighbors(const MovingAtoms& atoms) {
  asked_.clear();
  for (const CrossingEvent& event : events_)
    asked_.insert(asked_.end(), event.tags.begin(), event.tags.end());
  std::sort(asked_.begin(), asked_.end());
  asked_.erase(std::unique(asked_.begin(), asked_.end()), asked_.end());
  std::vector<std::vector<tagint> > found(asked_.size());
  const auto note = [&](tagint tag, tagint partner) {
    const auto at = std::lower_bound(asked_.begin(), asked_.end(), tag);
    if (at == asked_.end() || *at != tag) return;
    const int i = atom->map(tag);
    if (i < 0 || i >= atom->nlocal) return;
    auto& partners = found[static_cast<std::size_t>(at - asked_.begin())];
    if (std::find(partners.begin(), partners.end(), partner) == partners.end()) partners.push_back(partner);
  };
  const auto note_both = [&](int i, tagint partner) {
    const int j = atom->map(partner);
    if (j < 0 || !atoms.in_group(j)) return;
    note(atom->tag[i], partner);
    note(partner, atom->tag[i]);
  };
  for (int i = 0; i < atom->nlocal; ++i)
    atoms.for_bonds_of_owned(i, [&](tagint partner, bool) { note_both(i, partner); });
  if (atoms.has_ghosts())
    for (int i = atom->nlocal; i < atom->nlocal + atom->nghost; ++i)
      atoms.for_bonds_of_ghost(i, [&](tagint partner, bool) { note_both(i, partner); });
  std::vector<tagint> mine(kOfAtom * asked_.size()), all(mine.size());
  for (std::size_t k = 0; k < asked_.size(); ++k) {
    auto& partners = found[k];
    std::sort(partners.begin(), partners.end());
    mine[kOfAtom * k] = static_cast<tagint>(partners.size());
    for (std::size_t n = 0; n < std::min<std::size_t>(2, partners.size()); ++n)
      mine[kOfAtom * k + 1 + n] = partners[n];
  }
  MPI_Allreduce(mine.data(), all.data(), static_cast<int>(all.size()), MPI_LMP_TAGINT, MPI_SUM, world);
  neighbors_.resize(asked_.size());
  for (std::size_t k = 0; k < asked_.size(); ++k)
    neighbors_[k] = {static_cast<int>(all[kOfAtom * k]), {all[kOfAtom * k + 1], all[kOfAtom * k + 2]}};
}

const CrossingLog::Neighbors& CrossingLog::neighbors_of(tagint tag) const {
  const auto at = std::lower_bound(asked_.begin(), asked_.end(), tag);
  return neighbors_[static_cast<std::size_t>(at - asked_.begin())];
}

/// 1 if the chain goes from the atom of lower ID to that of the higher one, -1 if the other way, 0 if there
/// is no chain.
int CrossingLog::direction(tagint low, tagint high) const {
  const Neighbors &a = neighbors_of(low), &b = neighbors_of(high);
  if (a.bonds > 2 || b.bonds > 2) return 0;
  if (high == low + 1) return 1;
  const bool closes_ring =
      a.bonds == 2 && b.bonds == 2 && a.partners[0] == low + 1 && b.partners[1] == high - 1;
  return closes_ring ? -1 : 0;
}

}  // namespace LAMMPS_NS
