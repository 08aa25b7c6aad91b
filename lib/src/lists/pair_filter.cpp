// SPDX-License-Identifier: MIT
#include "lists/pair_filter.hpp"

#include <algorithm>
#include <cmath>

namespace dch::detail {
namespace {

constexpr double kRounding = 1e-14;  ///< relative error of a squared distance, generously

double image_distance2(Vec3 d, Vec3 n, const std::array<Vec3, 3>& cell) {
  return norm2(((d + n.x * cell[0]) + n.y * cell[1]) + n.z * cell[2]);
}

}  // namespace

PairFilter::PairFilter(Span<const Vec3> positions, const Box& box, const ListParams& params, double error,
                       const RadiusRange& radii)
    : positions_(positions),
      box_(box),
      params_(params),
      error_(error),
      tie_breaker_(params.tie_breaker),
      exclusions_(params.exclusions != nullptr && !params.exclusions->empty() ? params.exclusions : nullptr),
      first_ghost_(params.first_ghost),
      by_(!params.radii.empty()         ? CutoffBy::radii
          : params.cutoffs.types() == 1 ? CutoffBy::one_cutoff
                                        : CutoffBy::types),
      restricted_(exclusions_ != nullptr || first_ghost_ >= 0),
      cell_{box.vector(0), box.vector(1), box.vector(2)},
      images_(box) {
  if (by_ == CutoffBy::radii) {
    largest_ = band_within(2 * radii.largest + params.skin).out_above;
    least_radius_ = radii.least;
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

  // Two images of a particle can both be at the cutoff only if it is half a lattice vector, a shortest one.
  if (2 * std::sqrt(largest_) >= box.shortest_period())
    for (const Vec3 v : box.relevant()) other_images_.push_back(images_.integers(v));
}

PairFilter::Band PairFilter::band_within(double reach) const {
  const double inside = reach - error_, outside = reach + error_;
  // With an error as large as the reach no distance says that a pair is within it, not even 0.
  const double in_below = inside <= 0 ? -1 : inside * inside * (1 - kRounding);
  return {in_below, outside * outside * (1 + kRounding), reach * reach};
}

PairFilter::Band PairFilter::band_of(std::int32_t i, std::int32_t j) const {
  if (by_ == CutoffBy::radii) return band_within(params_.radii[i] + params_.radii[j] + params_.skin);
  return bands_[std::size_t{1} * params_.types[i] * params_.cutoffs.types() + params_.types[j]];
}

bool PairFilter::accept(std::int32_t i, std::int32_t j) const {
  const Band band = by_ == CutoffBy::one_cutoff ? bands_.front() : band_of(i, j);
  return is_wanted(i, j) && is_within(i, j, band.cutoff2);
}

bool PairFilter::is_wanted(std::int32_t i, std::int32_t j) const {
  if (first_ghost_ >= 0 && i >= first_ghost_ && j >= first_ghost_) return false;
  return exclusions_ == nullptr || !exclusions_->excluded(i, j);
}

/// The same for (j, i): displacements and their nearest images are exactly the opposite then, as all
/// roundings are.
bool PairFilter::is_within(std::int32_t i, std::int32_t j, double cutoff2) const {
  if (tie_breaker_ != nullptr) return cutoff2 >= 0 && tie_breaker_->accepts(i, j);
  const Vec3 d = positions_[static_cast<std::size_t>(j)] - positions_[static_cast<std::size_t>(i)];
  const Vec3 nearest = box_.nearest_image(d);
  if (nearest == d && other_images_.empty()) return norm2(d) <= cutoff2;
  const Vec3 n = images_.integers(nearest - d);
  const auto is_near = [&](Vec3 m) { return image_distance2(d, m, cell_) <= cutoff2; };
  if (is_near(n)) return true;
  return std::any_of(other_images_.begin(), other_images_.end(),
                     [&](Vec3 m) { return is_near(n + m) || is_near(n - m); });
}

}  // namespace dch::detail
