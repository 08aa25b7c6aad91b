// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <lammps_host.h>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>

#include "box_step.h"

namespace LAMMPS_NS {

/// Where each atom of this process was at the last check, and to which atoms it had bonds then. Goes with the
/// atoms when LAMMPS sorts them, sends them to other processes or writes them to a restart file.
///
/// 28 bytes an atom, and one ID for each bond that an atom may have.
class AtomPasts : protected Pointers {
 public:
  using Pointers::Pointers;
  ~AtomPasts() override;
  AtomPasts(const AtomPasts&) = delete;
  AtomPasts& operator=(const AtomPasts&) = delete;

  /// Makes room. Of atoms that come, forget(), copy() or read() has to tell before anything is asked.
  void resize(int atoms, int bonds_per_atom);
  int bonds_per_atom() const { return width_; }

  /// False for atoms that were added or came into the group since.
  bool has(int i) const { return *partners_of(i) != kNone; }
  dch::Vec3 position(int i) const { return positions_[index(i)]; }
  imageint image(int i) const { return images_[index(i)]; }
  /// The atoms to which i, which has a past, had bonds.
  dch::Span<const tagint> partners(int i) const {
    const tagint* const row = partners_of(i);
    return {row, static_cast<std::size_t>(std::find(row, row + width_, tagint{0}) - row)};
  }
  bool had_bond(int i, tagint partner) const {
    const tagint* const row = partners_of(i);
    return std::find(row, row + width_, partner) != row + width_;
  }

  void forget(int i);
  void note(int i, dch::Vec3 position, imageint image);
  void note_bond(int i, tagint partner);
  /// The same past with another of its images.
  void move(int i, dch::Vec3 position, imageint image);
  void copy(int from, int to);

  /// Numbers that write() writes for an atom at most.
  int most_numbers() const { return 5 + width_; }
  int numbers(int i) const { return 5 + (has(i) ? static_cast<int>(partners(i).size()) : 0); }
  /// @return how many
  int write(int i, double* to) const;
  /// @return how many; bonds beyond bonds_per_atom() are left out
  int read(int i, const double* from);

  double memory_bytes() const {
    return static_cast<double>(room_) *
           static_cast<double>(sizeof(dch::Vec3) + sizeof(imageint) + index(width_) * sizeof(tagint));
  }

 private:
  /// In the place of the first partner where there is no past. IDs are above 0.
  static constexpr tagint kNone = -1;

  template <class T>
  void make_room(T*& array, std::size_t count);
  void change_width(int atoms, int width);
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  tagint* partners_of(int i) { return partners_ + index(i) * index(width_); }
  const tagint* partners_of(int i) const { return partners_ + index(i) * index(width_); }

  // LAMMPS has room for ghosts in arrays of atoms. They have no past: their part is never written, and takes
  // no memory if the arrays are not filled when they are made.
  dch::Vec3* positions_ = nullptr;
  imageint* images_ = nullptr;
  tagint* partners_ = nullptr;  ///< width_ for each atom; 0 behind the last one
  int room_ = 0;                ///< for so many atoms
  int width_ = 1;               ///< at least 1, for kNone
};

/// Counts of LAMMPS's packed image flags.
dch::lammps::BoxCounts box_counts(imageint image);

}  // namespace LAMMPS_NS
