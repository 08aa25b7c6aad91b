// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>
#include <dch/lists/exclusions.hpp>
#include <dch/necklace/bond_encounter.hpp>

#include "crossing/pair_ends.hpp"
#include "geometry/lattice.hpp"

namespace dch::necklace::detail {

/// A bond over a step, next to the image of its first bead as given at the beginning.
struct BondStep {
  MovingBond ends;
  double magnitude = 0;            ///< at least that of all numbers that the ends are sums of [length]
  Image from_b{}, to_a{}, to_b{};  ///< images of the beads; from_a is as given
  bool beads_determined = true;    ///< neither bead has moved half the smallest height of the box or more
  bool bond_determined = true;     ///< the bond is shorter than that, at the beginning and the end
};

/// Where beads go during a step in a box that may change: each to the image nearest to where the box's own
/// change would take it. Lattice vectors go linearly from those of the old cell to those of the new one. A
/// cell that is given by other vectors of nearly the same lattice (a flip) is taken by those that continue
/// the old.
class StepMotion {
 public:
  StepMotion(Span<const Vec3> from, const Box& from_box, Span<const Vec3> to, const Box& to_box);

  BondStep bond(IndexPair beads) const;
  /// Has what bond() reads fetched.
  void ask_for(IndexPair beads) const {
    for (const std::int32_t bead : beads) {
      __builtin_prefetch(&from_[static_cast<std::size_t>(bead)]);
      __builtin_prefetch(&to_[static_cast<std::size_t>(bead)]);
    }
  }
  /// The lattice vector at the beginning and the end that `image` means, which is of the old cell.
  Vec3 shift_from(const Image& image) const { return sum(image, cell_from_); }
  Vec3 shift_to(const Image& image) const { return sum(carried(image), cell_to_); }
  double shift_magnitude(const Image& image) const;
  /// Both bonds exactly, Q shifted by an image.
  PairEnds ends(IndexPair p, IndexPair q, const BondStep& step_p, const BondStep& step_q,
                const Image& image) const;

  /// The box halfway, with cell vectors in the order of the old one.
  const Box& middle_box() const { return middle_box_; }
  /// The image that a lattice vector of the box halfway is.
  Image middle_image(Vec3 shift) const;

 private:
  struct BeadStep {
    Vec3 to;
    Image image{};
    double magnitude = 0;
    bool determined = true;
  };
  BeadStep bead(std::int32_t index) const;
  Vec3 carried_along(Vec3 position) const;
  Image carried(const Image& image) const;
  static Vec3 sum(const Image& image, const std::array<Vec3, 3>& cell);

  Span<const Vec3> from_, to_;
  Box from_box_, to_box_, middle_box_;
  bool same_box_;
  std::array<Vec3, 3> cell_from_{}, cell_to_{};
  std::array<Image, 3> carry_{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< old vectors as multiples of new ones
  dch::detail::Lattice lattice_from_, lattice_to_, lattice_middle_;
  std::array<Vec3, 3> dual_from_{}, change_{};
  double limit2_;  ///< (half the smallest height)^2 of either box
};

}  // namespace dch::necklace::detail
