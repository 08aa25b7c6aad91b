// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>
#include <lammps_host.h>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>

#include "box_step.h"

namespace LAMMPS_NS {

/// Where each atom of this process was at the last check, and to which atoms it had bonds then. Goes with the
/// atoms when LAMMPS sorts them, sends them to other processes or writes them to a restart file.
///
/// 32 bytes an atom, and one ID for each bond that an atom may have.
class AtomPasts {
 public:
  /// Atoms without a past: those that were added or came into the group since.
  static constexpr int kNone = -1;

  struct Past {
    dch::Vec3 position;
    imageint image = 0;
    int bonds = kNone;  ///< number of its bonds then; kNone for no past
  };

  void resize(std::size_t atoms, int bonds_per_atom);
  int bonds_per_atom() const { return width_; }

  bool has(int i) const { return past_[index(i)].bonds != kNone; }
  const Past& operator[](int i) const { return past_[index(i)]; }
  /// The atoms to which i had bonds.
  dch::Span<const tagint> partners(int i) const {
    return {partners_.data() + index(i) * static_cast<std::size_t>(width_),
            static_cast<std::size_t>(past_[index(i)].bonds)};
  }
  bool had_bond(int i, tagint partner) const;

  void forget(int i) { past_[index(i)].bonds = kNone; }
  void note(int i, dch::Vec3 position, imageint image);
  void note_bond(int i, tagint partner);
  /// The same past with another of its images.
  void move(int i, dch::Vec3 position, imageint image);
  void copy(int from, int to);

  /// Numbers that write() writes for an atom at most.
  int most_numbers() const { return 5 + width_; }
  int numbers(int i) const { return 5 + (has(i) ? past_[index(i)].bonds : 0); }
  /// @return how many
  int write(int i, double* to) const;
  /// @return how many; bonds beyond bonds_per_atom() are left out
  int read(int i, const double* from);

  std::size_t memory_bytes() const {
    return past_.capacity() * sizeof(Past) + partners_.capacity() * sizeof(tagint);
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  std::vector<Past> past_;
  std::vector<tagint> partners_;  ///< width_ for each atom
  int width_ = 0;
};

/// Counts of LAMMPS's packed image flags.
dch::lammps::BoxCounts box_counts(imageint image);

}  // namespace LAMMPS_NS
