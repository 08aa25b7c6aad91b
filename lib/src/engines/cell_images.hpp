// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>

#include "geometry/lattice.hpp"

namespace dch::detail {

/// Particles wrapped into the reduced cell.
struct HomeImages {
  using Shift = std::array<std::int32_t, 3>;

  /// @throws InvalidPosition for particles more periods away than half of kMostPeriods.
  HomeImages(Span<const Vec3> given, const Box& box);
  static constexpr double kMostPeriods = 0x1p29;

  std::vector<Vec3> positions;
  std::vector<Shift> shifts;  ///< what was added to the positions as given, in cell vectors
};

/// The integers of a shift whose components are whole up to rounding.
/// @throws InvalidPosition for more than HomeImages::kMostPeriods.
HomeImages::Shift shift_of(Vec3 integers);

/// Images of the reduced cell whose multiples of the reduced vectors lie in a block of integers, by number.
class CellImages {
 public:
  using Multiples = std::array<std::int64_t, 3>;

  /// @param low, high of the multiples, 0 beyond the rank of the box
  CellImages(const Box& box, const Multiples& low, const Multiples& high);

  /// How many images; as a double, since there may be more than integers count.
  static double count(const Multiples& low, const Multiples& high);
  std::size_t number(const Multiples& n) const {
    return static_cast<std::size_t>(((n[0] - low_[0]) * width_[1] + (n[1] - low_[1])) * width_[2] +
                                    (n[2] - low_[2]));
  }
  const std::vector<HomeImages::Shift>& shifts() const { return shifts_; }  ///< in cell vectors, by number
  const std::vector<Vec3>& vectors() const { return vectors_; }             ///< by number [length]

 private:
  Multiples low_, width_{};
  std::vector<HomeImages::Shift> shifts_;
  std::vector<Vec3> vectors_;
};

/// Which images of particles may lie within some reach of a particle that is at home.
class GhostImages {
 public:
  /// @param reach [length]
  GhostImages(const HomeImages& home, const Box& box, double reach);

  /// How many images there are, and how many particles at most in all of them.
  double images() const { return CellImages::count(low_, high_); }
  double ghosts() const { return ghosts_; }

  CellImages cell_images(const Box& box) const { return {box, low_, high_}; }
  /// Adds those that are in reach, without the particles at home; their particles and images by number.
  void add(const CellImages& images, std::vector<Vec3>& positions, std::vector<std::int32_t>& particle,
           std::vector<std::uint32_t>& image) const;

 private:
  struct Range {
    std::int64_t low, high;
  };
  std::array<Range, 3> ranges(Vec3 p) const;

  const HomeImages& home_;
  std::size_t rank_;
  Vec3 origin_;
  std::array<Vec3, 3> dual_;
  std::array<double, 3> least_{}, most_{};  ///< of fractional coordinates that are within reach
  CellImages::Multiples low_{}, high_{};
  double ghosts_ = 0;
};

}  // namespace dch::detail
