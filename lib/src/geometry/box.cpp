// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/geometry/box.hpp>

#include "base/describe.hpp"
#include "base/nearest_integer.hpp"
#include "geometry/dual_basis.hpp"
#include "geometry/lattice_reduction.hpp"

namespace dch {
namespace {

using detail::describe;
using detail::dual_basis;
using detail::nearest_integer;
using detail::norm;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMinLength = 1e-100;  ///< shorter cell vectors would underflow when squared and multiplied
constexpr double kOrthorhombicTilt =
    1e-12;  ///< off-axis components below this share of the shortest cell vector are noise
constexpr double kMinVolumeRatio =
    1e-12;  ///< volume / (|a||b||c|) below this: linearly dependent up to rounding
/// Longest periodic vector over smallest height: with more, the rounding of a place along the one is as large
/// as the other.
constexpr double kMaxAspect = 1e12;
/// Images of the cell as given within half its smallest height, which all pairs look through for each pair.
constexpr double kMaxImages = 1e7;
constexpr const char* kVectorNames = "abc";

Vec3 axis_vector(int axis, double length) {
  Vec3 v;
  v[axis] = length;
  return v;
}

bool is_finite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void check_origin(Vec3 origin) {
  if (!is_finite(origin) || norm2(origin) > kMaxCoordinate * kMaxCoordinate) {
    throw InvalidBox("box origin " + describe(origin) + " is not finite or beyond " +
                     describe(kMaxCoordinate) + "; give the corner of the cell");
  }
}

void check_length(double length, const std::string& what) {
  if (!(length >= kMinLength && length <= kMaxCoordinate)) {
    throw InvalidBox(what + " is " + describe(length) + " long; it must be between " + describe(kMinLength) +
                     " and " + describe(kMaxCoordinate) + " (use Box::none() for open boundaries)");
  }
}

/// Before the reduction, whose integers would be beyond exact doubles, with the shortest vector for a height,
/// and after it.
void check_aspect(double longest, double height) {
  if (longest <= kMaxAspect * height) return;
  throw InvalidBox("the periodic cell is " + describe(longest) + " long and only " + describe(height) +
                   " high; double precision tells places apart up to a ratio of " + describe(kMaxAspect) +
                   "; take a less extreme cell, or open boundaries along its long vectors");
}

/// @param dual of the periodic vectors as given
void check_images(const std::array<Vec3, 3>& dual, int rank, double min_height) {
  double images = 1;
  for (std::size_t k = 0; k < static_cast<std::size_t>(rank); ++k) images *= 1 + min_height * norm(dual[k]);
  if (images <= kMaxImages) return;
  throw InvalidBox("the periodic cell is so skewed that about " + describe(std::floor(images)) +
                   " of its images lie within half its smallest height (" + describe(min_height) +
                   "); at most " + describe(kMaxImages) +
                   " are looked through; give a reduced cell, whose vectors are short, of the same lattice");
}

/// d plus the multiple of `period` that brings it into [-period/2, period/2]; an odd function of d.
double nearest_along(double d, double period) {
  if (std::abs(d) > 1.5 * period) d = std::remainder(d, period);
  const double half = 0.5 * period;
  d -= d > half ? period : 0.0;  // selects, not branches: their outcome is random
  d += d < -half ? period : 0.0;
  return d;
}

/// The image of x in [low, low + period).
double wrap_along(double x, double low, double period) {
  if (x >= low && x < low + period) return x;
  // Most points outside are in the next cell.
  const double image = x < low ? x + period : x - period;
  if (image >= low && image < low + period) return image;
  double offset = std::fmod(x - low, period);
  if (offset < 0) offset += period;
  const double inside = low + offset;
  return inside < low + period ? inside : low;
}

}  // namespace

Box Box::orthorhombic(Vec3 lengths, Periodic periodic, Vec3 origin) {
  check_origin(origin);
  Box box;
  box.kind_ = Kind::orthorhombic;
  box.periodic_ = periodic;
  box.origin_ = origin;
  for (int axis = 0; axis < 3; ++axis) {
    check_length(lengths[axis], std::string("box edge along ") + "xyz"[axis]);
    box.cell_[static_cast<std::size_t>(axis)] = axis_vector(axis, lengths[axis]);
  }
  box.reduce();
  return box;
}

Box Box::triclinic(Vec3 a, Vec3 b, Vec3 c, Periodic periodic, Vec3 origin) {
  const std::array<Vec3, 3> cell{a, b, c};
  check_origin(origin);
  double shortest = kInfinity;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string name = std::string("cell vector ") + kVectorNames[k] + " = " + describe(cell[k]);
    if (!is_finite(cell[k])) throw InvalidBox(name + " is not finite; check the box of this frame");
    check_length(norm(cell[k]), name);
    shortest = std::min(shortest, norm(cell[k]));
  }
  const Vec3 u = (1 / norm(a)) * a, v = (1 / norm(b)) * b, w = (1 / norm(c)) * c;
  if (std::abs(dot(u, cross(v, w))) < kMinVolumeRatio) {
    throw InvalidBox("cell vectors a = " + describe(a) + ", b = " + describe(b) + ", c = " + describe(c) +
                     " are linearly dependent (volume over product of lengths below " +
                     describe(kMinVolumeRatio) + "); give three independent vectors");
  }

  if (const double volume = std::abs(dot(a, cross(b, c))); !(volume >= std::numeric_limits<double>::min())) {
    throw InvalidBox("the volume of the cell is " + describe(volume) + "; double precision holds it from " +
                     describe(std::numeric_limits<double>::min()) + " on; use another unit of length");
  }

  double tilt = 0;
  for (int k = 0; k < 3; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      if (axis != k) tilt = std::max(tilt, std::abs(cell[static_cast<std::size_t>(k)][axis]));
    }
  }
  if (tilt <= kOrthorhombicTilt * shortest && a.x > 0 && b.y > 0 && c.z > 0) {
    return orthorhombic({a.x, b.y, c.z}, periodic, origin);
  }

  Box box;
  box.kind_ = Kind::triclinic;
  box.periodic_ = periodic;
  box.origin_ = origin;
  box.cell_ = cell;
  box.reduce();
  return box;
}

void Box::reduce() {
  std::vector<Vec3> periods;
  for (std::size_t k = 0; k < 3; ++k) {
    if (periodic_[k]) periods.push_back(cell_[k]);
  }
  rank_ = static_cast<int>(periods.size());
  axis_periods_ = {kInfinity, kInfinity, kInfinity};
  axis_parallel_ = true;
  if (rank_ == 0) return;

  const auto [shortest, longest] =
      std::minmax_element(periods.begin(), periods.end(), [](Vec3 a, Vec3 b) { return norm2(a) < norm2(b); });
  check_aspect(norm(*longest), norm(*shortest));

  const std::vector<Vec3> superbase = detail::obtuse_superbase(periods);
  std::copy_n(superbase.begin(), rank_, reduced_.begin());
  if (kind_ == Kind::orthorhombic) std::copy_n(periods.begin(), rank_, reduced_.begin());
  dual_ = dual_basis(reduced_, rank_);

  const std::vector<Vec3> sums = detail::subset_sums(superbase);
  relevant_count_ = static_cast<int>(sums.size());
  double shortest2 = kInfinity;
  for (std::size_t k = 0; k < sums.size(); ++k) {
    relevant_[k] = sums[k];
    relevant_norm2_[k] = norm2(sums[k]);
    shortest2 = std::min(shortest2, relevant_norm2_[k]);
  }
  safe_norm2_ = 0.25 * shortest2;

  for (std::size_t k = 0; k < periods.size(); ++k) {
    const Vec3 v = reduced_[k];
    const int axis = v.x != 0 ? 0 : v.y != 0 ? 1 : 2;
    const double length = std::abs(v[axis]);
    axis_parallel_ = axis_parallel_ && (v.x != 0) + (v.y != 0) + (v.z != 0) == 1;
    axis_periods_[axis] = length;
  }
  // Wrapping goes upwards along axes, and cells are counted along reduced vectors.
  if (axis_parallel_) {
    for (std::size_t k = 0; k < periods.size(); ++k)
      for (int axis = 0; axis < 3; ++axis) reduced_[k][axis] = std::abs(reduced_[k][axis]);
    dual_ = dual_basis(reduced_, rank_);
  }
  min_height_ = kInfinity;
  for (std::size_t k = 0; k < periods.size(); ++k) {
    const double height = axis_parallel_ ? norm(reduced_[k]) : 1 / norm(dual_[k]);
    min_height_ = std::min(min_height_, height);
  }
  check_aspect(norm(*longest), min_height_);
  std::array<Vec3, 3> given{};
  std::copy(periods.begin(), periods.end(), given.begin());
  check_images(dual_basis(given, rank_), rank_, min_height_);
}

std::string Box::description() const {
  if (kind_ == Kind::none) return "none";
  std::string text = kind_ == Kind::orthorhombic ? "orthorhombic " : "triclinic ";
  for (const bool p : periodic_) text += p ? 'p' : 'f';
  return text;
}

double Box::volume() const { return std::abs(dot(cell_[0], cross(cell_[1], cell_[2]))); }

double Box::shortest_period() const { return 2 * std::sqrt(safe_norm2_); }

double Box::max_distance() const {
  if (rank_ < 3) return kInfinity;
  // Nearest-plane rounding leaves a remainder inside the box of the orthogonalised basis, which is no longer
  // than the basis vectors.
  return 0.5 * std::sqrt(norm2(reduced_[0]) + norm2(reduced_[1]) + norm2(reduced_[2]));
}

Vec3 Box::fractional(Vec3 p) const {
  const Vec3 d = p - origin_;
  if (kind_ == Kind::none) return d;
  const auto dual = dual_basis(cell_, 3);
  return {dot(dual[0], d), dot(dual[1], d), dot(dual[2], d)};
}

Vec3 Box::wrap(Vec3 p) const {
  if (axis_parallel_) {
    for (int axis = 0; axis < 3; ++axis) {
      if (axis_periods_[axis] < kInfinity) p[axis] = wrap_along(p[axis], origin_[axis], axis_periods_[axis]);
    }
    return p;
  }
  // The second pass takes away what rounding left of a coordinate many boxes away.
  for (int pass = 0; pass < 2; ++pass) {
    const Vec3 d = p - origin_;
    for (std::size_t k = 0; k < static_cast<std::size_t>(rank_); ++k) {
      const double f = dot(dual_[k], d);
      if (f < 0 || f >= 1) p = p - std::floor(f) * reduced_[k];
    }
  }
  return p;
}

Vec3 Box::nearest_image_far(Vec3 d) const {
  if (axis_parallel_) {
    return {nearest_along(d.x, axis_periods_.x), nearest_along(d.y, axis_periods_.y),
            nearest_along(d.z, axis_periods_.z)};
  }
  return nearest_image_skewed(d);
}

/// Rounding in the reduced basis comes near; then the iterative slicer subtracts relevant vectors as long as
/// that shortens the displacement. All steps are odd functions of d, and the length falls strictly, so this
/// ends.
Vec3 Box::nearest_image_skewed(Vec3 d) const {
  const auto rank = static_cast<std::size_t>(rank_);
  for (int pass = 0; pass < 2; ++pass) {  // the second after the rounding of a displacement of many boxes
    std::array<double, 3> n{};
    for (std::size_t k = 0; k < rank; ++k) n[k] = nearest_integer(dot(dual_[k], d));
    if (n[0] == 0 && n[1] == 0 && n[2] == 0) break;
    for (std::size_t k = 0; k < rank; ++k) d = d - n[k] * reduced_[k];
  }
  double length2 = norm2(d);
  for (bool changed = true; changed && length2 > safe_norm2_;) {
    changed = false;
    for (std::size_t k = 0; k < static_cast<std::size_t>(relevant_count_); ++k) {
      const double along = dot(d, relevant_[k]);
      if (2 * std::abs(along) <= relevant_norm2_[k]) continue;
      const Vec3 shorter = d - nearest_integer(along / relevant_norm2_[k]) * relevant_[k];
      if (norm2(shorter) < length2) {
        d = shorter;
        length2 = norm2(shorter);
        changed = true;
      }
    }
  }
  return d;
}

}  // namespace dch
