// SPDX-License-Identifier: GPL-2.0-or-later
#include "atom_pasts.h"

#include <memory.h>

#include "id_numbers.h"

namespace LAMMPS_NS {

dch::lammps::BoxCounts box_counts(imageint image) {
  return {static_cast<int>(image & IMGMASK) - IMGMAX, static_cast<int>(image >> IMGBITS & IMGMASK) - IMGMAX,
          static_cast<int>(image >> IMG2BITS) - IMGMAX};
}

AtomPasts::~AtomPasts() {
  memory->sfree(positions_);
  memory->sfree(images_);
  memory->sfree(partners_);
}

template <class T>
void AtomPasts::make_room(T*& array, std::size_t count) {
  array = static_cast<T*>(
      memory->srealloc(array, static_cast<bigint>(count * sizeof(T)), "necklace/crossing:pasts"));
}

void AtomPasts::resize(int atoms, int bonds_per_atom) {
  make_room(positions_, index(atoms));
  make_room(images_, index(atoms));
  const int width = std::max(bonds_per_atom, 1);
  if (width == width_) {
    make_room(partners_, index(atoms) * index(width));
  } else {
    change_width(atoms, width);
  }
  room_ = atoms;
}

void AtomPasts::change_width(int atoms, int width) {
  tagint* partners = nullptr;
  make_room(partners, index(atoms) * index(width));
  for (int i = 0; i < std::min(atoms, room_); ++i) {
    tagint* const row = partners + index(i) * index(width);
    std::fill(std::copy_n(partners_of(i), std::min(width, width_), row), row + width, tagint{0});
  }
  memory->sfree(partners_);
  partners_ = partners;
  width_ = width;
}

void AtomPasts::forget(int i) {
  std::fill_n(partners_of(i), width_, tagint{0});
  *partners_of(i) = kNone;
}

void AtomPasts::note(int i, dch::Vec3 position, imageint image) {
  move(i, position, image);
  std::fill_n(partners_of(i), width_, tagint{0});
}

void AtomPasts::note_bond(int i, tagint partner) {
  tagint* const row = partners_of(i);
  tagint* const free = std::find(row, row + width_, tagint{0});
  if (free != row + width_) *free = partner;
}

void AtomPasts::move(int i, dch::Vec3 position, imageint image) {
  positions_[index(i)] = position;
  images_[index(i)] = image;
}

void AtomPasts::copy(int from, int to) {
  move(to, position(from), image(from));
  std::copy_n(partners_of(from), width_, partners_of(to));
}

int AtomPasts::write(int i, double* to) const {
  if (!has(i)) {  // what stands in the arrays then was perhaps never written
    std::fill_n(to, 4, 0.0);
    to[4] = static_cast<double>(kNone);
    return 5;
  }
  double* at = to;
  for (int k = 0; k < 3; ++k) *at++ = position(i)[k];
  *at++ = in_double(image(i));
  const auto held = partners(i);
  *at++ = static_cast<double>(held.size());
  for (const tagint partner : held) *at++ = in_double(partner);
  return static_cast<int>(at - to);
}

int AtomPasts::read(int i, const double* from) {
  const auto bonds = static_cast<int>(from[4]);
  if (bonds < 0) {
    forget(i);
    return 5;
  }
  note(i, {from[0], from[1], from[2]}, from_double<imageint>(from[3]));
  for (int k = 0; k < bonds; ++k) note_bond(i, from_double<tagint>(from[5 + k]));
  return 5 + bonds;
}

}  // namespace LAMMPS_NS
