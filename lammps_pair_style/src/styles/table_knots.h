// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <functional>

#include <dch/forces/pair_potential.hpp>

namespace dch::lammps {

struct TablePoint {
  double energy = 0, force_over_r = 0;
};

/// What a table has at a squared distance.
using AskTable = std::function<TablePoint(double)>;

/// Takes from a table what stands at its knots, which are so many, equally far from each other in r^2 from
/// table.inner to table.outer: of one that is linear in r^2 between them.
///
/// It is asked from the outer end inwards, never at this end, where it may have no numbers: where knots are
/// not where they are thought to be, that shows before a distance is asked for that it does not have.
/// @returns whether it is linear, to within rounding and a share of 1e-9
bool take_lines(const AskTable& ask, int knots, PairTable& table);

/// The same of cubic splines, with their second derivatives: each interval is asked at four places, through
/// which there is one cubic. A fifth place has to be on it, and on both sides of a knot values and second
/// derivatives have to be the same.
/// @returns whether they are, to within rounding: else the table is no such spline
bool take_splines(const AskTable& ask, int knots, PairTable& table);

}  // namespace dch::lammps
