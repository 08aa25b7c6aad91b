// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/vec3.hpp>

#include "multi_indices.hpp"
#include "simd/sum_kernels.hpp"

namespace dch::detail {

/// Taylor expansions of a kernel K(x - y) up to a total degree, about a center of sources and one of targets:
///
///   K(x - y) = sum of D_(i+j)(R) (x - a)^i / i! (b - y)^j / j!,   R = a - b,  degree(i + j) <= order
///
/// A multipole expansion is the sum over charges of q (b - y)^j / j!, a local one the sum over sources of
/// D_(i+j) times that. Both are kept in units of the radius of their node to the degree, so that no power of
/// a small or large distance leaves the range of numbers.
///
/// Where the kernel is harmonic (1 / r) second derivatives along z are the others' negative sum. Then the
/// moments that translations take, and what they give, have at most z^1: (order + 1)^2 of them.
class Expansions {
 public:
  Expansions(int order, bool is_harmonic);

  int order() const { return order_; }
  bool is_harmonic() const { return is_harmonic_; }
  /// Of whole expansions, and of those that translations take and give.
  std::size_t size() const { return static_cast<std::size_t>(whole_.size()); }
  /// Padded with zeros.
  std::size_t short_size() const { return static_cast<std::size_t>(padded(short_.size())); }
  std::size_t work_size() const { return work_size_; }
  TranslationTables tables() const;

  /// Adds a charge to a multipole expansion. @param from_center over the radius
  void add_charge(double charge, Vec3 from_center, double* moments) const;
  /// Adds the multipole expansion of a child. @param to_center from the child's, over the parent's radius
  /// @param size radius of the child over that of the parent
  void add_child(const double* child, Vec3 to_center, double size, double* moments) const;
  void shorten(const double* moments, double* short_moments) const;

  /// The whole of a local expansion of which the short part was summed. Adds to `local`.
  void add_whole(const double* short_local, double* local) const;
  /// The local expansion of a parent about a child's center. @param from_center of the parent, over its
  /// radius
  /// @param size radius of the child over that of the parent
  void to_child(const double* local, Vec3 from_center, double size, double* child) const;
  double potential(const double* local, Vec3 from_center) const;

 private:
  using Monomials = std::array<double, (kMaxOrder + 1) * (kMaxOrder + 2) * (kMaxOrder + 3) / 6>;
  /// v^i / i! for all i.
  void set_monomials(Vec3 v, Monomials& monomials) const;
  /// Multiplies by `size` to the degree.
  void scale_degrees(double size, double* expansion) const;
  void list_steps();

  int order_;
  bool is_harmonic_;
  MultiIndices whole_, short_;
  std::size_t work_size_ = 0;
  std::vector<int> place_in_whole_;              ///< of short ones
  std::vector<std::array<int, 3>> translation_;  ///< whole ones: i + j, i, j
  std::vector<DerivativeStep> steps_;
  std::vector<std::int32_t> traces_, degree_end_;
  std::vector<std::uint16_t> derivative_;
};

}  // namespace dch::detail
