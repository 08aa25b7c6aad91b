// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "crossing/pair_ends.hpp"

namespace dch::necklace::detail {

/// A passage of one bond through another.
struct Passage {
  double time = 0;            ///< 0 .. 1
  double on_p = 0, on_q = 0;  ///< where along the bonds, 0 .. 1
  int sign = 0;               ///< of the derivative of det[b_P, b_Q, q - p]: +1 or -1
};

struct ExactPassages {
  std::vector<Passage> passages;  ///< in ascending order of time
  bool degenerate = false;        ///< the motion had to be perturbed, so the bonds may touch otherwise
};

/// The passages of a motion in exact arithmetic: integers of any size, roots of the cubic isolated by Sturm's
/// sequences, signs at roots by Tarski's. Nothing is rounded but the figures of the result.
///
/// **Generic motions**: f(t) = det[b_P(t), b_Q(t), q(t) - p(t)] has simple roots only and none at 0 or 1, and
/// at no root within reach an end of a bond lies on the other bond. Then a passage is a root where both
/// parameters are in (0, 1).
///
/// **All others** are decided by a symbolic perturbation: bead k stands at x_k + eps w_k at all times, with
/// an infinitesimal eps and a direction w_k that its number alone determines. So the perturbed beads move
/// continuously from step to step, bonds that share a bead keep sharing it, and a passage at the common time
/// of two steps, through a common bead of two bonds, or along an edge of both belongs to exactly one step and
/// one bond: the perturbed motion is generic in all steps at once. The sum of signs over all pairs of bonds
/// of two rings is the change of the perturbed rings' linking number, hence of the rings' own wherever these
/// do not touch at the beginning and the end. Passages of the perturbed motion at one time (within 2^-50) are
/// one event: those of opposite signs cancel, so a double root of f is none, and a triple one is one.
///
/// eps is a number here, 2^-(16 N + 256) of the unit in which all coordinates are integers of N bits: below
/// what the algebraic numbers of a motion can differ by, so that each sign is that of its leading term. (For
/// N above 496, coordinates 1e130 times as large as others, it stays at 2^-8192.)
ExactPassages exact_passages(const PairEnds& ends);

}  // namespace dch::necklace::detail
