// SPDX-License-Identifier: GPL-2.0-or-later
#include "box_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dch::lammps {
namespace {

/// Image flags have ten bits and begin anew after the last number.
constexpr int kFlags = 1024;

int flag_difference(int a, int b) {
  const int difference = (a - b) % kFlags;
  if (difference >= kFlags / 2) return difference - kFlags;
  return difference < -kFlags / 2 ? difference + kFlags : difference;
}

int multiple(double length, double edge) { return static_cast<int>(std::lrint(length / edge)); }

}  // namespace

Vec3 Cell::coordinates(Vec3 d) const {
  const double z = d.z / h[2];
  const double y = (d.y - h[3] * z) / h[1];
  return {(d.x - h[5] * y - h[4] * z) / h[0], y, z};
}

Vec3 Cell::nearest(Vec3 d) const {
  Vec3 n = coordinates(d);
  for (int k = 0; k < 3; ++k) n[k] = periodic[static_cast<std::size_t>(k)] ? std::rint(n[k]) : 0.0;
  return n;
}

double Cell::half_height() const {
  // Rows of the inverse are normal to the faces; their lengths are those of the heights, inverted.
  const Vec3 x{1 / h[0], -h[5] / (h[0] * h[1]), (h[3] * h[5] - h[1] * h[4]) / (h[0] * h[1] * h[2])};
  const Vec3 y{0, 1 / h[1], -h[3] / (h[1] * h[2])};
  const Vec3 z{0, 0, 1 / h[2]};
  double largest = 0;
  if (periodic[0]) largest = std::max(largest, norm2(x));
  if (periodic[1]) largest = std::max(largest, norm2(y));
  if (periodic[2]) largest = std::max(largest, norm2(z));
  return largest > 0 ? 0.5 / std::sqrt(largest) : std::numeric_limits<double>::infinity();
}

BoxStep::BoxStep(const Cell& before, const Cell& now) : before_(before), now_(now) {
  const auto& old = before.h;
  const int xy = multiple(now.h[5] - old[5], old[0]);
  const int yz = multiple(now.h[3] - old[3], old[1]);
  const int xz = multiple(now.h[4] - old[4] - yz * old[5], old[0]);
  flip_ = {yz, xz, xy};
  before_.h[5] += xy * old[0];
  before_.h[3] += yz * old[1];
  before_.h[4] += yz * old[5] + xz * old[0];
  middle_ = now_;
  for (std::size_t k = 0; k < 6; ++k) middle_.h[k] = 0.5 * (before_.h[k] + now_.h[k]);
  middle_.low = 0.5 * (before_.low + now_.low);
  same_ = before_ == now_;
}

Vec3 BoxStep::drift(Vec3 d) const {
  const Vec3 s = middle_.coordinates(d);
  return now_.vector(s) - before_.vector(s);
}

double BoxStep::strain() const {
  if (same_) return 0;
  return std::sqrt(norm2(drift({1, 0, 0})) + norm2(drift({0, 1, 0})) + norm2(drift({0, 0, 1})));
}

Vec3 BoxStep::start(Vec3 position, const BoxCounts& flags_then, const BoxCounts& flags) const {
  // Old flags count vectors of the old basis: a + b + c = (a' - xy b' + ...) in the new one.
  const int z_then = flags_then[2];
  const int y_then = flags_then[1] - flip_[0] * z_then;
  const int x_then = flags_then[0] - flip_[2] * y_then - flip_[1] * z_then;
  const int x = now_.periodic[0] ? flag_difference(x_then, flags[0]) : 0;
  const int y = now_.periodic[1] ? flag_difference(y_then, flags[1]) : 0;
  const int z = now_.periodic[2] ? flag_difference(z_then, flags[2]) : 0;
  if (x == 0 && y == 0 && z == 0) return position;
  return position + before_.vector({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
}

double BoxStep::moved2(Vec3 start, Vec3 end) const {
  const auto& periodic = now_.periodic;
  if (same_ && periodic[0] && periodic[1] && periodic[2]) return norm2(end - start);
  Vec3 s = now_.coordinates(end - now_.low) - before_.coordinates(start - before_.low);
  for (int k = 0; k < 3; ++k)
    if (!periodic[static_cast<std::size_t>(k)]) s[k] = 0;
  return norm2(now_.vector(s));
}

}  // namespace dch::lammps
