// SPDX-License-Identifier: GPL-2.0-or-later
#include "atom_points.h"

#include <algorithm>
#include <array>
#include <atom.h>
#include <comm.h>
#include <domain.h>
#include <group.h>
#include <neighbor.h>
#include <numeric>

#include <dch/base/error.hpp>

#include "ghosts_sent.h"

namespace LAMMPS_NS {
namespace {

static_assert(sizeof(dch::Vec3) == 3 * sizeof(double), "positions of LAMMPS are taken as they lie in memory");

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

// In two dimensions LAMMPS makes no ghosts along z, however thin the box.
dch::Box box_of(const Domain& domain) {
  const std::array<bool, 3> periodic{domain.xperiodic != 0, domain.yperiodic != 0,
                                     domain.zperiodic != 0 && domain.dimension == 3};
  if (!periodic[0] && !periodic[1] && !periodic[2]) return dch::Box::none();
  const double *h = domain.h, *edge = domain.prd;
  if (!domain.triclinic) return dch::Box::orthorhombic({edge[0], edge[1], edge[2]}, periodic);
  return dch::Box::triclinic({h[0], 0, 0}, {h[5], h[1], 0}, {h[4], h[3], h[2]}, periodic);
}

/// In two dimensions LAMMPS looks for images of bonded atoms along z nevertheless
/// (Domain::minimum_image_check), and takes those more than half the box's thickness apart for strangers.
bool AtomPoints::is_flat() const {
  if (domain->dimension == 3 || !domain->zperiodic) return true;
  double low = 0, high = 0;
  for (int i = 0; i < atom->nlocal; ++i) {
    low = i == 0 ? atom->x[i][2] : std::min(low, atom->x[i][2]);
    high = i == 0 ? atom->x[i][2] : std::max(high, atom->x[i][2]);
  }
  return high - low <= domain->zprd_half;
}

bool AtomPoints::may_use_box(double radius) const {
  if (comm->nprocs != 1 || GhostsSent::on_one_side(*comm) || !is_flat()) return false;
  try {
    const dch::Box box = box_of(*domain);
    return !box.any_periodic() || radius < box.max_cutoff() * (1 - 1e-9);
  } catch (const dch::Error&) {
    return false;  // a box that LAMMPS takes and the search does not
  }
}

dch::Box AtomPoints::box() const { return in_box_ ? box_of(*domain) : dch::Box::none(); }

void AtomPoints::select_atoms(const GhostChoice& choice) {
  const int all = in_box_ ? atom->nlocal : atom->nlocal + atom->nghost;
  const bool of_group = neighbor->includegroup != 0;
  atoms_.clear();
  left_out_.clear();
  has_ghosts_of_others_ = !choice.sides;
  has_far_ghosts_ = !choice.reach;
  owned_ = of_group ? atom->nfirst : atom->nlocal;  // the group's atoms come first
  count_ = in_box_ ? owned_ : all;
  are_atoms_ = in_box_ || (!of_group && !choice.sides && !choice.reach);
  if (are_atoms_) return;
  atoms_.resize(static_cast<std::size_t>(owned_));
  std::iota(atoms_.begin(), atoms_.end(), 0);
  const int bit = group->bitmask[neighbor->includegroup];
  for (int i = atom->nlocal; i < all; ++i) {
    if ((atom->mask[i] & bit) == 0) continue;
    const bool is_point =
        (!choice.sides || choice.sides->is_taken_here(i)) && (!choice.reach || choice.reach->is_within(i));
    (is_point ? atoms_ : left_out_).push_back(i);
  }
  count_ = static_cast<int>(atoms_.size());
}

std::int32_t AtomPoints::point_of(int i) const {
  if (are_atoms() || i < owned_) return i;
  const auto found = std::lower_bound(atoms_.begin() + owned_, atoms_.end(), i);
  return found != atoms_.end() && *found == i ? static_cast<std::int32_t>(found - atoms_.begin()) : -1;
}

void AtomPoints::take_positions() {
  const auto n = static_cast<std::size_t>(count_);
  const auto* const all = n > 0 ? reinterpret_cast<const dch::Vec3*>(atom->x[0]) : nullptr;
  if (are_atoms_) {
    positions_ = {all, n};
    return;
  }
  gathered_.resize(n);
  for (std::size_t p = 0; p < n; ++p) gathered_[p] = all[atoms_[p]];
  positions_ = gathered_;
}

dch::Span<const dch::Vec3> AtomPoints::present_positions() {
  take_positions();
  return positions_;
}

void AtomPoints::name_in_box() {
  own_keys_.resize(static_cast<std::size_t>(count_));
  for (int p = 0; p < count_; ++p)
    own_keys_[static_cast<std::size_t>(p)] = static_cast<std::uint64_t>(atom->tag[p]);
  keys_ = own_keys_;
}

void AtomPoints::forget_keys() {
  own_keys_ = std::vector<std::uint64_t>();  // {} would keep the memory
  keys_ = {};
}

void AtomPoints::name_in_open_space() {
  tags_.resize(static_cast<std::size_t>(count_));
  images_.resize(static_cast<std::size_t>(owned_));
  for (int p = 0; p < count_; ++p) tags_[static_cast<std::size_t>(p)] = atom->tag[atom_of(p)];
  for (int p = 0; p < owned_; ++p) images_[static_cast<std::size_t>(p)] = unpack(atom->image[atom_of(p)]);
  keys_ = key_maker_.assign(positions_, tags_, images_, lattice_of(*domain));
}

void AtomPoints::gather(bool in_box, const GhostChoice& choice) {
  in_box_ = in_box;
  select_atoms(choice);
  take_positions();
  if (in_box_) {
    name_in_box();
  } else {
    name_in_open_space();
  }
}

dch::Span<const double> AtomPoints::radii() {
  radii_.resize(static_cast<std::size_t>(count_));
  for (int p = 0; p < count_; ++p) radii_[static_cast<std::size_t>(p)] = atom->radius[atom_of(p)];
  return radii_;
}

dch::Span<const std::int32_t> AtomPoints::types() {
  types_.resize(static_cast<std::size_t>(count_));
  for (int p = 0; p < count_; ++p) types_[static_cast<std::size_t>(p)] = atom->type[atom_of(p)] - 1;
  return types_;
}

}  // namespace LAMMPS_NS
