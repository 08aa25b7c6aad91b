// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_gran_dch.h"

#include <algorithm>
#include <atom.h>
#include <cstring>
#include <error.h>
#include <fix.h>
#include <force.h>
#include <modify.h>
#include <neighbor.h>
#include <update.h>

#include <dch/base/error.hpp>

#include "atom_vectors.h"
#include "neighbor_dch.h"
#include "restart_numbers.h"

namespace LAMMPS_NS {

// LAMMPS numbers pair styles as they are made, and the fix that keeps the history has the number in its ID,
// by which restart files name it. So the plain style has the number that it has in a stock LAMMPS.
PairGranDCH::PairGranDCH(LAMMPS* lammps, const char* plain, dch::ContactForm form)
    : PlainPair(lammps, plain), form_(form) {
  --instance_total;
  make_plain("GRANULAR");
  single_extra = plain_->single_extra;
  svector = plain_->svector;
  finitecutflag = plain_->finitecutflag;
  centroidstressflag = plain_->centroidstressflag;
  no_virial_fdotr_compute = plain_->no_virial_fdotr_compute;
  beyond_contact = plain_->beyond_contact;
  nondefault_history_transfer = plain_->nondefault_history_transfer;
  comm_forward = plain_->comm_forward;  // which the plain style does itself
}

// --------------------------------------------------------------------------------------------------------------------
// What a script says

void PairGranDCH::settings(int narg, char** arg) {
  plain_->settings(narg, arg);
  limits_damping_ = narg > 6 && std::strcmp(arg[6], "limit_damping") == 0;
}

void PairGranDCH::coeff(int narg, char** arg) {
  plain_->coeff(narg, arg);
  take_flags_by_types();
}

/// Restart files do not say whether damping is limited.
void PairGranDCH::read_restart(FILE* file) {
  plain_->read_restart(file);
  limits_damping_ = false;
  take_flags_by_types();
}

void PairGranDCH::read_restart_settings(FILE* file) {
  plain_->read_restart_settings(file);
  limits_damping_ = false;
}

void PairGranDCH::write_restart(FILE* file) { plain_->write_restart(file); }
void PairGranDCH::write_restart_settings(FILE* file) { plain_->write_restart_settings(file); }

double PairGranDCH::atom2cut(int i) { return plain_->atom2cut(i); }
double PairGranDCH::radii2cut(double first, double second) { return plain_->radii2cut(first, second); }

double PairGranDCH::memory_usage() {
  const std::size_t ours = columns_.memory_bytes() + bodies_.capacity() * sizeof(dch::GrainBody);
  return PlainPair::memory_usage() + static_cast<double>(ours);
}

// --------------------------------------------------------------------------------------------------------------------
// A run begins

dch::lammps::Obstacle PairGranDCH::reason_for_plain() {
  for (int k = 0; k < modify->nfix; ++k)
    if (modify->fix[k]->rigid_flag)
      return {std::string("masses of bodies count (fix ") + modify->fix[k]->style + ")", {}};
  if (has_history() && !history_.find(*modify, *plain_))
    return {"this LAMMPS keeps the history of contacts in another way", "'suffix off' before the style"};
  if (is_chosen_) return NeighborDCH::install(lmp)->obstacle_to_choice();
  return {};
}

void PairGranDCH::init_style() {
  init_plain_with_lists();
  obstacle_ = reason_for_plain();
  computed_ = 0;
  has_columns_ = false;
  timestep_ = update->dt;
  frozen_group_ = 0;
  for (int k = modify->nfix - 1; k >= 0; --k)
    if (std::strncmp(modify->fix[k]->style, "freeze", 6) == 0) frozen_group_ = modify->fix[k]->groupbit;
  make_contacts();
}

void PairGranDCH::make_contacts() {
  const RestartNumbers numbers(*plain_, plain_name_, atom->ntypes, 0, {}, *error);
  const double* const all = numbers.all();
  try {
    contacts_ = std::make_unique<dch::GrainContacts>(
        dch::ContactParams{form_, all[0], all[1], all[2], all[3], all[4], limits_damping_});
  } catch (const dch::Error& e) {
    error->all(FLERR, title() + ": " + e.what());
  }
}

void PairGranDCH::reset_dt() {
  plain_->reset_dt();
  timestep_ = update->dt;
}

// --------------------------------------------------------------------------------------------------------------------
// Forces

void PairGranDCH::compute(int eflag, int vflag) {
  ev_init(eflag, vflag);
  if (!obstacle_.empty()) {
    compute_plain(eflag, vflag);
    return;
  }
  ++computed_;
  stop_if_it_fails([this] {
    take_list();
    add_contacts();
  });
  if (vflag_fdotr) virial_fdotr_compute();
}

/// Its pairs, if it has been built since they were taken.
void PairGranDCH::take_list() {
  if (has_columns_ && neighbor->ago > 0 && builds_ == neighbor->ncalls) return;
    // Later versions leave out pairs of bonded atoms with weight 0, and have the mark of contacts elsewhere.
#ifdef HISTBITS
  const double* const weights = force->special_lj;
#else
  static constexpr double weights[4] = {1, 1, 1, 1};
#endif
  columns_.take(*plain_->list, has_history() ? &history_ : nullptr, weights);
  has_columns_ = true;
  builds_ = neighbor->ncalls;
}

void PairGranDCH::take_bodies(std::size_t grains) {
  bodies_.resize(grains);
  for (std::size_t i = 0; i < grains; ++i)
    bodies_[i] = {atom->radius[i], atom->rmass[i], (atom->mask[i] & frozen_group_) != 0 ? 1.0 : 0.0};
}

void PairGranDCH::add_contacts() {
  if (columns_.pairs() == 0) return;
  const int all = atom->nlocal + atom->nghost;
  take_bodies(static_cast<std::size_t>(all));
  const dch::Grains grains{vectors(atom->x, 0, all),
                           vectors(atom->v, 0, all),
                           vectors(atom->omega, 0, all),
                           bodies_,
                           static_cast<std::size_t>(force->newton_pair ? all : atom->nlocal),
                           vectors(atom->f, 0, all),
                           vectors(atom->torque, 0, all)};
  const double timestep = update->setupflag ? -1.0 : timestep_;
  found_.clear();
  for (const ContactColumns::Piece& piece : columns_.pieces())
    contacts_->add_forces(grains, {piece.i, piece.j, piece.marks, piece.values}, timestep,
                          evflag ? &found_ : nullptr);
  for (const dch::GrainContact& contact : found_) {
    const dch::Vec3 &f = contact.force, &d = contact.from_j_to_i;
    ev_tally_xyz(contact.i, contact.j, atom->nlocal, force->newton_pair, 0.0, 0.0, f.x, f.y, f.z, d.x, d.y,
                 d.z);
  }
}

dch::lammps::StyleNote PairGranDCH::explain() const {
  return note("SIMD kernel of pairs that touch, in double precision, on one thread");
}

}  // namespace LAMMPS_NS
