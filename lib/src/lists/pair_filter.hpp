// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>
#include <dch/lists/list_params.hpp>

#include "geometry/lattice.hpp"
#include "leaves/cutoff_by.hpp"

namespace dch::detail {

/// Decides whether a pair belongs in a list, exactly as ListParams defines it.
///
/// Engines find candidates by distances between wrapped images, which round differently. Outside a narrow
/// band around the cutoff such a distance decides; inside it the pair distance is evaluated anew from the
/// positions as given. So every engine writes the same list.
class PairFilter {
 public:
  /// @param positions as given to the engine, not wrapped; they and what params points to must outlive this.
  /// @param error how far distances of wrapped images may be from what decides: WrapError::bound for these
  ///   positions, and what params.cutoff_error() adds [length].
  PairFilter(Span<const Vec3> positions, const Box& box, const ListParams& params, double error)
      : PairFilter(positions, box, params, error, RadiusRange(params.radii)) {}
  /// The same in O(1), where the range of the radii is known.
  PairFilter(Span<const Vec3> positions, const Box& box, const ListParams& params, double error,
             const RadiusRange& radii);

  /// No pair at a larger squared distance of wrapped images is in the list, whatever its types [length^2].
  double largest_distance2() const { return largest_; }

  /// @param distance2 of the nearest wrapped images of i and j [length^2].
  bool accept(std::int32_t i, std::int32_t j, double distance2) const {
    const Band band = by_ == CutoffBy::one_cutoff ? bands_.front() : band_of(i, j);
    if (distance2 > band.out_above) return false;
    if (restricted_ && !is_wanted(i, j)) return false;
    return distance2 <= band.in_below || is_within(i, j, band.cutoff2);
  }

  /// The same for a pair whose distance is not known.
  bool accept(std::int32_t i, std::int32_t j) const;

  CutoffBy by() const { return by_; }
  const ListParams& params() const { return params_; }
  /// Smallest of the radii, where cutoffs go by them [length].
  double least_radius() const { return least_radius_; }
  /// Has the positions of a pair fetched that is to be decided soon.
  void ask_for(std::int32_t i, std::int32_t j) const {
    __builtin_prefetch(&positions_[static_cast<std::size_t>(i)]);
    __builtin_prefetch(&positions_[static_cast<std::size_t>(j)]);
  }
  bool is_ghost(std::int32_t i) const { return first_ghost_ >= 0 && i >= first_ghost_; }
  Span<const std::int32_t> excluded_with(std::int32_t i) const {
    return exclusions_ != nullptr ? exclusions_->partners(i) : Span<const std::int32_t>();
  }
  /// Whether exclusions or ghosts may keep some pair of i out of the list.
  bool restricts(std::int32_t i) const {
    return (exclusions_ != nullptr && !exclusions_->partners(i).empty()) ||
           (first_ghost_ >= 0 && i >= first_ghost_);
  }
  /// Whether they may keep any pair out.
  bool restricts_any() const { return restricted_; }
  /// Whether exclusions and ghosts let the pair be in the list.
  bool is_wanted(std::int32_t i, std::int32_t j) const;

 private:
  /// Squared distances of wrapped images that settle the matter, and the limit for the others.
  struct Band {
    double in_below;
    double out_above;
    double cutoff2;
  };
  Band band_of(std::int32_t i, std::int32_t j) const;
  Band band_within(double reach) const;
  bool is_within(std::int32_t i, std::int32_t j, double cutoff2) const;

  Span<const Vec3> positions_;
  const Box& box_;
  ListParams params_;
  double error_;
  const TieBreaker* tie_breaker_;
  const Exclusions* exclusions_;
  std::int32_t first_ghost_;
  CutoffBy by_;
  bool restricted_;          ///< by exclusions or ghosts
  std::vector<Band> bands_;  ///< by pair of types
  double largest_ = -1;
  double least_radius_ = 0;

  std::array<Vec3, 3> cell_;  ///< as given
  Lattice images_;
  std::vector<Vec3>
      other_images_;  ///< integers of one of each +-pair of lattice vectors between two images as near
};

}  // namespace dch::detail
