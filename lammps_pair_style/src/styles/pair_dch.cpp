// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_dch.h"

#include <algorithm>
#include <atom.h>
#include <comm.h>
#include <domain.h>
#include <error.h>
#include <force.h>
#include <memory.h>
#include <neighbor.h>
#include <new>
#include <update.h>
#include <utility>

#include <dch/base/error.hpp>

#include "ghosts_sent.h"
#include "lammps_versions.h"
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

PairDCH::PairDCH(LAMMPS* lammps, std::string plain) : Pair(lammps), plain_name_(std::move(plain)) {
  int has_suffix = 0;
  plain_.reset(force->new_pair(plain_name_, 0, has_suffix));
  if (!plain_) {
    error->all(FLERR, "Pair style " + plain_name_ + "/dch needs the pair style " + plain_name_ +
                          ", which this LAMMPS was built without");
  }
  single_enable = plain_->single_enable;
  restartinfo = plain_->restartinfo;
  writedata = plain_->writedata;
  reinitflag = plain_->reinitflag;
  unit_convert_flag = plain_->unit_convert_flag;
  ewaldflag = plain_->ewaldflag;
  pppmflag = plain_->pppmflag;
  msmflag = plain_->msmflag;
  plain_->ncoultablebits = 0;
  no_virial_fdotr_compute = 1;  // where points are the atoms in the box, ghosts get no forces
}

PairDCH::~PairDCH() {
  if (allocated && !copymode) {
    memory->destroy(setflag);
    memory->destroy(cutsq);
  }
}

// --------------------------------------------------------------------------------------------------------------------
// Everything but forces

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
  offset_flag = plain().*(&PairDCH::offset_flag);
  mix_flag = plain().*(&PairDCH::mix_flag);
  tail_flag = plain_->tail_flag;
  ncoultablebits = std::exchange(plain_->ncoultablebits, 0);
}

/// LAMMPS looks at which pairs of types have been given.
void PairDCH::take_coefficients() {
  has_kernel_ = false;
  if (!plain_->allocated) return;
  const int n = atom->ntypes;
  if (!allocated) {
    allocated = 1;
    memory->create(setflag, n + 1, n + 1, "pair:setflag");
    memory->create(cutsq, n + 1, n + 1, "pair:cutsq");
  }
  for (int a = 1; a <= n; ++a)
    for (int b = a; b <= n; ++b) setflag[a][b] = plain_->setflag[a][b];
}

void PairDCH::modify_params(int narg, char** arg) {
  Pair::modify_params(narg, arg);
  plain_->modify_params(narg, arg);
  plain_->ncoultablebits = 0;
  has_kernel_ = false;
}

double PairDCH::init_one(int i, int j) {
  const double cutoff = plain_->init_one(i, j);
  plain_->cutsq[i][j] = plain_->cutsq[j][i] = cutoff * cutoff;
  etail_ij = plain_->etail_ij;
  ptail_ij = plain_->ptail_ij;
  dch::lammps::copy_mixing<Pair>(*plain_, *this);
  has_kernel_ = false;
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

double PairDCH::single(int i, int j, int itype, int jtype, double rsq, double factor_coul, double factor_lj,
                       double& fforce) {
  return plain_->single(i, j, itype, jtype, rsq, factor_coul, factor_lj, fforce);
}

void* PairDCH::extract(const char* name, int& dimension) { return plain_->extract(name, dimension); }

void PairDCH::add_tally_callback(Compute* compute) {
  Pair::add_tally_callback(compute);
  plain_->add_tally_callback(compute);
}

void PairDCH::del_tally_callback(Compute* compute) {
  Pair::del_tally_callback(compute);
  plain_->del_tally_callback(compute);
}

double PairDCH::memory_usage() {
  const double pairs = clusters_ ? static_cast<double>(clusters_->memory_bytes()) : 0.0;
  return Pair::memory_usage() + plain_->memory_usage() + pairs;
}

// --------------------------------------------------------------------------------------------------------------------
// Pairs

std::string PairDCH::reason_for_plain() const {
  if (!atom->tag_enable) return "atoms have no IDs (atom_modify id no)";
  if (atom->molecular == Atom::TEMPLATE) return "atom_style template";
  if (neighbor->includegroup) return "neigh_modify include";
  if (GhostsSent::of_one_group(*comm)) return "ghosts of one group only (comm_modify group)";
  return {};
}

void PairDCH::init_style() {
  clusters_.reset();
  pairs_of_types_.clear();
  has_kernel_ = false;
  // The plain style checks its settings, and asks for a list, which is taken back. `dch verify` wants one, in
  // this style's name, to compare with.
  const int requests = neighbor->nrequest;
  plain_->init_style();
  withdraw_requests(*neighbor, requests);
  const std::string reason = reason_for_plain();
  NeighborDCH* const neighbor_dch = NeighborDCH::install(lmp);
  clusters_ = neighbor_dch->request_clusters(*this, plain_name_ + "/dch", reason);
  if (!clusters_ || neighbor_dch->verifies()) neighbor->request(this, instance_me);
}

void PairDCH::init_list(int id, NeighList* neighbors) { plain_->init_list(id, neighbors); }

// --------------------------------------------------------------------------------------------------------------------
// Forces

void PairDCH::compute(int eflag, int vflag) {
  if (!clusters_) {
    compute_plain(eflag, vflag);
    return;
  }
  ev_init(eflag, vflag);
  const bool by_atom = eflag_atom || vflag_atom || cvflag_atom || num_tally_compute > 0;
  const bool wants_sums = eflag_either || vflag_either;
  // With newton off each of two processes has half of a pair with a ghost, which the sums do not know.
  const bool has_halves = wants_sums && !clusters_->in_box && !force->newton_pair;
  try {
    refresh();
    if (by_atom || has_halves) {
      compute_pair_by_pair();
    } else {
      compute_clusters(wants_sums);
    }
  } catch (const dch::Error& e) {
    error->one(FLERR, "Pair style " + plain_name_ + "/dch: " + e.what());
  } catch (const std::bad_alloc&) {
    error->one(FLERR, "Pair style " + plain_name_ + "/dch: out of memory; use more processes");
  }
  compute_special();
}

void PairDCH::compute_plain(int eflag, int vflag) {
  ev_init(eflag, vflag);
  plain_->compute(eflag, vflag);
  eng_vdwl = plain_->eng_vdwl;
  eng_coul = plain_->eng_coul;
  std::copy_n(plain_->virial, 6, virial);
  const int atoms = atom->nlocal + (force->newton_pair ? atom->nghost : 0);
  if (eflag_atom) std::copy_n(plain_->eatom, atoms, eatom);
  if (vflag_atom)
    for (int i = 0; i < atoms; ++i) std::copy_n(plain_->vatom[i], 6, vatom[i]);
  if (cvflag_atom && plain_->cvatom)
    for (int i = 0; i < atoms; ++i) std::copy_n(plain_->cvatom[i], 9, cvatom[i]);
}

dch::Span<const dch::Vec3> PairDCH::positions(const ClusterList& wanted) const {
  const std::size_t points = wanted.points();
  return {points > 0 ? reinterpret_cast<const dch::Vec3*>(atom->x[0]) : nullptr, points};
}

dch::Box PairDCH::box(const ClusterList& wanted) const {
  return wanted.in_box ? box_of(*domain) : dch::Box::none();
}

void PairDCH::refresh() {
  if (!clusters_->one_by_one)
    clusters_->pairs.refresh(positions(*clusters_), box(*clusters_), NeighborDCH::install(lmp)->executor());
}

void PairDCH::prepare_kernel() {
  if (has_kernel_) return;
  make_kernel(pairs_of_types_);
  has_kernel_ = true;
}

/// With newton off for pairs each process computes its own half of a pair with a ghost. Kernels add to both;
/// LAMMPS would send the other half home where newton is on for bonds.
void PairDCH::compute_clusters(bool with_sums) {
  prepare_kernel();
  const std::size_t points = clusters_->points();
  auto* f = points > 0 ? reinterpret_cast<dch::Vec3*>(atom->f[0]) : nullptr;
  const bool keeps_ghosts = force->newton && !force->newton_pair && !clusters_->in_box;
  if (keeps_ghosts) of_ghosts_.assign(f + atom->nlocal, f + points);
  add_forces(*clusters_, NeighborDCH::install(lmp)->precision(), {f, points}, with_sums);
  if (keeps_ghosts) std::copy(of_ghosts_.begin(), of_ghosts_.end(), f + atom->nlocal);
}

void PairDCH::compute_one(int i, int j, dch::Vec3 from_j_to_i, double factor_lj, double factor_coul) {
  const int a = atom->type[i], b = atom->type[j];
  const double r2 = norm2(from_j_to_i);
  if (r2 >= cutsq[a][b]) return;
  double over_r = 0;
  const double energy = plain_->single(i, j, a, b, r2, factor_coul, factor_lj, over_r);
  double of_charges = 0;
  if (double ignored = 0; eflag_either && has_charges())
    of_charges = plain_->single(i, j, a, b, r2, factor_coul, 0, ignored);
  const dch::Vec3 pull = over_r * from_j_to_i;
  double **f = atom->f, *of_i = f[i], *of_j = f[j];
  of_i[0] += pull.x;
  of_i[1] += pull.y;
  of_i[2] += pull.z;
  if (force->newton_pair || j < atom->nlocal) {
    of_j[0] -= pull.x;
    of_j[1] -= pull.y;
    of_j[2] -= pull.z;
  }
  if (evflag)
    ev_tally(i, j, atom->nlocal, force->newton_pair, energy - of_charges, of_charges, over_r, from_j_to_i.x,
             from_j_to_i.y, from_j_to_i.z);
}

void PairDCH::compute_pair_by_pair() {
  const auto compute_pair = [&](std::int32_t i, std::int32_t j, dch::Vec3 from_i_to_j) {
    if (i < atom->nlocal) {
      compute_one(i, j, -1.0 * from_i_to_j, 1, 1);
    } else {
      compute_one(j, i, from_i_to_j, 1, 1);
    }
  };
  if (clusters_->one_by_one) {
    clusters_->pair_list.for_each(positions(*clusters_), box(*clusters_), compute_pair);
  } else {
    clusters_->pairs.for_each(compute_pair);
  }
}

void PairDCH::compute_special() {
  for (const ClusterList::Special& pair : clusters_->special) {
    const double *xi = atom->x[pair.i], *xj = atom->x[pair.at];
    compute_one(pair.i, pair.j, {xi[0] - xj[0], xi[1] - xj[1], xi[2] - xj[2]}, force->special_lj[pair.kind],
                force->special_coul[pair.kind]);
  }
}

}  // namespace LAMMPS_NS
