// SPDX-License-Identifier: GPL-2.0-or-later
#include "atom_order.h"

#include <atom.h>
#include <domain.h>
#include <update.h>
#include <utility>

namespace LAMMPS_NS {
namespace {

/// Atom::sort() puts atoms into bins by coordinate and then in the order of the bins. While this lives, bins
/// are a row of cells one long, and the coordinates are those that are given to it. AtomVec, which moves what
/// belongs to atoms, has pointers of its own to where they really are.
class CoordinatesAreRanks {
 public:
  CoordinatesAreRanks(Atom& atom, Domain& domain, double** coordinates)
      : atom_(atom), domain_(domain), heads_(static_cast<std::size_t>(atom.nlocal)) {
    atom.x = coordinates;
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
  int bins_ = atom_.*(&Bins::nbins), x_bins_ = atom_.*(&Bins::nbinx), y_bins_ = atom_.*(&Bins::nbiny),
      z_bins_ = atom_.*(&Bins::nbinz);
  double per_x_ = atom_.*(&Bins::bininvx), per_y_ = atom_.*(&Bins::bininvy), per_z_ = atom_.*(&Bins::bininvz);
  double low_[3] = {(atom_.*(&Bins::bboxlo))[0], (atom_.*(&Bins::bboxlo))[1], (atom_.*(&Bins::bboxlo))[2]};
  int* binhead_ = atom_.*(&Bins::binhead);
  int box_change_ = domain_.box_change, triclinic_ = domain_.triclinic;
  std::vector<int> heads_;
};

}  // namespace

bool AtomOrder::will_be_due() const {
  constexpr int kStepsBetweenLists = 100;  // at most, as a rule
  return atom->sortfreq > 0 && atom->tag_enable && update->ntimestep + kStepsBetweenLists >= next_;
}

bool AtomOrder::is_due() const {
  return atom->sortfreq > 0 && update->ntimestep >= next_ && !tags_.empty() && atom->tag_enable;
}

void AtomOrder::remember(const std::vector<std::int32_t>& indices) {
  tags_.clear();
  seen_.assign(static_cast<std::size_t>(atom->nlocal), 0);
  for (const std::int32_t i : indices) {
    if (i < 0 || i >= atom->nlocal || std::exchange(seen_[static_cast<std::size_t>(i)], 1) != 0) continue;
    tags_.push_back(atom->tag[i]);
  }
}

void AtomOrder::apply() {
  next_ = (update->ntimestep / atom->sortfreq + 1) * atom->sortfreq;
  const int n = atom->nlocal;
  if (n < 2 || n >= atom->nmax) return;
  dch::lammps::TagTable rank_of;
  rank_of.reset(tags_.size());
  std::int32_t ranks = 0;
  for (const tagint tag : tags_) rank_of.find_or_add(tag, ranks++);
  // Those that are there now, in their order, then those that are not known: ranks from 0 to n - 1.
  std::vector<int> at(tags_.size(), -1);
  std::vector<int> unknown;
  for (int i = 0; i < n; ++i) {
    const std::int32_t rank = rank_of.find(atom->tag[i]);
    if (rank == dch::lammps::TagTable::kAbsent) {
      unknown.push_back(i);
    } else {
      at[static_cast<std::size_t>(rank)] = i;
    }
  }
  std::vector<double> coordinates(3 * static_cast<std::size_t>(n), 0.5);
  std::vector<double*> rows(static_cast<std::size_t>(n));
  double next = 0.5;
  for (const int i : at)
    if (i >= 0) coordinates[3 * static_cast<std::size_t>(i)] = next++;
  for (const int i : unknown) coordinates[3 * static_cast<std::size_t>(i)] = next++;
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = &coordinates[3 * i];
  {
    const CoordinatesAreRanks ranks_in_place(*atom, *domain, rows.data());
    atom->sort();
  }
  atom->nextsort = next_;
}

}  // namespace LAMMPS_NS
