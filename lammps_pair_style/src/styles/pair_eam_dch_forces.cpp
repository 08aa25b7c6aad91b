// SPDX-License-Identifier: GPL-2.0-or-later
// The forces of eam/dch, eam/alloy/dch and eam/fs/dch.
#include <algorithm>
#include <atom.h>
#include <cmath>
#include <comm.h>
#include <error.h>
#include <force.h>
#include <neigh_list.h>

#include "atom_vectors.h"
#include "lammps_versions.h"
#include "pair_eam_dch.h"

namespace LAMMPS_NS {

/// `fix adapt` writes into the plain style's array.
bool PairEAMDCH::is_scaled() const {
  int dimension = 0;
  const auto* const* const scale = static_cast<double**>(plain_->extract("scale", dimension));
  if (!scale || dimension != 2) return false;
  for (int a = 1; a <= atom->ntypes; ++a)
    for (int b = a; b <= atom->ntypes; ++b)
      if (plain_->setflag[a][b] && scale[a][b] != 1.0) return true;
  return false;
}

void PairEAMDCH::compute(int eflag, int vflag) {
  ev_init(eflag, vflag);
  ++computed_;
  is_by_plain_ = !obstacle_.empty() || is_scaled();
  if (is_by_plain_) {
    if (obstacle_.empty()) ++scaled_;
    compute_plain(eflag, vflag);
    return;
  }
  stop_if_it_fails([this] {
    if (!atoms_) {
      dch::EmbeddedAtomParams params = dch::lammps::functions_of(files_, format_, of_types_);
      params.cutoff = cutoff_;
      atoms_ = std::make_unique<dch::EmbeddedAtoms>(params);
    }
    add_densities();
    embed();
    add_forces();
  });
  if (vflag_fdotr) virial_fdotr_compute();
}

dch::NeighborRows PairEAMDCH::rows() const {
  const NeighList& of_plain = *plain_->list;
  return {{of_plain.ilist, static_cast<std::size_t>(of_plain.inum)},
          of_plain.numneigh,
          of_plain.firstneigh,
          NEIGHMASK};
}

void PairEAMDCH::add_densities() {
  const int all = atom->nlocal + atom->nghost;
  const auto count = static_cast<std::size_t>(all);
  densities_.assign(count, 0);
  slopes_.assign(count, 0);
  if (all > 0) atoms_->add_densities(rows(), vectors(atom->x, 0, all), {atom->type, count}, densities_);
  if (force->newton_pair) dch::lammps::reverse_communication(*comm, this);
}

void PairEAMDCH::embed() {
  const NeighList& of_plain = *plain_->list;
  for (int row = 0; row < of_plain.inum; ++row) {
    const int i = of_plain.ilist[row];
    const auto k = static_cast<std::size_t>(i);
    const dch::EmbeddedAtoms::Embedding found = atoms_->embedding(atom->type[i], densities_[k]);
    slopes_[k] = found.slope;
    if (eflag_global) eng_vdwl += found.energy;
    if (eflag_atom) eatom[i] += found.energy;
  }
  dch::lammps::forward_communication(*comm, this);
}

void PairEAMDCH::add_forces() {
  const int all = atom->nlocal + atom->nghost;
  if (all == 0) return;
  const auto count = static_cast<std::size_t>(all);
  const bool sums_pairs = (eflag_global && !force->newton_pair) || eflag_atom ||
                          (vflag_either && !vflag_fdotr) || vflag_atom || num_tally_compute > 0;
  dch::EmbeddedAtoms::PairVisitor visit;
  if (sums_pairs)
    visit = [&](dch::Span<const dch::EmbeddedPair> pairs) {
      for (const dch::EmbeddedPair& pair : pairs) {
        const dch::Vec3& d = pair.from_j_to_i;
        ev_tally(pair.i, pair.j, atom->nlocal, force->newton_pair, pair.energy, 0, pair.force_over_r, d.x,
                 d.y, d.z);
      }
    };
  const double energy =
      atoms_->add_forces(rows(), {atom->type, count}, slopes_, vectors(atom->f, 0, all), visit);
  if (eflag_global && !sums_pairs) eng_vdwl += energy;
}

/// An atom's energy of embedding is shared out among the pairs of its row. The plain style takes the share
/// for a part of z / r, and so does the slope here.
double PairEAMDCH::single(int i, int j, int itype, int jtype, double rsq, double factor_coul,
                          double factor_lj, double& fforce) {
  if (is_by_plain_) return PlainPair::single(i, j, itype, jtype, rsq, factor_coul, factor_lj, fforce);
  if (!atoms_) error->one(FLERR, std::string("EAM embedding data required for this calculation is missing"));
  const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
  const std::int32_t shares = atoms_->pairs_of(i);
  const double embedding = shares > 0 ? atoms_->embedding(itype, densities_[a]).energy / shares : 0;
  const double r = std::sqrt(rsq);
  const dch::EmbeddedAtoms::OfPair pair = atoms_->of_pair(itype, jtype, r);
  const double slope = slopes_[a] * pair.slope_of_density_of_first +
                       slopes_[b] * pair.slope_of_density_of_second + pair.slope - embedding / r;
  fforce = -slope / r;
  return embedding + pair.energy;
}

// --------------------------------------------------------------------------------------------------------------------
// Densities go to owned atoms, slopes of embedding energies to ghosts

int PairEAMDCH::pack_forward_comm(int n, int* atoms, double* to, int, int*) {
  for (int k = 0; k < n; ++k) to[k] = slopes_[static_cast<std::size_t>(atoms[k])];
  return n;
}

void PairEAMDCH::unpack_forward_comm(int n, int first, double* from) {
  std::copy_n(from, n, slopes_.begin() + first);
}

int PairEAMDCH::pack_reverse_comm(int n, int first, double* to) {
  std::copy_n(densities_.begin() + first, n, to);
  return n;
}

void PairEAMDCH::unpack_reverse_comm(int n, int* atoms, double* from) {
  for (int k = 0; k < n; ++k) densities_[static_cast<std::size_t>(atoms[k])] += from[k];
}

}  // namespace LAMMPS_NS
