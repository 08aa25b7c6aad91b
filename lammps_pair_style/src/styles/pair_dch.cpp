// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_dch.h"

#include <algorithm>
#include <atom.h>
#include <comm.h>
#include <cstdio>
#include <cstring>
#include <domain.h>
#include <force.h>
#include <memory.h>
#include <neighbor.h>
#include <update.h>
#include <utility>

#include "ghosts_sent.h"
#include "neigh_history.h"
#include "neighbor_dch.h"

namespace LAMMPS_NS {
namespace {

/// Takes back the requests for neighbor lists from the given one on. Their class is in a header that LAMMPS
/// does not install; as all of LAMMPS's it derives from Pointers first, whose destructor is virtual.
void withdraw_requests(Neighbor& neighbor, int first) {
  for (int k = first; k < neighbor.nrequest; ++k) {
    delete reinterpret_cast<Pointers*>(neighbor.requests[k]);
    neighbor.requests[k] = nullptr;
  }
  neighbor.nrequest = first;
}

}  // namespace

PairDCH::PairDCH(LAMMPS* lammps, const Style& style) : PlainPair(lammps, style.plain), style_(style) {
  make_plain();
  ewaldflag = plain_->ewaldflag;
  pppmflag = plain_->pppmflag;
  msmflag = plain_->msmflag;
  plain_->ncoultablebits = 0;
  no_virial_fdotr_compute = 1;  // where points are the atoms in the box, ghosts get no forces
}

// --------------------------------------------------------------------------------------------------------------------
// What a script says

void PairDCH::settings(int narg, char** arg) {
  plain_->settings(narg, arg);
  take_coefficients();
}

void PairDCH::coeff(int narg, char** arg) {
  plain_->coeff(narg, arg);
  take_coefficients();
}

void PairDCH::read_restart(FILE* file) {
  plain_->read_restart(file);
  take_flags();
  take_coefficients();
}

void PairDCH::read_restart_settings(FILE* file) {
  plain_->read_restart_settings(file);
  take_flags();
}

void PairDCH::take_flags() {
  offset_flag = (*plain_).*(&PairDCH::offset_flag);
  mix_flag = (*plain_).*(&PairDCH::mix_flag);
  tail_flag = plain_->tail_flag;
  ncoultablebits = std::exchange(plain_->ncoultablebits, 0);
}

/// LAMMPS looks at which pairs of types have been given.
void PairDCH::take_coefficients() {
  kernel_.reset();
  if (!plain_->allocated) give_up_arrays_by_types(*this, *memory);
  take_flags_by_types();
}

void PairDCH::modify_params(int narg, char** arg) {
  PlainPair::modify_params(narg, arg);
  plain_->ncoultablebits = 0;
  kernel_.reset();
}

double PairDCH::init_one(int i, int j) {
  const double cutoff = PlainPair::init_one(i, j);
  etail_ij = plain_->etail_ij;
  ptail_ij = plain_->ptail_ij;
  kernel_.reset();
  const auto known = std::find_if(pairs_of_types_.begin(), pairs_of_types_.end(),
                                  [&](const PairOfTypes& p) { return p.a == i && p.b == j; });
  if (known != pairs_of_types_.end()) {
    known->cutoff = cutoff;
  } else {
    pairs_of_types_.push_back({i, j, cutoff});
  }
  if (clusters_) {
    const auto n = static_cast<std::size_t>(atom->ntypes);
    const auto a = static_cast<std::size_t>(i - 1), b = static_cast<std::size_t>(j - 1);
    clusters_->interacts[a * n + b] = clusters_->interacts[b * n + a] = 1;
  }
  return cutoff;
}

// Files say what the script has said of tables, for those who read them with the plain style.
void PairDCH::write_restart(FILE* file) {
  plain_->ncoultablebits = ncoultablebits;
  plain_->write_restart(file);
  plain_->ncoultablebits = 0;
}

void PairDCH::write_restart_settings(FILE* file) {
  plain_->ncoultablebits = ncoultablebits;
  plain_->write_restart_settings(file);
  plain_->ncoultablebits = 0;
}

void PairDCH::write_data(FILE* file) { plain_->write_data(file); }
void PairDCH::write_data_all(FILE* file) { plain_->write_data_all(file); }

double PairDCH::memory_usage() {
  const double pairs = clusters_ ? static_cast<double>(clusters_->memory_bytes()) : 0.0;
  return PlainPair::memory_usage() + pairs;
}

// --------------------------------------------------------------------------------------------------------------------
// Pairs

dch::lammps::Obstacle PairDCH::reason_for_plain() const {
  if (!atom->tag_enable) return {"atoms have no IDs (atom_modify id no)", "'atom_modify id yes'"};
  if (atom->molecular == Atom::TEMPLATE) return {"atom_style template", "another atom style"};
  if (neighbor->includegroup) return {"neigh_modify include", "'neigh_modify include all'"};
  if (GhostsSent::of_one_group(*comm))
    return {"ghosts of one group only (comm_modify group)", "'comm_modify group all'"};
  return {};
}

/// Whether r-RESPA may ask for inner, middle and outer forces. Which levels there are its class does not
/// tell, but the list that the plain style asks for does.
bool PairDCH::may_have_levels() const {
  return plain_->respa_enable && std::strncmp(update->integrate_style, "respa", 5) == 0;
}

/// Has the lists that the plain style has just asked for be ours, unless they are taken back: pair_style
/// hybrid looks for the style that it made.
void PairDCH::take_requests(int first) {
  has_lists_of_plain_ = may_have_levels() && turn_over_requests(*neighbor, first, *plain_, *this);
  if (!has_lists_of_plain_) withdraw_requests(*neighbor, first);
}

void PairDCH::init_style() {
  clusters_.reset();
  pairs_of_types_.clear();
  kernel_.reset();
  computed_ = pair_by_pair_ = 0;
  // The plain style checks its settings, and asks for a list, which is taken back. `dch verify` wants one, in
  // this style's name, to compare with.
  const int requests = neighbor->nrequest;
  plain_->init_style();
  take_requests(requests);
  NeighborDCH* const neighbor_dch = NeighborDCH::install(lmp);
  obstacle_ = reason_for_plain();
  if (obstacle_.empty()) obstacle_ = obstacle_of_settings();
  if (is_chosen_ && obstacle_.empty()) obstacle_ = neighbor_dch->obstacle_to_styles();
  clusters_ = neighbor_dch->request_clusters(*this, name(), obstacle_);
  if (clusters_) clusters_->wants_rows = style_.by_rows;
  if (!has_lists_of_plain_ && (!clusters_ || neighbor_dch->verifies())) neighbor->request(this, instance_me);
}

void PairDCH::init_list(int id, NeighList* neighbors) { plain_->init_list(id, neighbors); }

// --------------------------------------------------------------------------------------------------------------------
// What was chosen

std::string PairDCH::way() const {
  const ClusterList& chosen = *clusters_;
  char pairs[64];
  std::snprintf(pairs, sizeof pairs, "%.3g pairs an atom%s", chosen.pairs_an_atom,
                comm->nprocs > 1 ? " on process 0" : "");
  if (chosen.one_by_one)
    return std::string("pairs one by one, in double precision, as there are ") +
           (chosen.by_size ? "size classes, of which none makes cluster pairs"
                           : std::string(pairs) + ", not more than 9");
  const bool is_mixed = NeighborDCH::install(lmp)->precision() == dch::ForcePrecision::mixed;
  return std::string("cluster pairs, in ") + (is_mixed ? "mixed" : "double") + " precision, as there are " +
         pairs + ", more than 9";
}

dch::lammps::StyleNote PairDCH::explain() const {
  const std::string called = "pair " + name();
  if (clusters_ && clusters_->by_levels)
    return {called,
            "plain style on a neighbor list, as r-RESPA splits the forces of pairs into levels; give "
            "all pair forces one level ('run_style respa ... pair N')"};
  if (!obstacle_.empty())
    return {called, "plain style on a neighbor list, " + obstacle_.reason + "; give " + obstacle_.remedy};
  if (computed_ == 0) return {called, "no run yet"};
  std::string how = way();
  if (pair_by_pair_ > 0)
    how += "; of " + std::to_string(computed_) + " times " + std::to_string(pair_by_pair_) +
           " pair by pair, for computes that ask for each pair";
  return {called, how};
}

}  // namespace LAMMPS_NS
