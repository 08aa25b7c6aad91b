// SPDX-License-Identifier: GPL-2.0-or-later
#include "ghost_sides.h"

#include <algorithm>
#include <array>
#include <atom.h>
#include <comm.h>
#include <cstring>
#include <error.h>
#include <string>

#include "lammps_versions.h"

namespace LAMMPS_NS {
namespace {

constexpr std::int64_t kRanks = std::int64_t{1} << 31;
constexpr std::int64_t kImages = 1 << 10;  ///< LAMMPS makes ghosts of far fewer boxes along an axis

std::array<char*, 3> words_of_fix() {
  static char name[] = "DCH_SIDES", group[] = "all";
  return {name, group, name};
}

}  // namespace

ImageOfAtom shifted(ImageOfAtom image, const int* vectors) {
  return image + ((vectors[2] * kImages + vectors[1]) * kImages + vectors[0]) * kRanks;
}

// Comm has room for one number of each atom, as it has for three coordinates: it asks only fixes in the list
// of fixes how many they send.
GhostSides::GhostSides(LAMMPS* lammps) : Fix(lammps, 3, words_of_fix().data()) { comm_forward = 1; }

void GhostSides::gather() {
  const auto owned = static_cast<std::size_t>(atom->nlocal);
  image_.assign(owned + static_cast<std::size_t>(atom->nghost), comm->me);
  dch::lammps::forward_communication(*comm, this, comm_forward);
  if (std::find(image_.begin() + atom->nlocal, image_.end(), comm->me) != image_.end())
    error->one(
        FLERR,
        std::string("DCH neighbor lists: this LAMMPS does not say across which faces it sends ghosts to ") +
            "their own process; give 'dch off', and please report its version and comm_style");
  is_taken_.resize(image_.size());
  std::transform(image_.begin(), image_.end(), is_taken_.begin(),
                 [&](ImageOfAtom image) { return is_taken_by(comm->me, image) ? 1 : 0; });
}

// Ghosts are sent on as ghosts of others, so vectors add up. The bits of an integer travel as a double's.
int GhostSides::pack_forward_comm(int n, int* atoms, double* to, int pbc_flag, int* pbc) {
  constexpr int kNowhere[3] = {0, 0, 0};
  for (int k = 0; k < n; ++k) {
    const ImageOfAtom image = shifted(image_[static_cast<std::size_t>(atoms[k])], pbc_flag ? pbc : kNowhere);
    std::memcpy(to + k, &image, sizeof image);
  }
  return n;
}

void GhostSides::unpack_forward_comm(int n, int first, double* from) {
  if (n > 0)
    std::memcpy(&image_[static_cast<std::size_t>(first)], from, static_cast<std::size_t>(n) * sizeof(double));
}

}  // namespace LAMMPS_NS
