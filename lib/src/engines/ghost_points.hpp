// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/engines/neighbor_pairs.hpp>

#include "engines/cell_images.hpp"

namespace dch::detail {

/// Cutoff + skin of a pair of particles [length].
inline double pair_reach(const NeighborPairsParams& params, std::size_t i, std::size_t j) {
  if (!params.radii.empty()) return params.radii[i] + params.radii[j] + params.skin;
  if (params.types.empty()) return params.cutoffs.largest() + params.skin;
  return params.cutoffs(params.types[i], params.types[j]) + params.skin;
}

/// @throws TooManyPairs
[[noreturn]] void refuse_pairs(double expected, const char* what, std::int64_t most);

/// Particles at home and, behind them, their images in reach: what an engine takes in open space.
class GhostPoints {
 public:
  /// @param home of the positions as given
  /// @param position_reach of those, from check_positions() [length]
  /// What is given must outlive this.
  /// @throws TooManyPairs; InvalidParameter for more than 32-bit indices can name.
  GhostPoints(Span<const Vec3> given, const Box& box, const HomeImages& home,
              const NeighborPairsParams& params, double list_radius, double position_reach);

  std::int32_t count() const { return static_cast<std::int32_t>(given_.size()); }  ///< of those at home
  const std::vector<Vec3>& positions() const { return positions_; }
  /// How far their distances may be from those that define pairs [length].
  double error() const { return error_; }
  const CellImages& images() const { return images_; }

  std::int32_t particle_of(std::int32_t point) const {
    return point < count() ? point : particle_[static_cast<std::size_t>(point - count())];
  }
  /// Number of its image of the cell.
  std::size_t image_of(std::int32_t point) const {
    return point < count() ? home_image_ : image_[static_cast<std::size_t>(point - count())];
  }

  /// Whether a pair, of which at most one is a ghost, is within its cutoff + skin, as pairs are defined.
  bool is_pair(std::int32_t a, std::int32_t b) const;

  /// Puts in what a list of pairs of those at home with all others needs.
  void ask(ListParams& request) const;

 private:
  Span<const Vec3> given_;
  const HomeImages& home_;
  const NeighborPairsParams& params_;
  double error_;
  CellImages images_;
  std::size_t home_image_;
  std::array<Vec3, 3> cell_{};
  std::vector<Vec3> positions_;
  std::vector<std::int32_t> particle_;  ///< of ghosts
  std::vector<std::uint32_t> image_;    ///< of ghosts
  std::vector<double> radii_;
  std::vector<std::int32_t> types_;
};

}  // namespace dch::detail
