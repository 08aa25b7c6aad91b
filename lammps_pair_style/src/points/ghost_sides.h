// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <fix.h>
#include <lammps_host.h>
#include <vector>

namespace LAMMPS_NS {

/// An atom's image as one number: by how many box vectors it is off the atom, along z, y and x, and behind
/// these the rank of the process that owns the atom. That of the atom itself is the rank.
using ImageOfAtom = std::int64_t;
/// So many box vectors farther.
ImageOfAtom shifted(ImageOfAtom image, const int* vectors);
/// Whether a process takes the pairs of its own atoms with this image of an atom.
inline bool is_taken_by(int rank, ImageOfAtom image) { return image >= rank; }

/// Which process takes the pairs of an owned atom with a ghost: this one, or the ghost's owner, where the
/// owned atom is a ghost.
///
/// A ghost is an image of its owner's atom, by so many box vectors, and the other process sees the same
/// vectors the other way round. So whoever sees the image in the upper half of the lattice takes the pair:
/// the first of the vectors' numbers along z, y and x that is not 0 is positive. Where all are 0, the process
/// with the lower rank does. LAMMPS counts the vectors when it sends ghosts on, so no coordinate is looked at
/// and both sides agree whatever rounds. About half of the ghosts of a process are above it.
///
/// It is a fix since LAMMPS sends numbers of fixes to ghosts; no list of fixes has it.
class GhostSides : public Fix {
 public:
  explicit GhostSides(LAMMPS* lammps);

  int setmask() override { return 0; }
  /// Every process has to call this, once LAMMPS has made ghosts. O(atoms).
  void gather();
  /// Whether pairs with this ghost are taken here. Good until the next ghosts; of owned atoms true.
  bool is_taken_here(int i) const { return is_taken_[static_cast<std::size_t>(i)] != 0; }

  int pack_forward_comm(int n, int* atoms, double* to, int pbc_flag, int* pbc) override;
  void unpack_forward_comm(int n, int first, double* from) override;

 private:
  std::vector<ImageOfAtom> image_;  ///< by atom
  std::vector<char> is_taken_;
};

}  // namespace LAMMPS_NS
