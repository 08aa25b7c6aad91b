// SPDX-License-Identifier: MIT
#pragma once

#include "frames/cell.hpp"

namespace dch::trajectory {

/// Edges of a cell with the given lengths [length] and angles [degrees]: a along x, b in the xy plane.
/// alpha lies between b and c, beta between a and c, gamma between a and b. Right angles give exact zeros.
/// The result holds NaN where no such cell exists (angles of 60, 60 and 130 degrees, say).
Cell cell_from_angles(Vec3 lengths, double alpha, double beta, double gamma);

}  // namespace dch::trajectory
