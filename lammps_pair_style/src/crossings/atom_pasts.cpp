// SPDX-License-Identifier: GPL-2.0-or-later
#include "atom_pasts.h"

#include <algorithm>

namespace LAMMPS_NS {

dch::lammps::BoxCounts box_counts(imageint image) {
  return {static_cast<int>(image & IMGMASK) - IMGMAX, static_cast<int>(image >> IMGBITS & IMGMASK) - IMGMAX,
          static_cast<int>(image >> IMG2BITS) - IMGMAX};
}

void AtomPasts::resize(std::size_t atoms, int bonds_per_atom) {
  if (bonds_per_atom != width_) {
    std::vector<tagint> partners(atoms * static_cast<std::size_t>(bonds_per_atom));
    for (std::size_t i = 0; i < std::min(atoms, past_.size()); ++i) {
      Past& past = past_[i];
      past.bonds = std::min(past.bonds, bonds_per_atom);
      std::copy_n(partners_.begin() + static_cast<std::ptrdiff_t>(i * index(width_)), std::max(past.bonds, 0),
                  partners.begin() + static_cast<std::ptrdiff_t>(i * index(bonds_per_atom)));
    }
    partners_ = std::move(partners);
    width_ = bonds_per_atom;
  }
  past_.resize(atoms);
  partners_.resize(atoms * index(width_));
}

bool AtomPasts::had_bond(int i, tagint partner) const {
  if (!has(i)) return false;
  const auto all = partners(i);
  return std::find(all.begin(), all.end(), partner) != all.end();
}

void AtomPasts::note(int i, dch::Vec3 position, imageint image) { past_[index(i)] = {position, image, 0}; }

void AtomPasts::note_bond(int i, tagint partner) {
  Past& past = past_[index(i)];
  if (past.bonds < width_) partners_[index(i) * index(width_) + index(past.bonds++)] = partner;
}

void AtomPasts::move(int i, dch::Vec3 position, imageint image) {
  past_[index(i)].position = position;
  past_[index(i)].image = image;
}

void AtomPasts::copy(int from, int to) {
  past_[index(to)] = past_[index(from)];
  std::copy_n(partners_.begin() + static_cast<std::ptrdiff_t>(index(from) * index(width_)), width_,
              partners_.begin() + static_cast<std::ptrdiff_t>(index(to) * index(width_)));
}

int AtomPasts::write(int i, double* to) const {
  const Past& past = past_[index(i)];
  double* at = to;
  for (int k = 0; k < 3; ++k) *at++ = past.position[k];
  *at++ = static_cast<double>(past.image);
  *at++ = static_cast<double>(past.bonds);
  if (has(i))
    for (const tagint partner : partners(i)) *at++ = static_cast<double>(partner);
  return static_cast<int>(at - to);
}

int AtomPasts::read(int i, const double* from) {
  const auto bonds = static_cast<int>(from[4]);
  if (bonds == kNone) {
    past_[index(i)] = {};
    return 5;
  }
  note(i, {from[0], from[1], from[2]}, static_cast<imageint>(from[3]));
  for (int k = 0; k < bonds; ++k) note_bond(i, static_cast<tagint>(from[5 + k]));
  return 5 + bonds;
}

}  // namespace LAMMPS_NS
