// SPDX-License-Identifier: MIT
#include "geometry/lattice_reduction.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include "base/nearest_integer.hpp"
#include "geometry/dual_basis.hpp"

namespace dch::detail {
namespace {

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

}  // namespace

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

}  // namespace dch::detail
