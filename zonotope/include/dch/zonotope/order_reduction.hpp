// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include <dch/zonotope/zonotope.hpp>

#pragma GCC visibility push(default)
namespace dch::zonotope {

/// A zonotope with fewer generators that encloses another one.
struct Approximation {
  Zonotope zonotope;
  double distance =
      0;  ///< at most so far do its points lie from the other one: bounds the Hausdorff distance [length]
  double diameter = 0;  ///< at most the diameter of the other one [length]
};

/// A zonotope with O(1 / epsilon^2) generators that encloses a given one and lies within epsilon times its
/// diameter of it (thesis 3.5.3, Lemma 3.5.5): the generators are sorted into cells of directions; those of a
/// cell become one along their mean direction, and what they have across it goes into a box. The text leaves
/// the constant open: cells are made finer until the bound of the proof, the sum of all that goes into the
/// box and the box, with the numbers at hand, is at most epsilon times a lower bound of the diameter; that
/// takes about 10 / epsilon^2 generators where there are many in all directions. Where that many are not
/// fewer, the zonotope comes back as it is. O(n / epsilon) time.
///
/// Encloses in exact arithmetic: the box is larger by what may have been rounded.
/// @param epsilon within 1e-3..1
/// @throws InvalidParameter for another epsilon; InvalidPosition as check()
Approximation approximated(const Zonotope& z, double epsilon);

/// A zonotope of at most `most` generators that encloses a given one: the shortest are put into a box (A.
/// Girard, HSCC 2005, LNCS 3414:291), along the axes or along their singular vectors, whichever is smaller.
/// The order of generators is by |v|_1 - |v|_inf along those axes, which is what a box around them costs. No
/// bound on the distance; fast and good where most are short. O(n log n). Encloses in exact arithmetic, as
/// approximated().
/// @param most at least 3
/// @throws InvalidParameter for fewer; InvalidPosition as check()
Zonotope reduced(const Zonotope& z, std::size_t most);

}  // namespace dch::zonotope
#pragma GCC visibility pop
