// SPDX-License-Identifier: GPL-2.0-or-later
#include "atom_order.h"

#include <algorithm>
#include <atom.h>
#include <comm.h>
#include <cstring>
#include <domain.h>
#include <fix.h>
#include <modify.h>
#include <unordered_map>
#include <update.h>
#include <utility>

#include "fix_dch_order.h"
#include "known_fixes.h"

namespace LAMMPS_NS {

using dch::lammps::OrderAtoms;

namespace {

/// Atom::sort() puts atoms into bins by coordinate and then in the order of the bins. While this lives, bins
/// are a row of cells one long, and the coordinates are those that are given to it. AtomVec, which moves what
/// belongs to atoms, has pointers of its own to where they really are.
class CoordinatesAreRanks {
 public:
  CoordinatesAreRanks(Atom& atom, Domain& domain, double** coordinates)
      : atom_(atom), domain_(domain), heads_(static_cast<std::size_t>(atom.nlocal)) {
    atom.x = coordinates;
    atom.sortfreq = 1;  // by which it divides, and which is 0 once a script has turned sorting off
    atom.*(&Bins::nbins) = atom.*(&Bins::nbinx) = atom.nlocal;
    atom.*(&Bins::nbiny) = atom.*(&Bins::nbinz) = 1;
    atom.*(&Bins::bininvx) = atom.*(&Bins::bininvy) = atom.*(&Bins::bininvz) = 1;
    for (double& low : atom.*(&Bins::bboxlo)) low = 0;
    atom.*(&Bins::binhead) = heads_.data();
    domain.box_change = 0;  // else it would make bins of its own
    domain.triclinic = 0;   // else it would transform coordinates
  }
  ~CoordinatesAreRanks() {
    atom_.x = x_;
    atom_.sortfreq = frequency_;
    atom_.*(&Bins::nbins) = bins_;
    atom_.*(&Bins::nbinx) = x_bins_;
    atom_.*(&Bins::nbiny) = y_bins_;
    atom_.*(&Bins::nbinz) = z_bins_;
    atom_.*(&Bins::bininvx) = per_x_;
    atom_.*(&Bins::bininvy) = per_y_;
    atom_.*(&Bins::bininvz) = per_z_;
    for (int axis = 0; axis < 3; ++axis) (atom_.*(&Bins::bboxlo))[axis] = low_[axis];
    atom_.*(&Bins::binhead) = binhead_;
    domain_.box_change = box_change_;
    domain_.triclinic = triclinic_;
  }
  CoordinatesAreRanks(const CoordinatesAreRanks&) = delete;
  CoordinatesAreRanks& operator=(const CoordinatesAreRanks&) = delete;

 private:
  /// Names of protected members.
  struct Bins : Atom {
    using Atom::bboxlo;
    using Atom::binhead;
    using Atom::bininvx;
    using Atom::bininvy;
    using Atom::bininvz;
    using Atom::nbins;
    using Atom::nbinx;
    using Atom::nbiny;
    using Atom::nbinz;
  };

  Atom& atom_;
  Domain& domain_;
  double** x_ = atom_.x;
  int frequency_ = atom_.sortfreq;
  int bins_ = atom_.*(&Bins::nbins), x_bins_ = atom_.*(&Bins::nbinx), y_bins_ = atom_.*(&Bins::nbiny),
      z_bins_ = atom_.*(&Bins::nbinz);
  double per_x_ = atom_.*(&Bins::bininvx), per_y_ = atom_.*(&Bins::bininvy), per_z_ = atom_.*(&Bins::bininvz);
  double low_[3] = {(atom_.*(&Bins::bboxlo))[0], (atom_.*(&Bins::bboxlo))[1], (atom_.*(&Bins::bboxlo))[2]};
  int* binhead_ = atom_.*(&Bins::binhead);
  int box_change_ = domain_.box_change, triclinic_ = domain_.triclinic;
  std::vector<int> heads_;
};

}  // namespace

void AtomOrder::begin_run() {
  next_ = 0;
  obstacle_.clear();
  if (when_ == OrderAtoms::never) obstacle_ = "'dch order no' was given";
  if (when_ == OrderAtoms::automatic && atom->molecular != Atom::ATOMIC)
    obstacle_ = "atoms have bonds, and nothing is gained ('dch order yes')";
  if (atom->sortfreq <= 0) obstacle_ = "'atom_modify sort' is off";
  const int ours = FixDCHOrder::index_in(*modify);
  for (int k = 0; k < modify->nfix; ++k) {
    const char* const style = modify->fix[k]->style;
    if (ours >= 0 && k > ours && std::strcmp(style, kHistoryFix) == 0)
      obstacle_ = "contacts are saved after the time for it";
    if (when_ == OrderAtoms::automatic && !draws_no_random_numbers(style))
      obstacle_ =
          std::string("fix ") + style + " may draw random numbers in the order of atoms ('dch order yes')";
  }
}

void AtomOrder::note_short_rows() {
  if (when_ == OrderAtoms::automatic && obstacle_.empty())
    obstacle_ = "neighbors are few, and rows are put in the order of atoms ('dch order yes')";
}

void AtomOrder::note_grains() {
  if (when_ == OrderAtoms::automatic && obstacle_.empty())
    obstacle_ = "lists are of grains, where the order costs time ('dch order yes')";
}

bool AtomOrder::is_due() const {
  if (!obstacle_.empty()) return false;
  return update->ntimestep >= next_ || (comm->nprocs == 1 && update->ntimestep >= atom->nextsort);
}

/// Atom::sort() needs room for one atom more.
bool AtomOrder::can_sort() const { return atom->nlocal > 1 && atom->nlocal < atom->nmax; }

std::vector<int> AtomOrder::apply(const std::vector<std::int32_t>& indices) {
  next_ = (update->ntimestep / atom->sortfreq + 1) * atom->sortfreq;
  if (!can_sort()) return {};
  if (comm->nprocs == 1) follow_lammps();
  std::vector<int> places = put(indices);
  if (comm->nprocs > 1) atom->nextsort = next_;
  return places;
}

/// Remembers the order in which LAMMPS would have the atoms. If it would sort them now, it does, as it does
/// behind us: after they have been wrapped.
void AtomOrder::follow_lammps() {
  if (update->ntimestep >= atom->nextsort) {
    restore();
    if (domain->triclinic) domain->x2lamda(atom->nlocal);
    domain->pbc();
    atom->sort();
    if (domain->triclinic) domain->lamda2x(atom->nlocal);
  }
  if (lammps_order_.empty()) lammps_order_.assign(atom->tag, atom->tag + atom->nlocal);
}

bool AtomOrder::restore() {
  const std::vector<tagint> ids = std::exchange(lammps_order_, {});
  const auto n = static_cast<std::size_t>(atom->nlocal);
  if (ids.size() != n || !can_sort())
    return false;  // atoms have come or gone, so the order is another one anyway
  std::unordered_map<tagint, std::int32_t> index;
  index.reserve(n);
  for (std::int32_t i = 0; i < atom->nlocal; ++i) index.emplace(atom->tag[i], i);
  std::vector<std::int32_t> indices;
  indices.reserve(n);
  for (const tagint id : ids) {
    const auto found = index.find(id);
    if (found == index.end()) return false;
    indices.push_back(found->second);
  }
  put(indices);
  return true;
}

std::vector<int> AtomOrder::put(const std::vector<std::int32_t>& indices) {
  const int n = atom->nlocal;
  // What follows an atom's rank, where LAMMPS looks for y and z, makes no difference: there is one bin of
  // them.
  std::vector<double> rank(static_cast<std::size_t>(n) + 2, -1);
  double next = 0.5;
  for (const std::int32_t i : indices)
    if (i >= 0 && i < n && rank[static_cast<std::size_t>(i)] < 0) rank[static_cast<std::size_t>(i)] = next++;
  std::vector<double*> rows;
  rows.reserve(static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
    if (rank[i] < 0) rank[i] = next++;
    rows.push_back(&rank[i]);
  }
  const bigint next_of_lammps = atom->nextsort;
  {
    const CoordinatesAreRanks ranks_in_place(*atom, *domain, rows.data());
    atom->sort();
  }
  atom->nextsort = next_of_lammps;
  return {rank.begin(), rank.begin() + n};
}

}  // namespace LAMMPS_NS
