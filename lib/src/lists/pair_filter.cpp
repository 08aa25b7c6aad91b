// SPDX-License-Identifier: MIT
#include "lists/pair_filter.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/dual_basis.hpp"

namespace dch::detail {
namespace {

constexpr double kRounding = 1e-14;  ///< relative error of a squared distance, generously

double image_distance2(Vec3 d, Vec3 n, const std::array<Vec3, 3>& cell) {
  return norm2(((d + n.x * cell[0]) + n.y * cell[1]) + n.z * cell[2]);
}

Vec3 rounded(Vec3 v) { return {std::nearbyint(v.x), std::nearbyint(v.y), std::nearbyint(v.z)}; }

}  // namespace

PairFilter::PairFilter(Span<const Vec3> positions, const Box& box, const ListParams& params, double error)
    : positions_(positions),
      box_(box),
      params_(params),
      error_(error),
      near_cutoff_(params.near_cutoff),
      exclusions_(params.exclusions != nullptr && !params.exclusions->empty() ? params.exclusions : nullptr),
      first_ghost_(params.first_ghost),
      by_(!params.radii.empty()         ? CutoffBy::radii
          : params.cutoffs.types() == 1 ? CutoffBy::one_cutoff
                                        : CutoffBy::types),
      restricted_(exclusions_ != nullptr || first_ghost_ >= 0) {
  if (by_ == CutoffBy::radii) {
    largest_ = band_within(params.list_radius()).out_above;
    least_radius_ = *std::min_element(params.radii.begin(), params.radii.end());
  } else {
    for (int a = 0; a < params.cutoffs.types(); ++a) {
      for (int b = 0; b < params.cutoffs.types(); ++b) {
        const double cutoff = params.cutoffs(a, b);
        // A cutoff of 0 drops the pair, coincident ones too.
        bands_.push_back(cutoff == 0 ? Band{-1, -1, -1} : band_within(cutoff + params.skin));
        largest_ = std::max(largest_, bands_.back().out_above);
      }
    }
  }

  std::array<Vec3, 3> periods{};
  std::array<std::size_t, 3> axes{};
  int rank = 0;
  for (int axis = 0; axis < 3; ++axis) {
    cell_[static_cast<std::size_t>(axis)] = box.vector(axis);
    if (!box.periodic(axis)) continue;
    periods[static_cast<std::size_t>(rank)] = box.vector(axis);
    axes[static_cast<std::size_t>(rank)] = static_cast<std::size_t>(axis);
    ++rank;
  }
  const auto dual = dual_basis(periods, rank);
  for (std::size_t k = 0; k < static_cast<std::size_t>(rank); ++k) dual_[axes[k]] = dual[k];

  if (box.kind() != Box::Kind::triclinic) {
    constexpr double kClear = 0.5 * (1 - 1e-9);
    for (int axis = 0; axis < 3; ++axis)
      clear_half_[axis] = box.periodic(axis) ? kClear * box.vector(axis)[axis] : kMaxCoordinate * 4;
  }
  // Two images of a particle can both be at the cutoff only if it is half a lattice vector, a shortest one.
  if (rank > 0 && 2 * std::sqrt(largest_) >= box.shortest_period() * (1 - kRounding)) {
    for (const Vec3 v : box.relevant()) {
      const Vec3 n = rounded({dot(dual_[0], v), dot(dual_[1], v), dot(dual_[2], v)});
      other_images_.push_back(n);
      other_images_.push_back(-1.0 * n);
    }
  }
}

PairFilter::Band PairFilter::band_within(double reach) const {
  const double inside = reach - error_, outside = reach + error_;
  // With an error beyond the reach no distance says that a pair is within it, not even 0.
  const double in_below = inside < 0 ? -1 : inside * inside * (1 - kRounding);
  return {in_below, outside * outside * (1 + kRounding), reach * reach};
}

PairFilter::Band PairFilter::band_of(std::int32_t i, std::int32_t j) const {
  if (by_ == CutoffBy::radii) return band_within(params_.radii[i] + params_.radii[j] + params_.skin);
  return bands_[std::size_t{1} * params_.types[i] * params_.cutoffs.types() + params_.types[j]];
}

bool PairFilter::accept(std::int32_t i, std::int32_t j) const {
  const Band band = by_ == CutoffBy::one_cutoff ? bands_.front() : band_of(i, j);
  return !(restricted_ && !is_wanted(i, j)) && is_within(i, j, band.cutoff2);
}

bool PairFilter::is_wanted(std::int32_t i, std::int32_t j) const {
  if (first_ghost_ >= 0 && i >= first_ghost_ && j >= first_ghost_) return false;
  return exclusions_ == nullptr || !exclusions_->excluded(i, j);
}

bool PairFilter::is_within(std::int32_t i, std::int32_t j, double cutoff2) const {
  if (near_cutoff_ != nullptr) return cutoff2 >= 0 && near_cutoff_->accepts(i, j);
  if (i > j) std::swap(i, j);
  const Vec3 d = positions_[static_cast<std::size_t>(j)] - positions_[static_cast<std::size_t>(i)];
  if (std::abs(d.x) < clear_half_.x && std::abs(d.y) < clear_half_.y && std::abs(d.z) < clear_half_.z)
    return norm2(d) <= cutoff2;  // the nearest image, and no other one is as near
  const Vec3 shift = box_.nearest_image(d) - d;
  const Vec3 n = rounded({dot(dual_[0], shift), dot(dual_[1], shift), dot(dual_[2], shift)});
  if (image_distance2(d, n, cell_) <= cutoff2) return true;
  return std::any_of(other_images_.begin(), other_images_.end(),
                     [&](Vec3 m) { return image_distance2(d, n + m, cell_) <= cutoff2; });
}

}  // namespace dch::detail
