// SPDX-License-Identifier: MIT
#include "frames/unit_cell.hpp"

#include <cmath>
#include <numbers>

namespace dch::trajectory {
namespace {

double cosine(double degrees) { return degrees == 90 ? 0 : std::cos(degrees * std::numbers::pi / 180); }

}  // namespace

Cell cell_from_angles(Vec3 lengths, double alpha, double beta, double gamma) {
  const double cos_alpha = cosine(alpha), cos_beta = cosine(beta), cos_gamma = cosine(gamma);
  const double sin_gamma = std::sqrt(1 - cos_gamma * cos_gamma);
  const double cy = (cos_alpha - cos_beta * cos_gamma) / sin_gamma;
  const double cz = std::sqrt(1 - cos_beta * cos_beta - cy * cy);
  Cell cell;
  cell.edges[0] = {lengths.x, 0, 0};
  cell.edges[1] = lengths.y * Vec3{cos_gamma, sin_gamma, 0};
  cell.edges[2] = lengths.z * Vec3{cos_beta, cy, cz};
  return cell;
}

}  // namespace dch::trajectory
