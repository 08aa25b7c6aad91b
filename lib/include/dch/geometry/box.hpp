// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// Largest coordinate magnitude accepted [length]; keeps squared distances far from overflow.
inline constexpr double kMaxCoordinate = 1e100;

/// The simulation cell: none, orthorhombic or triclinic, periodic along any subset of its vectors.
///
/// The cell may be unreduced (arbitrarily skewed); nearest images are true nearest images all the same.
/// Internally the periodic vectors are Selling-reduced to an obtuse superbase, whose subset sums contain
/// every Voronoi-relevant vector of the lattice (Conway and Sloane, Proc. R. Soc. A 436:55, 1992); a
/// displacement that no relevant vector shortens is the shortest of its class. Naive rounding in a skewed
/// cell is not a metric and would break the packing lemma (5.3.2) that the hierarchy rests on.
///
/// A copy is cheap (a few hundred bytes); a Box never changes after construction.
class Box {
 public:
  enum class Kind { none, orthorhombic, triclinic };
  using Periodic = std::array<bool, 3>;

  /// No cell: open boundaries along every axis.
  Box() = default;
  static Box none() { return Box(); }

  // Whatever of a box that is accepted is computed, volume, heights and their inverses, double precision
  // holds, and no search through its images is longer than 1e7 steps a pair.

  /// Axis-parallel cell [origin, origin + lengths).
  /// @throws InvalidBox unless every length is in 1e-100..1e100 (along non-periodic axes too: use none()),
  /// and
  ///   that of the longest periodic edge at most 1e12 times that of the shortest.
  static Box orthorhombic(Vec3 lengths, Periodic periodic = {true, true, true}, Vec3 origin = {});

  /// Cell spanned by a, b, c (any orientation). Becomes orthorhombic if the off-axis components are below
  /// 1e-12 of the shortest vector (file formats leave tilts of 1e-17 behind).
  /// @throws InvalidBox if a vector is not finite or its length not in 1e-100..1e100, if the three are
  /// linearly
  ///   dependent (a volume below 1e-12 of the product of their lengths, or below 2.2e-308), if a periodic
  ///   vector is longer than 1e12 times the smallest height, and for cells so skewed that more than 1e7 of
  ///   their images may lie within half that height.
  static Box triclinic(Vec3 a, Vec3 b, Vec3 c, Periodic periodic = {true, true, true}, Vec3 origin = {});

  Kind kind() const { return kind_; }
  /// "none", "orthorhombic ppp", "triclinic ppf", ...
  std::string description() const;

  bool periodic(int axis) const { return periodic_[static_cast<std::size_t>(axis)]; }
  bool any_periodic() const { return rank_ > 0; }
  /// Cell vector `axis` as given [length]; zero without a cell.
  Vec3 vector(int axis) const { return cell_[static_cast<std::size_t>(axis)]; }
  Vec3 origin() const { return origin_; }
  double volume() const;

  /// Smallest perpendicular height of the reduced periodic cell [length]; infinity if nothing is periodic.
  double min_height() const { return min_height_; }
  /// Largest cutoff + skin for which one image of each neighbor suffices: min_height() / 2.
  double max_cutoff() const { return 0.5 * min_height_; }

  /// Shortest vector of the class d + lattice [length]. Exactly antisymmetric, ties included:
  /// nearest_image(-d) is -nearest_image(d). Cheapest for displacements of wrapped points, right for any.
  Vec3 nearest_image(Vec3 d) const { return norm2(d) <= safe_norm2_ ? d : nearest_image_far(d); }

  /// Squared distance of the nearest images of p and q [length^2]; a metric on the torus, bitwise symmetric.
  double distance2(Vec3 p, Vec3 q) const { return norm2(nearest_image(q - p)); }

  /// The image of p inside the reduced cell: fractional coordinates in [0, 1) along periodic vectors, exactly
  /// so if these are parallel to the axes, else up to rounding. Unchanged along others.
  Vec3 wrap(Vec3 p) const;

  /// Fractional coordinates of p with respect to the cell vectors as given; p - origin without a cell.
  Vec3 fractional(Vec3 p) const;

  /// Largest distance two points can have on a fully periodic torus (an upper bound) [length]; infinity if
  /// some axis is open.
  double max_distance() const;

  /// Periodic vectors after Selling reduction, and their number (0 to 3). For an orthorhombic box they are
  /// the axis vectors of the periodic axes.
  const std::array<Vec3, 3>& reduced() const { return reduced_; }
  /// Dual basis of reduced() within its span, dual_i . reduced_j = delta_ij [1/length]; heights are
  /// 1/|dual_i|.
  const std::array<Vec3, 3>& reduced_dual() const { return dual_; }
  int rank() const { return rank_; }
  /// One of each pair +-v of candidate Voronoi-relevant vectors [length].
  Span<const Vec3> relevant() const { return {relevant_.data(), static_cast<std::size_t>(relevant_count_)}; }
  /// Length of the shortest lattice vector; infinity if nothing is periodic.
  double shortest_period() const;

  friend bool operator==(const Box& a, const Box& b) {
    return a.kind_ == b.kind_ && a.periodic_ == b.periodic_ && a.cell_ == b.cell_ && a.origin_ == b.origin_;
  }
  friend bool operator!=(const Box& a, const Box& b) { return !(a == b); }

 private:
  void reduce();
  Vec3 nearest_image_far(Vec3 d) const;
  Vec3 nearest_image_skewed(Vec3 d) const;

  static constexpr double kOpen = std::numeric_limits<double>::infinity();

  Kind kind_ = Kind::none;
  Periodic periodic_{false, false, false};
  Vec3 origin_{};
  std::array<Vec3, 3> cell_{};
  int rank_ = 0;                    ///< number of periodic vectors
  std::array<Vec3, 3> reduced_{};   ///< reduced periodic vectors, the first rank_ are set
  std::array<Vec3, 3> dual_{};      ///< dual basis of reduced_ within its span: dual_i . reduced_j = delta_ij
  std::array<Vec3, 7> relevant_{};  ///< one of each +-pair of candidate Voronoi-relevant vectors
  std::array<double, 7> relevant_norm2_{};
  int relevant_count_ = 0;
  bool axis_parallel_ = true;               ///< every reduced vector is parallel to an axis
  Vec3 axis_periods_{kOpen, kOpen, kOpen};  ///< period along each axis then; infinite along open axes
  double safe_norm2_ = kOpen;  ///< a displacement this short is nearest already: (shortest vector / 2)^2
  double min_height_ = kOpen;
};

/// Whether both are periodic along the same of their vectors.
inline bool same_periodicity(const Box& a, const Box& b) {
  return a.periodic(0) == b.periodic(0) && a.periodic(1) == b.periodic(1) && a.periodic(2) == b.periodic(2);
}

}  // namespace dch
#pragma GCC visibility pop
