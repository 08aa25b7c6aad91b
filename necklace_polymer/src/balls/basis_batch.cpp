// SPDX-License-Identifier: MIT
#include "balls/basis_batch.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace dch::necklace::detail {

namespace {

constexpr std::size_t kLanes = 16;
using Lanes = std::array<double, kLanes>;

struct LaneVec3 {
  Lanes x, y, z;
  Vec3 operator[](std::size_t lane) const { return {x[lane], y[lane], z[lane]}; }
  void set(std::size_t lane, Vec3 v) { x[lane] = v.x, y[lane] = v.y, z[lane] = v.z; }
};

double larger(double a, double b) { return a > b ? a : b; }
double smaller(double a, double b) { return a < b ? a : b; }

/// Bases of one size, and what is known of their balls.
struct Batch {
  std::array<std::size_t, kLanes> slot;  ///< of the bases
  std::size_t count = 0;
  std::array<LaneVec3, 4> at;  ///< centers of the members
  LaneVec3 center;
  Lanes reach2;        ///< largest squared distance of a member from the center
  Lanes least_weight;  ///< of the members' centers in the center: below 0 if one is not needed
  Lanes extent;        ///< a measure of the simplex of the members: 0 if it is flat
};

void find_two(Batch& batch) {
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Vec3 a = batch.at[0][k], b = batch.at[1][k], d = b - a;
    const Vec3 center = a + 0.5 * d;
    batch.center.set(k, center);
    batch.reach2[k] = larger(norm2(a - center), norm2(b - center));
    batch.least_weight[k] = 0.5;
    batch.extent[k] = norm2(d);
  }
}

void find_three(Batch& batch) {
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Vec3 a = batch.at[0][k], b = batch.at[1][k], c = batch.at[2][k];
    const Vec3 d = b - a, e = c - a;
    const Vec3 normal = cross(d, e);
    const double area2 = norm2(normal);
    const Vec3 to_d = (1 / area2) * cross(e, normal), to_e = (1 / area2) * cross(normal, d);
    const Vec3 q = (0.5 * norm2(d)) * to_d + (0.5 * norm2(e)) * to_e;
    const double second = dot(q, to_d), third = dot(q, to_e);
    const Vec3 center = a + q;
    batch.center.set(k, center);
    batch.reach2[k] = larger(larger(norm2(a - center), norm2(b - center)), norm2(c - center));
    batch.least_weight[k] = smaller(smaller(1 - second - third, second), third);
    batch.extent[k] = area2;
  }
}

void find_four(Batch& batch) {
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Vec3 a = batch.at[0][k], b = batch.at[1][k], c = batch.at[2][k], other = batch.at[3][k];
    const Vec3 d = b - a, e = c - a, f = other - a;
    const Vec3 ef = cross(e, f);
    const double volume = dot(d, ef);
    const Vec3 to_d = (1 / volume) * ef, to_e = (1 / volume) * cross(f, d), to_f = (1 / volume) * cross(d, e);
    const Vec3 q = (0.5 * norm2(d)) * to_d + (0.5 * norm2(e)) * to_e + (0.5 * norm2(f)) * to_f;
    const double second = dot(q, to_d), third = dot(q, to_e), fourth = dot(q, to_f);
    const Vec3 center = a + q;
    batch.center.set(k, center);
    batch.reach2[k] = larger(larger(norm2(a - center), norm2(b - center)),
                             larger(norm2(c - center), norm2(other - center)));
    batch.least_weight[k] = smaller(smaller(1 - second - third - fourth, second), smaller(third, fourth));
    batch.extent[k] = std::abs(volume);
  }
}

void find(Batch& batch, std::size_t size, Span<const Ball> balls, Span<const Basis> bases,
          std::vector<Ball>& out) {
  if (batch.count == 0) return;
  const double radius = balls[0].radius;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Basis& basis = bases[batch.slot[k < batch.count ? k : 0]];
    for (std::size_t member = 0; member < size; ++member) {
      batch.at[member].set(k, balls[static_cast<std::size_t>(basis.members[member])].center);
    }
  }
  if (size == 2) find_two(batch);
  if (size == 3) find_three(batch);
  if (size == 4) find_four(batch);
  for (std::size_t k = 0; k < batch.count; ++k) {
    const bool central = batch.least_weight[k] >= 0 && batch.extent[k] > 0 &&
                         batch.reach2[k] < std::numeric_limits<double>::infinity();
    out[batch.slot[k]] = {batch.center[k], central ? std::sqrt(batch.reach2[k]) + radius : kNotCentral};
  }
  batch.count = 0;
}

}  // namespace

void balls_of_bases(Span<const Ball> balls, Span<const Basis> bases, std::vector<Ball>& out) {
  std::array<Batch, 5> batches;
  for (std::size_t k = 0; k < bases.size(); ++k) {
    const auto size = static_cast<std::size_t>(bases[k].size);
    if (size == 1) {
      out[k] = balls[static_cast<std::size_t>(bases[k].members[0])];
      continue;
    }
    Batch& batch = batches[size];
    batch.slot[batch.count++] = k;
    if (batch.count == kLanes) find(batch, size, balls, bases, out);
  }
  for (std::size_t size = 2; size <= 4; ++size) find(batches[size], size, balls, bases, out);
}

}  // namespace dch::necklace::detail
