// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_necklace_crossing.h"

#include <algorithm>
#include <atom.h>
#include <cmath>
#include <comm.h>
#include <domain.h>
#include <error.h>
#include <neighbor.h>
#include <update.h>

#include <dch/base/error.hpp>

#include "finite_number.h"
#include "ghosts_sent.h"
#include "lammps_versions.h"

namespace LAMMPS_NS {
namespace {

dch::Box box_of(const dch::lammps::Cell& cell) {
  const auto& h = cell.h;
  if (!cell.periodic[0] && !cell.periodic[1] && !cell.periodic[2]) return dch::Box::none();
  if (h[3] == 0 && h[4] == 0 && h[5] == 0) return dch::Box::orthorhombic({h[0], h[1], h[2]}, cell.periodic);
  return dch::Box::triclinic({h[0], 0, 0}, {h[5], h[1], 0}, {h[4], h[3], h[2]}, cell.periodic);
}

}  // namespace

FixNecklaceCrossing::FixNecklaceCrossing(LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg),
      name_(std::string("Fix necklace/crossing ") + arg[0] + ": "),
      pasts_(lammps),
      atoms_(lammps, pasts_),
      bonds_(lammps),
      log_(lammps) {
  if (narg < 4)
    error->all(FLERR, name_ +
                          "the number of steps between checks is missing; for example "
                          "'fix cross all necklace/crossing 10'");
  const double every = finite_number(arg[3]);
  if (!(every >= 1 && every <= MAXSMALLINT && every == std::floor(every)))
    error->all(FLERR, name_ + "'" + arg[3] + "' steps between checks; has to be a whole number of 1 or more");
  nevery = static_cast<int>(every);
  read_keywords(narg, arg);
  if (atom->molecular != Atom::MOLECULAR || atom->num_bond == nullptr)
    error->all(FLERR, name_ + "the atom style has no bonds of its own; chains need one like bond or full");
  if (domain->dimension != 3)
    error->all(FLERR, name_ + "in two dimensions chains cannot go around each other; the fix needs three");
  if (!atom->tag_enable) error->all(FLERR, name_ + "atoms have no IDs; leave out 'atom_modify id no'");
  scalar_flag = vector_flag = local_flag = 1;
  size_vector = 6;
  global_freq = local_freq = 1;
  extscalar = extvector = 0;  // numbers of events, which thermo output does not divide by that of atoms
  size_local_rows = 0;
  size_local_cols = 9;
  restart_global = restart_peratom = 1;
  create_attribute = 1;
  dynamic_group_allow = 1;
  stores_ids = 1;  // of the partners of atoms
  grow_arrays(atom->nmax);
  maxexchange = pasts_.most_numbers();
  for (int i = 0; i < atom->nlocal; ++i) pasts_.forget(i);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
}

FixNecklaceCrossing::~FixNecklaceCrossing() {
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
}

void FixNecklaceCrossing::read_keywords(int narg, char** arg) {
  for (int at = 4; at < narg; at += 2) {
    const std::string keyword = arg[at];
    if (keyword != "action" && keyword != "thickness")
      error->all(FLERR, name_ + "unknown keyword '" + keyword + "'; there are action and thickness");
    if (at + 1 == narg) error->all(FLERR, name_ + "'" + keyword + "' lacks its value");
    const std::string value = arg[at + 1];
    if (keyword == "action") {
      if (value != "warn" && value != "stop" && value != "count")
        error->all(FLERR, name_ + "action is '" + value + "' but has to be warn, stop or count");
      action_ = value == "warn" ? Action::warn : value == "stop" ? Action::stop : Action::count;
    } else {
      thickness_ = finite_number(arg[at + 1]);
      if (!(thickness_ >= 0))
        error->all(FLERR, name_ + "thickness is '" + value + "' but has to be a distance of 0 or more");
    }
  }
}

int FixNecklaceCrossing::setmask() { return FixConst::END_OF_STEP | FixConst::POST_RUN; }

void FixNecklaceCrossing::init() {
  if (atom->bond_per_atom != pasts_.bonds_per_atom()) grow_arrays(atom->nmax);
  comm_alone_ = comm->nprocs == 1;
  maxexchange = pasts_.most_numbers();
  comm_forward = 6 + std::max(1, atom->bond_per_atom);
  if (comm_alone_) return;
  if (comm->mode != Comm::SINGLE)
    error->all(FLERR, name_ +
                          "of several processes each needs the ghosts of all types of atoms alike; use "
                          "'comm_modify mode single'");
  if (GhostsSent::of_one_group(*comm))
    error->all(FLERR, name_ + "'comm_modify group' leaves out ghosts; use 'comm_modify group all'");
}

/// Within which distance of this process's part of the box ghosts are.
double FixNecklaceCrossing::ghost_reach() const {
  const double* const cut = comm->cutghost;
  if (!domain->triclinic) return std::min({cut[0], cut[1], cut[2]});
  // In a tilted box these are fractions of it.
  const double* const inverse = domain->h_inv;
  const double x = std::sqrt(inverse[0] * inverse[0] + inverse[5] * inverse[5] + inverse[4] * inverse[4]);
  const double y = std::sqrt(inverse[1] * inverse[1] + inverse[3] * inverse[3]);
  return std::min({cut[0] / x, cut[1] / y, cut[2] / inverse[2]});
}

dch::lammps::Cell FixNecklaceCrossing::cell() const {
  dch::lammps::Cell cell;
  const std::size_t numbers = domain->triclinic ? 6 : 3;
  std::copy_n(domain->h, numbers, cell.h.begin());
  cell.low = {domain->boxlo[0], domain->boxlo[1], domain->boxlo[2]};
  // In two dimensions LAMMPS makes no ghosts along z, however thin the box.
  cell.periodic = {domain->xperiodic != 0, domain->yperiodic != 0,
                   domain->zperiodic != 0 && domain->dimension == 3};
  return cell;
}

void FixNecklaceCrossing::note_box() {
  old_box_ = cell();
  old_step_ = update->ntimestep;
}

/// The atoms at the beginning of the first run are the past of the first check. In a later run the past is
/// that of the last check in the run before, or the one from the restart file.
void FixNecklaceCrossing::setup(int) {
  run_begin_ = update->ntimestep;
  run_crossings_ = total_.crossings;
  run_undetermined_ = total_.undetermined;
  const bool is_first = old_step_ < 0;
  const dch::lammps::BoxStep standing(cell(), cell());
  if (is_first) {
    atoms_.begin(standing, groupbit);
    atoms_.finish();
    note_box();
  }
  if (!comm_alone_ && !has_checked_ghosts_) check_ghosts();
  has_checked_ghosts_ = true;
}

void FixNecklaceCrossing::end_of_step() {
  try {
    check();
  } catch (const dch::Error& e) {
    error->one(FLERR, name_ + e.what());
  }
}

void FixNecklaceCrossing::check() {
  const dch::lammps::BoxStep step(old_box_, cell());
  atoms_.begin(step, groupbit);
  old_box_ = step.before();
  if (!comm_alone_) {
    int mine = atoms_.most_bonds(), most = 0;
    MPI_Allreduce(&mine, &most, 1, MPI_INT, MPI_MAX, world);
    atoms_.expect_ghosts(std::max(1, most));
    dch::lammps::forward_communication(*comm, this, atoms_.numbers());
  }
  find(step);
  add_up();
  if (found_ > 0) {
    const auto now = static_cast<double>(update->ntimestep);
    const auto then = old_step_ < update->ntimestep ? static_cast<double>(old_step_) : now - nevery;
    log_.gather(finder_.crossings(), atoms_, then, now);
  } else {
    log_.clear();
  }
  keep_rows();
  atoms_.finish();
  note_box();
  act();
}

void FixNecklaceCrossing::find(const dch::lammps::BoxStep& step) {
  MovingBonds::Limits limits;
  limits.in_box = comm_alone_;
  limits.length = std::min(step.before().half_height(), step.now().half_height());
  box_ = comm_alone_ ? box_of(step.middle()) : dch::Box::none();
  limits.extent = comm_alone_ ? box_.max_cutoff() * (1 - 1e-6) - 2 * thickness_
                              : 0.5 * (ghost_reach() - neighbor->skin - 2 * thickness_);
  reach_ = limits.extent;
  bonds_.gather(atoms_, step, limits);
  finder_.find(bonds_, box_, step.middle(), thickness_);
}

void FixNecklaceCrossing::add_up() {
  const PairCounts& counts = finder_.counts();
  std::array<bigint, 5> mine{static_cast<bigint>(finder_.crossings().size()), counts.contacts,
                             bonds_.undetermined(), counts.near, counts.rejected};
  std::array<bigint, 5> all{};
  MPI_Allreduce(mine.data(), all.data(), 5, MPI_LMP_BIGINT, MPI_SUM, world);
  found_ = all[0];
  undetermined_ = all[2];
  total_.crossings += static_cast<double>(all[0]);
  total_.contacts += static_cast<double>(all[1]);
  total_.undetermined += static_cast<double>(all[2]);
  total_.near += static_cast<double>(all[3]);
  total_.rejected += static_cast<double>(all[4]);
}

void FixNecklaceCrossing::keep_rows() {
  rows_.clear();
  for (const CrossingEvent& event : log_.events()) {
    if (event.process != comm->me) continue;
    double place[3] = {event.place.x, event.place.y, event.place.z};
    domain->remap(place);
    const auto& tags = event.tags;
    rows_.push_back({static_cast<double>(tags[0]), static_cast<double>(tags[1]), static_cast<double>(tags[2]),
                     static_cast<double>(tags[3]), event.step, static_cast<double>(event.sign), place[0],
                     place[1], place[2]});
  }
  row_starts_.clear();
  for (auto& row : rows_) row_starts_.push_back(row.data());
  size_local_rows = static_cast<int>(rows_.size());
  array_local = row_starts_.data();
}

double FixNecklaceCrossing::compute_scalar() { return total_.crossings; }

double FixNecklaceCrossing::compute_vector(int n) {
  const std::array<double, 6> all{static_cast<double>(found_), total_.crossings, total_.contacts,
                                  total_.undetermined,         total_.near,      total_.rejected};
  return all[static_cast<std::size_t>(n)];
}

double FixNecklaceCrossing::memory_usage() {
  return pasts_.memory_bytes() + atoms_.memory_bytes() + bonds_.memory_bytes() + finder_.memory_bytes() +
         static_cast<double>(rows_.size() * sizeof(rows_[0]));
}

}  // namespace LAMMPS_NS
