// SPDX-License-Identifier: GPL-2.0-or-later
// What the fix says: ghosts that do not reach far enough, crossings, and what is undetermined.
#include <algorithm>
#include <atom.h>
#include <cmath>
#include <comm.h>
#include <domain.h>
#include <error.h>
#include <neighbor.h>
#include <sstream>
#include <update.h>

#include "fix_necklace_crossing.h"

namespace LAMMPS_NS {
namespace {

/// Six digits are enough for a message.
std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

}  // namespace

/// Whether bonds as long as those now are seen by the processes that have to. Bonds that become longer later
/// are undetermined.
void FixNecklaceCrossing::check_ghosts() const {
  const double limit = cell().half_height();  // longer ones are undetermined
  double mine = 0, longest = 0;
  for (int i = 0; i < atom->nlocal; ++i) {
    atoms_.for_bonds_of_owned(i, [&](tagint partner, bool) {
      int j = atom->map(partner);
      if (j >= 0) j = domain->closest_image(i, j);
      if (j < 0 || !atoms_.in_group(j)) return;
      const double *x = atom->x[i], *y = atom->x[j];
      const double length2 = norm2(dch::Vec3{y[0] - x[0], y[1] - x[1], y[2] - x[2]});
      if (length2 < limit * limit) mine = std::max(mine, length2);
    });
  }
  MPI_Allreduce(&mine, &longest, 1, MPI_DOUBLE, MPI_MAX, world);
  longest = std::sqrt(longest);
  const double needed = 2 * longest + thickness_ + neighbor->skin, reach = ghost_reach();
  if (needed > reach)
    error->all(FLERR, name_ + "ghost atoms are sent within " + text(reach) + ", but two bonds of length " +
                          text(longest) + ", the skin " + text(neighbor->skin) +
                          (thickness_ > 0 ? " and the thickness " + text(thickness_) : std::string()) +
                          " need " + text(needed) +
                          ", and twice what atoms move between checks; use 'comm_modify cutoff " +
                          text(1.5 * needed) + "' or more, or one process");
}

std::string FixNecklaceCrossing::text_of(const CrossingEvent& event) const {
  const auto& tags = event.tags;
  return "bond " + std::to_string(tags[0]) + "-" + std::to_string(tags[1]) + " went through bond " +
         std::to_string(tags[2]) + "-" + std::to_string(tags[3]) + " at step " + text(event.step) +
         " (checked at step " + std::to_string(update->ntimestep) + ")";
}

void FixNecklaceCrossing::act() {
  if (action_ == Action::count) return;
  if (undetermined_ > 0) warn_of_undetermined();
  if (found_ == 0) return;
  const std::string first = text_of(log_.events().front());
  if (action_ == Action::stop) error->all(FLERR, name_ + first);
  if (!has_warned_ && comm->me == 0)
    error->warning(FLERR, name_ + first + "; later ones are counted without a line");
  has_warned_ = true;
}

void FixNecklaceCrossing::warn_of_undetermined() {
  if (has_warned_of_undetermined_) return;
  has_warned_of_undetermined_ = true;
  double mine = bonds_.largest_extent(), largest = 0;
  MPI_Allreduce(&mine, &largest, 1, MPI_DOUBLE, MPI_MAX, world);
  if (comm->me != 0) return;
  std::string message = name_ + std::to_string(undetermined_) + " bonds or pairs are undetermined at step " +
                        std::to_string(update->ntimestep);
  if (largest > reach_)
    message += ": a bond's length and displacement together are " + text(largest) + ", but at most " +
               text(reach_) +
               (comm_alone_ ? ", half the box, can be followed; check more often"
                            : " can be followed; check more often, or use 'comm_modify cutoff " +
                                  text(2.2 * largest + neighbor->skin + thickness_) + "'");
  else
    message += ": atoms moved half the box or more, or are lost; check more often";
  error->warning(FLERR, message);
}

void FixNecklaceCrossing::post_run() {
  if (action_ != Action::warn || comm->me != 0) return;
  const double crossings = total_.crossings - run_crossings_;
  const double undetermined = total_.undetermined - run_undetermined_;
  if (crossings == 0 && undetermined == 0) return;
  error->warning(FLERR, name_ + text(crossings) + " crossings of bonds from step " +
                            std::to_string(run_begin_) + " to " + std::to_string(update->ntimestep) + ", " +
                            text(undetermined) + " undetermined");
}

}  // namespace LAMMPS_NS
