// SPDX-License-Identifier: GPL-2.0-or-later
#include "stock_builds.h"

#include <atom.h>
#include <neighbor.h>
#include <update.h>
#include <utility>

namespace LAMMPS_NS {

int StockBuilds::owned() const { return neighbor->includegroup ? atom->nfirst : atom->nlocal; }

dch::Vec3 StockBuilds::place(int i) const {
  const double* const x = atom->x[i];
  return {x[0], x[1], x[2]};
}

bool StockBuilds::is_due(bool moved_far, double trigger2) const {
  if (!differs_) return moved_far;
  for (std::size_t i = 0; i < hold_.size(); ++i)
    if (norm2(place(static_cast<int>(i)) - hold_[i]) > trigger2) return true;
  return false;
}

bool StockBuilds::would_sort() const {
  return is_wanted_ && atom->sortfreq > 0 && update->ntimestep >= atom->nextsort;
}

void StockBuilds::note_missed() {
  if (!is_wanted_) return;
  hold_.resize(static_cast<std::size_t>(owned()));
  for (std::size_t i = 0; i < hold_.size(); ++i) hold_[i] = place(static_cast<int>(i));
  differs_ = true;
}

/// Atoms are about to be wrapped, but not moved in memory.
void StockBuilds::defer_sort() {
  if (!is_wanted_ || !differs_) return;
  for (std::size_t i = 0; i < hold_.size(); ++i) hold_[i] = place(static_cast<int>(i)) - hold_[i];
  defers_ = true;
  next_sort_ = std::exchange(atom->nextsort, MAXBIGINT);
}

void StockBuilds::follow(const std::vector<int>& places) {
  if (!defers_ || places.size() != hold_.size()) return;
  std::vector<dch::Vec3> moved(hold_.size());
  for (std::size_t i = 0; i < places.size(); ++i) moved[static_cast<std::size_t>(places[i])] = hold_[i];
  hold_ = std::move(moved);
}

void StockBuilds::note_build() {
  differs_ = std::exchange(defers_, false);
  if (!differs_) return;
  atom->nextsort = next_sort_;
  differs_ = hold_.size() == static_cast<std::size_t>(owned());  // lost atoms have changed the order anyway
  if (!differs_) return;
  for (std::size_t i = 0; i < hold_.size(); ++i) hold_[i] = place(static_cast<int>(i)) - hold_[i];
}

}  // namespace LAMMPS_NS
