// SPDX-License-Identifier: MIT
#include "frames/cell.hpp"

namespace dch::trajectory {

Box Cell::box() const {
  if (is_zero()) return Box::none();
  const bool axis_parallel = edges[0].y == 0 && edges[0].z == 0 && edges[1].x == 0 && edges[1].z == 0 &&
                             edges[2].x == 0 && edges[2].y == 0;
  if (axis_parallel) return Box::orthorhombic({edges[0].x, edges[1].y, edges[2].z}, periodic, origin);
  return Box::triclinic(edges[0], edges[1], edges[2], periodic, origin);
}

}  // namespace dch::trajectory
