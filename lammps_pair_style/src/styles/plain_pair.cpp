// SPDX-License-Identifier: GPL-2.0-or-later
#include "plain_pair.h"

#include <algorithm>
#include <atom.h>
#include <force.h>
#include <memory.h>
#include <neighbor.h>
#include <utility>

#include "lammps_versions.h"
#include "neigh_history.h"
#include "stock_name.h"

namespace LAMMPS_NS {

void make_arrays_by_types(Pair& style, int types, Memory& memory) {
  if (std::exchange(style.allocated, 1)) return;
  memory.create(style.setflag, types + 1, types + 1, "pair:setflag");
  memory.create(style.cutsq, types + 1, types + 1, "pair:cutsq");
}

void give_up_arrays_by_types(Pair& style, Memory& memory) {
  if (!std::exchange(style.allocated, 0)) return;
  memory.destroy(style.setflag);
  memory.destroy(style.cutsq);
}

PlainPair::~PlainPair() {
  if (!copymode) give_up_arrays_by_types(*this, *memory);
}

void PlainPair::make_plain(const std::string& package) {
  int has_suffix = 0;
  plain_.reset(force->new_pair(dch::lammps::stock_name(*force->pair_map, plain_name_), 0, has_suffix));
  if (!plain_)
    error->all(FLERR, title() + " needs the pair style " + plain_name_ +
                          ", which this LAMMPS was built without" +
                          (package.empty() ? "" : " (package " + package + ")"));
  single_enable = plain_->single_enable;
  restartinfo = plain_->restartinfo;
  writedata = plain_->writedata;
  reinitflag = plain_->reinitflag;
  unit_convert_flag = plain_->unit_convert_flag;
  respa_enable = plain_->respa_enable;
}

void PlainPair::take_flags_by_types() {
  if (!plain_->allocated) return;
  const int types = atom->ntypes;
  make_arrays_by_types(*this, types, *memory);
  for (int a = 1; a <= types; ++a)
    for (int b = a; b <= types; ++b) setflag[a][b] = plain_->setflag[a][b];
}

void PlainPair::modify_params(int narg, char** arg) {
  Pair::modify_params(narg, arg);
  plain_->modify_params(narg, arg);
}

void PlainPair::init_plain_with_lists() {
  const int requests = neighbor->nrequest;
  plain_->init_style();
  const bool is_ours = turn_over_requests(*neighbor, requests, *plain_, *this);
  if (!is_ours && force->pair != this)
    error->all(FLERR, title() + " does not know how this LAMMPS asks for lists in pair_style hybrid; give " +
                          plain_name_ + " there");
}

void PlainPair::init_list(int id, NeighList* neighbors) {
  Pair::init_list(id, neighbors);
  plain_->init_list(id, neighbors);
}

double PlainPair::init_one(int i, int j) {
  const double cutoff = plain_->init_one(i, j);
  plain_->cutsq[i][j] = plain_->cutsq[j][i] = cutoff * cutoff;
  dch::lammps::copy_mixing<Pair>(*plain_, *this);
  return cutoff;
}

void PlainPair::compute_plain(int eflag, int vflag) {
  plain_->compute(eflag, vflag);
  take_sums_of_plain();
}

void PlainPair::take_sums_of_plain() {
  const int atoms = atom->nlocal + (force->newton_pair ? atom->nghost : 0);
  eng_vdwl = plain_->eng_vdwl;
  eng_coul = plain_->eng_coul;
  std::copy_n(plain_->virial, 6, virial);
  if (eflag_atom) std::copy_n(plain_->eatom, atoms, eatom);
  if (vflag_atom)
    for (int i = 0; i < atoms; ++i) std::copy_n(plain_->vatom[i], 6, vatom[i]);
  if (cvflag_atom && plain_->cvatom)
    for (int i = 0; i < atoms; ++i) std::copy_n(plain_->cvatom[i], 9, cvatom[i]);
}

double PlainPair::single(int i, int j, int itype, int jtype, double rsq, double factor_coul, double factor_lj,
                         double& fforce) {
  return plain_->single(i, j, itype, jtype, rsq, factor_coul, factor_lj, fforce);
}

void* PlainPair::extract(const char* name, int& dimension) { return plain_->extract(name, dimension); }

void PlainPair::add_tally_callback(Compute* compute) {
  Pair::add_tally_callback(compute);
  plain_->add_tally_callback(compute);
}

void PlainPair::del_tally_callback(Compute* compute) {
  Pair::del_tally_callback(compute);
  plain_->del_tally_callback(compute);
}

double PlainPair::memory_usage() { return Pair::memory_usage() + plain_->memory_usage(); }

dch::lammps::StyleNote PlainPair::note(const std::string& how) const {
  if (!obstacle_.empty())
    return {"pair " + name(), "plain style, as " + obstacle_.reason +
                                  (obstacle_.remedy.empty() ? std::string() : "; give " + obstacle_.remedy)};
  return {"pair " + name(), computed_ == 0 ? "no run yet" : how};
}

}  // namespace LAMMPS_NS
