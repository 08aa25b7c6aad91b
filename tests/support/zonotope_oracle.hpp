// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <dch/base/vec3.hpp>

namespace dch::oracle {

using Integer = boost::multiprecision::int512_t;
using IntegerVec = std::array<Integer, 3>;

/// x times 2^bits, which has to be an integer.
inline Integer scaled(double x, int bits) {
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  Integer mantissa = static_cast<std::int64_t>(std::ldexp(fraction, 53));
  exponent += bits - 53;
  if (exponent >= 0)
    return mantissa * boost::multiprecision::pow(Integer(2), static_cast<unsigned>(exponent));
  const Integer divisor = boost::multiprecision::pow(Integer(2), static_cast<unsigned>(-exponent));
  if (mantissa % divisor != 0) throw std::logic_error("a coordinate of the oracle is off its grid");
  return mantissa / divisor;
}

inline IntegerVec scaled(Vec3 v, int bits) {
  return {scaled(v.x, bits), scaled(v.y, bits), scaled(v.z, bits)};
}

inline Integer dot(const IntegerVec& a, const IntegerVec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline IntegerVec cross(const IntegerVec& a, const IntegerVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline IntegerVec minus(const IntegerVec& a, const IntegerVec& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline bool is_zero(const IntegerVec& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

/// The obvious test in integers: a point is in the sum of [-1, 1] u_k if along each normal of a facet it is
/// within reach. The normals are those of all pairs; of a flat zonotope the plane's, and those in the plane;
/// of a segment any two across, and the segment.
class ZonotopeOracle {
 public:
  ZonotopeOracle(const std::vector<Vec3>& generators, int bits) {
    for (const Vec3& u : generators) generators_.push_back(scaled(u, bits));
    for (std::size_t i = 0; i < generators_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) add(cross(generators_[i], generators_[j]));
    bool is_flat = true;
    if (!normals_.empty())
      for (const IntegerVec& u : generators_) is_flat = is_flat && dot(u, normals_[0]) == 0;
    if (normals_.empty()) {
      const IntegerVec axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
      for (const IntegerVec& axis : axes) {
        bool is_point = true;
        for (const IntegerVec& u : generators_) {
          add(u);
          add(cross(u, axis));
          is_point = is_point && is_zero(u);
        }
        if (is_point) add(axis);
      }
    } else if (is_flat) {
      const IntegerVec plane = normals_[0];
      for (const IntegerVec& u : generators_) add(cross(plane, u));
    }
  }

  /// +1 in the interior or, of a flat one, anywhere but at an edge; 0 on the boundary; -1 outside.
  int side(const IntegerVec& point) const {
    int result = 1;
    for (std::size_t k = 0; k < normals_.size(); ++k) {
      const Integer rest = reach_[k] - abs(dot(normals_[k], point));
      if (rest < 0) return -1;
      if (rest == 0 && reach_[k] > 0) result = 0;
    }
    return result;
  }

  const std::vector<IntegerVec>& normals() const { return normals_; }

 private:
  void add(const IntegerVec& normal) {
    if (is_zero(normal)) return;
    Integer reach = 0;
    for (const IntegerVec& u : generators_) reach += abs(dot(normal, u));
    normals_.push_back(normal);
    reach_.push_back(reach);
  }

  std::vector<IntegerVec> generators_, normals_;
  std::vector<Integer> reach_;
};

}  // namespace dch::oracle
