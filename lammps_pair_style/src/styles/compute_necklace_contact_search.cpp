// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <comm.h>
#include <domain.h>
#include <error.h>
#include <string>
#include <utility>

#include <dch/base/error.hpp>

#include "atom_points.h"
#include "compute_necklace_contact.h"

namespace LAMMPS_NS {

/// Pieces of chains: beads that are here one behind the other. Of two pieces of one chain the structures do
/// not know that; keep() does. Only where pairs within chains alone are wanted a chain's pieces are joined,
/// so that pairs between chains need not be looked at.
dch::necklace::Necklace ComputeNecklaceContact::chains_here() {
  const dch::necklace::Necklace& all = map_.chains();
  std::vector<std::array<std::int32_t, 2> > here;  // place and index
  for (std::size_t k = 0; k < beads_.size(); ++k)
    here.push_back({map_.place_of(beads_.beads()[k]), static_cast<std::int32_t>(k)});
  std::sort(here.begin(), here.end());
  dch::necklace::Chains chains(beads_.size());
  all_whole_ = true;
  std::vector<std::int32_t> piece;
  const bool joined = !query_.between_chains;
  for (std::size_t k = 0; k < here.size();) {
    const std::size_t which = all.chain_at(here[k][0]);
    const std::int32_t end = all.first_place(which + 1);
    piece.clear();
    do {
      piece.push_back(here[k++][1]);
    } while (k < here.size() && here[k][0] < end && (joined || here[k][0] == here[k - 1][0] + 1));
    const bool whole = piece.size() == all.chains().beads(which).size();
    all_whole_ = all_whole_ && whole;
    chains.add(piece, whole && all.chains().closed(which));
  }
  return {std::move(chains), beads_.radii()};
}

/// In structures that are kept from call to call as long as the same beads are here, made anew otherwise;
/// what the choice between them rests on stays.
void ComputeNecklaceContact::search(bool everything, const dch::Box& box, bool is_new) {
  using namespace dch::necklace;
  if (is_new || !finder_ || known_beads_ != beads_.beads() ||
      !std::equal(beads_.radii().begin(), beads_.radii().end(), finder_->necklace().radii().begin())) {
    known_beads_.clear();
    if (!finder_ || everything) {
      ContactFinderParams params;
      // A bond over half the box is one of a run that has gone wrong. Where beads are missing a long step is
      // none; then bonds_ looks at bonds.
      params.refuse_undetermined = everything;
      finder_ = std::make_unique<ContactFinder>(everything ? chains_here() : Necklace(), params);
    }
    if (!everything) {
      const std::vector<std::uint64_t> names(beads_.beads().begin(), beads_.beads().end());
      finder_->replace(chains_here(), names);
    }
    known_beads_ = beads_.beads();
  }
  finder_->update(beads_.positions(), box);
  ContactQuery query = query_;
  if (!all_whole_ && !query.between_chains)
    query.skip_bonds = 0;  // places in a joined chain do not tell how many bonds there are
  keep(finder_->find_contacts(query));
  if (finder_->answered_by() == Structure::wrapped) {
    const auto beads = static_cast<double>(std::max<std::size_t>(beads_.size(), 1));
    measured_ = {finder_->choice().visited_per_bead * beads, static_cast<double>(beads_.size())};
  }
}

/// Pairs with an own bead, without those that the structures took for pairs of different chains, since the
/// beads between are not here.
void ComputeNecklaceContact::keep(const std::vector<dch::necklace::Contact>& found) {
  contacts_.clear();
  for (const auto& contact : found) {
    const auto i = static_cast<std::size_t>(contact.i), j = static_cast<std::size_t>(contact.j);
    if (!beads_.is_own(i) && !beads_.is_own(j)) continue;
    if (!all_whole_) {
      const std::int32_t bonds =
          map_.chains().bonds_between(map_.place_of(beads_.beads()[i]), map_.place_of(beads_.beads()[j]));
      if (bonds >= 0 && (bonds <= query_.skip_bonds || !query_.within_chains)) continue;
    }
    contacts_.push_back(contact);
  }
}

/// @return false, on all processes, if one of them could not answer
bool ComputeNecklaceContact::find_among(bool everything, const dch::Box& box, bool is_new) {
  contacts_.clear();
  beads_.exchange_beads(map_, box, {groupbit, radius_of_type_, query_.gap, everything});
  traffic_ = {beads_.bytes_sent() + (comm->me == 0 ? map_.bytes_sent() : 0),
              static_cast<bigint>(beads_.received())};
  bool sound = true;
  if (!everything) {
    sound = bonds_.are_determined(map_, beads_, box) &&
            2 * beads_.largest_radius() + query_.gap <= box.max_cutoff();
    traffic_.bytes += bonds_.bytes_sent();
  }
  if (everything) {
    search(true, box, true);
  } else if (sound) {
    try {
      search(false, box, is_new);
    } catch (const dch::Error&) {
      sound = false;
    }
  }
  bigint mine = sound ? 0 : 1, all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  return all == 0;
}

/// Adds up what the processes have found and how, the same on all of them.
void ComputeNecklaceContact::add_up() {
  bigint own = 0;
  for (const auto& contact : contacts_) own += beads_.is_own(static_cast<std::size_t>(contact.i)) ? 1 : 0;
  const auto beads = static_cast<double>(beads_.size());
  const bool by_dch = finder_->answered_by() == dch::necklace::Structure::dch;
  std::array<double, 6> mine{static_cast<double>(own),
                             static_cast<double>(traffic_.bytes),
                             by_dch ? beads : 0,
                             beads,
                             measured_[0],
                             measured_[1]};
  std::array<double, 6> sum{};
  MPI_Allreduce(mine.data(), sum.data(), static_cast<int>(mine.size()), MPI_DOUBLE, MPI_SUM, world);
  bigint most = 0;
  MPI_Allreduce(&traffic_.most_beads, &most, 1, MPI_LMP_BIGINT, MPI_MAX, world);
  total_ = static_cast<bigint>(sum[0]);
  search_ = {sum[3] > 0 ? sum[2] / sum[3] : 0, sum[5] > 0 ? sum[4] / sum[5] : 0, static_cast<double>(most),
             sum[1]};
}

/// What one process cannot answer from its beads, all do from all beads: so they refuse alike, by the same
/// words, whatever the number of processes.
void ComputeNecklaceContact::find() {
  bool is_gathered = false;
  try {
    const bool is_new = map_.follow(groupbit);
    const dch::Box box = box_of(*domain);
    const bool is_alone = comm->nprocs == 1;
    if (is_alone) {
      beads_.exchange_beads(map_, box, {groupbit, radius_of_type_, query_.gap, true});
      traffic_ = {};
      search(true, box, is_new);
    } else if (!find_among(false, box, is_new)) {
      is_gathered = true;
      find_among(true, box, true);
    }
    add_up();
    if (is_gathered) finder_.reset();  // it is one for all beads
  } catch (const dch::Error& e) {      // all processes have the same beads then, so all throw
    finder_.reset();
    error->all(FLERR, std::string("Compute necklace/contact: ") + e.what() +
                          " (beads are numbered from 0 in the order of atom IDs in the group)");
  }
}

}  // namespace LAMMPS_NS
