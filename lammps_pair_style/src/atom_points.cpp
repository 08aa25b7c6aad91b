// SPDX-License-Identifier: GPL-2.0-or-later
#include "atom_points.h"

#include <atom.h>
#include <domain.h>
#include <group.h>
#include <neighbor.h>
#include <numeric>

namespace LAMMPS_NS {
namespace {

dch::lammps::ImageFlags unpack(imageint image) {
  return {static_cast<int>(image & IMGMASK) - IMGMAX, static_cast<int>(image >> IMGBITS & IMGMASK) - IMGMAX,
          static_cast<int>(image >> IMG2BITS) - IMGMAX};
}

dch::lammps::Lattice lattice_of(const Domain& domain) {
  dch::lammps::Lattice lattice;
  for (std::size_t k = 0; k < 6; ++k) {
    lattice.inverse[k] = k < 3 || domain.triclinic ? domain.h_inv[k] : 0.0;
  }
  for (std::size_t k = 0; k < 3; ++k) lattice.periodic[k] = domain.periodicity[k] != 0;
  lattice.low = {domain.boxlo[0], domain.boxlo[1], domain.boxlo[2]};
  return lattice;
}

}  // namespace

void AtomPoints::select_atoms() {
  const int all = atom->nlocal + atom->nghost;
  if (!neighbor->includegroup) {
    owned_ = atom->nlocal;
    atoms_.resize(static_cast<std::size_t>(all));
    std::iota(atoms_.begin(), atoms_.end(), 0);
    return;
  }
  owned_ = atom->nfirst;
  atoms_.resize(static_cast<std::size_t>(owned_));
  std::iota(atoms_.begin(), atoms_.end(), 0);
  const int bit = group->bitmask[neighbor->includegroup];
  for (int i = atom->nlocal; i < all; ++i) {
    if (atom->mask[i] & bit) atoms_.push_back(i);
  }
}

void AtomPoints::gather() {
  select_atoms();
  const std::size_t n = atoms_.size();
  positions_.resize(n);
  types_.resize(n);
  tags_.resize(n);
  images_.resize(static_cast<std::size_t>(owned_));
  for (std::size_t p = 0; p < n; ++p) {
    const int i = atoms_[p];
    const double* x = atom->x[i];
    positions_[p] = {x[0], x[1], x[2]};
    types_[p] = atom->type[i] - 1;
    tags_[p] = atom->tag[i];
  }
  for (std::size_t p = 0; p < images_.size(); ++p) images_[p] = unpack(atom->image[atoms_[p]]);
  keys_ = key_maker_.assign(positions_, tags_, images_, lattice_of(*domain));
}

}  // namespace LAMMPS_NS
