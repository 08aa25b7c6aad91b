// SPDX-License-Identifier: GPL-2.0-or-later
// The forces of the pair styles of this package: over clusters, pair by pair, or by the plain style.
#include <algorithm>
#include <atom.h>
#include <domain.h>
#include <error.h>
#include <force.h>
#include <neighbor.h>
#include <new>

#include <dch/base/error.hpp>

#include "neighbor_dch.h"
#include "pair_dch.h"

namespace LAMMPS_NS {

void PairDCH::compute(int eflag, int vflag) {
  ev_init(eflag, vflag);
  if (!clusters_ || clusters_->by_levels) {
    plain_->compute(eflag, vflag);
    take_sums_of_plain();
    return;
  }
  ++computed_;
  const bool by_atom = eflag_atom || vflag_atom || cvflag_atom || num_tally_compute > 0;
  const bool wants_sums = eflag_either || vflag_either;
  // With newton off each of two processes has half of a pair with a ghost, which the sums do not know.
  const bool has_halves = wants_sums && !clusters_->in_box && !force->newton_pair;
  try {
    refresh();
    if (by_atom || has_halves) {
      ++pair_by_pair_;
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

/// Only where the plain style has lists with these levels.
Pair& PairDCH::plain_of_levels() const {
  if (!has_lists_of_plain_)
    error->all(FLERR, "Pair style " + plain_name_ +
                          "/dch has no inner, middle and outer forces for r-RESPA under pair_style hybrid; "
                          "give 'suffix off' before the pair_style, or all pair forces one level");
  return *plain_;
}

void PairDCH::compute_inner() { plain_of_levels().compute_inner(); }
void PairDCH::compute_middle() { plain_of_levels().compute_middle(); }

void PairDCH::compute_outer(int eflag, int vflag) {
  ev_init(eflag, vflag);
  plain_of_levels().compute_outer(eflag, vflag);
  take_sums_of_plain();
}

void PairDCH::take_sums_of_plain() {
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
