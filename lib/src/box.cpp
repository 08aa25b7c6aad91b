// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <vector>

#include <dch/box.hpp>
#include <dch/error.hpp>

#include "describe.hpp"
#include "dual_basis.hpp"

namespace dch {
namespace {

using detail::describe;
using detail::dual_basis;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMinLength = 1e-100;  ///< shorter cell vectors would underflow when squared and multiplied
constexpr double kOrthorhombicTilt =
    1e-12;  ///< off-axis components below this share of the cell's size are noise
constexpr double kMinVolumeRatio =
    1e-12;  ///< volume / (|a||b||c|) below this: linearly dependent up to rounding
constexpr const char* kVectorNames = "abc";

double norm(Vec3 v) { return std::sqrt(norm2(v)); }
Vec3 axis_vector(int axis, double length) {
  Vec3 v;
  v[axis] = length;
  return v;
}

/// Nearest integer, an odd function (ties go to the even one). Needs no call to the mathematics library as
/// long as |x| < 2^51.
double nearest_integer(double x) {
  constexpr double kShift = 6755399441055744.0;  // 1.5 * 2^52: doubles of this size are integers
  return std::abs(x) < 2251799813685248.0 ? (x + kShift) - kShift : std::nearbyint(x);
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

/// A lattice vector together with its integer coordinates in the vectors it was made from, so that its value
/// can be computed anew from those without the rounding of the steps between.
struct LatticeVector {
  Vec3 value;
  std::array<double, 3> coefficients{};

  void add(double factor, const LatticeVector& other) {
    value = value + factor * other.value;
    for (std::size_t k = 0; k < 3; ++k) coefficients[k] += factor * other.coefficients[k];
  }
};

/// Lagrange-Gauss steps on all pairs: every step shortens a vector, so this ends, after a number of steps
/// that is logarithmic in the skew (the steps of Selling's algorithm alone would be linear in it).
void shorten_pairwise(std::vector<LatticeVector>& basis) {
  for (bool changed = true; changed;) {
    changed = false;
    for (auto& u : basis) {
      for (const auto& v : basis) {
        if (&u == &v) continue;
        const double k = nearest_integer(dot(u.value, v.value) / norm2(v.value));
        if (k == 0) continue;
        LatticeVector shorter = u;
        shorter.add(-k, v);
        if (norm2(shorter.value) < norm2(u.value)) {
          u = shorter;
          changed = true;
        }
      }
    }
  }
}

/// One step of Selling's algorithm on a pair with v_i . v_j > 0: the superbase v_0 + ... + v_rank = 0 stays
/// one, and its sum of squares falls by 4 v_i . v_j in three dimensions, 2 v_i . v_j in the plane.
void selling_step(std::vector<LatticeVector>& superbase, std::size_t i, std::size_t j) {
  const LatticeVector v = superbase[i];
  const double factor = superbase.size() == 4 ? 1 : 2;
  for (std::size_t k = 0; k < superbase.size(); ++k) {
    if (k != i && k != j) superbase[k].add(factor, v);
  }
  superbase[i].add(-2, v);
}

/// Makes a superbase of short vectors obtuse: all v_i . v_j <= 0, up to rounding.
void make_obtuse(std::vector<LatticeVector>& superbase) {
  constexpr double kRounding = 1e-14;
  constexpr int kMaxSteps =
      10000;  // a handful suffices for short vectors; ends a cycle that rounding might make
  int steps = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < superbase.size(); ++i) {
      for (std::size_t j = i + 1; j < superbase.size(); ++j) {
        const Vec3 u = superbase[i].value, v = superbase[j].value;
        if (dot(u, v) <= kRounding * norm(u) * norm(v) || steps == kMaxSteps) continue;
        selling_step(superbase, i, j);
        ++steps;
        changed = true;
      }
    }
  }
}

/// Obtuse superbase of the lattice spanned by the vectors: rank + 1 vectors that sum to zero.
std::vector<Vec3> obtuse_superbase(const std::vector<Vec3>& periods) {
  std::vector<LatticeVector> superbase;
  for (std::size_t k = 0; k < periods.size(); ++k) {
    superbase.push_back({periods[k], {}});
    superbase.back().coefficients[k] = 1;
  }
  shorten_pairwise(superbase);
  LatticeVector last;
  for (const auto& v : superbase) last.add(-1, v);
  superbase.push_back(last);
  make_obtuse(superbase);

  std::vector<Vec3> result;
  for (const auto& v : superbase) {
    Vec3 exact;
    for (std::size_t k = 0; k < periods.size(); ++k) exact = exact + v.coefficients[k] * periods[k];
    result.push_back(exact);
  }
  return result;
}

/// One of each pair +-v among the sums of proper, non-empty subsets of a superbase.
std::vector<Vec3> subset_sums(const std::vector<Vec3>& superbase) {
  const std::size_t rank = superbase.size() - 1;
  std::vector<Vec3> sums;
  for (unsigned subset = 1; subset < 1u << rank; ++subset) {  // never the last vector: the complement has it
    Vec3 sum;
    for (std::size_t k = 0; k < rank; ++k) {
      if (subset >> k & 1u) sum = sum + superbase[k];
    }
    sums.push_back(sum);
  }
  return sums;
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
  double size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string name = std::string("cell vector ") + kVectorNames[k] + " = " + describe(cell[k]);
    if (!is_finite(cell[k])) throw InvalidBox(name + " is not finite; check the box of this frame");
    check_length(norm(cell[k]), name);
    size = std::max(size, norm(cell[k]));
  }
  const Vec3 u = (1 / norm(a)) * a, v = (1 / norm(b)) * b, w = (1 / norm(c)) * c;
  if (std::abs(dot(u, cross(v, w))) < kMinVolumeRatio) {
    throw InvalidBox("cell vectors a = " + describe(a) + ", b = " + describe(b) + ", c = " + describe(c) +
                     " are linearly dependent (volume over product of lengths below " +
                     describe(kMinVolumeRatio) + "); give three independent vectors");
  }

  double tilt = 0;
  for (int k = 0; k < 3; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      if (axis != k) tilt = std::max(tilt, std::abs(cell[static_cast<std::size_t>(k)][axis]));
    }
  }
  if (tilt <= kOrthorhombicTilt * size && a.x > 0 && b.y > 0 && c.z > 0) {
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

  const std::vector<Vec3> superbase = obtuse_superbase(periods);
  std::copy_n(superbase.begin(), rank_, reduced_.begin());
  if (kind_ == Kind::orthorhombic) std::copy_n(periods.begin(), rank_, reduced_.begin());
  dual_ = dual_basis(reduced_, rank_);

  const std::vector<Vec3> sums = subset_sums(superbase);
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
  min_height_ = kInfinity;
  for (std::size_t k = 0; k < periods.size(); ++k) {
    const double height = axis_parallel_ ? norm(reduced_[k]) : 1 / norm(dual_[k]);
    min_height_ = std::min(min_height_, height);
  }
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
