// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include <dch/base/vec3.hpp>

namespace dch::zonotope {

inline constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// A vector of numbers of any type, so that the same formulas serve with rounding and without.
template <class Number>
struct Vec {
  Number x{}, y{}, z{};

  friend Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec operator-(const Vec& a) { return {-a.x, -a.y, -a.z}; }
  friend Vec operator*(const Number& s, const Vec& a) { return {s * a.x, s * a.y, s * a.z}; }
};

template <class Number>
Number dot(const Vec<Number>& a, const Vec<Number>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Number>
Vec<Number> cross(const Vec<Number>& a, const Vec<Number>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline int sign_of(double x) { return (x > 0) - (x < 0); }
inline double value_of(double x) { return x; }

inline Vec<double> rounded(Vec3 v) { return {v.x, v.y, v.z}; }
inline Vec3 vec3(const Vec<double>& v) { return {v.x, v.y, v.z}; }

/// Of the absolute values of coordinates: what bounds of rounding errors are made of.
inline Vec3 magnitudes(Vec3 v) { return {v.x < 0 ? -v.x : v.x, v.y < 0 ? -v.y : v.y, v.z < 0 ? -v.z : v.z}; }

}  // namespace dch::zonotope
