// SPDX-License-Identifier: MIT
#include "crossing/near_midpoints.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace dch::necklace::detail {
namespace {

/// As many of the largest balls may be wide as would cost about a tenth of what the search does.
constexpr std::size_t kFewestWide = 4;
constexpr double kWideShare = 5e-5;
/// They are if that makes the reach smaller by this factor.
constexpr float kWorthwhile = 0.8F;
/// The search is made for this much more than is needed, so that it serves the next steps too.
constexpr double kReserve = 1.1;

}  // namespace

void NearMidpoints::choose_reach(Span<const float> radii, const Box& box) {
  const auto few = kFewestWide + static_cast<std::size_t>(kWideShare * static_cast<double>(radii.size()));
  std::vector<float> top(std::min(few + 1, radii.size()));
  std::partial_sort_copy(radii.begin(), radii.end(), top.begin(), top.end(), std::greater<>());
  largest_ = top.empty() ? 0 : std::max(top.front(), 0.0F);
  if (!top.empty() && top.back() > 0 && top.back() < kWorthwhile * largest_) largest_ = top.back();
  // Beyond half the smallest height a list would have to hold several images.
  const double limit = 0.5 * box.max_cutoff();
  if (largest_ > limit) largest_ = static_cast<float>(limit * (1 - 1e-6));
  wide_.clear();
  for (std::size_t k = 0; k < radii.size(); ++k) {
    if (is_wide(radii[k])) wide_.push_back(static_cast<std::int32_t>(k));
  }
}

void NearMidpoints::update(Span<const Vec3> centers, Span<const float> radii, const Box& box) {
  choose_reach(radii, box);
  const double reach = std::clamp(2.0 * static_cast<double>(largest_) * (1 + 1e-6), kMinListRadius,
                                  std::min(kMaxListRadius, box.max_cutoff()));
  if (!search_ || reach > search_radius_ || search_radius_ > box.max_cutoff() ||
      reach < search_radius_ / (kReserve * kReserve)) {
    const double radius = std::min({kReserve * reach, kMaxListRadius, box.max_cutoff()});
    search_ = make_grid_search(radius, executor_);
    search_radius_ = radius;
  }
  search_->update(centers, box);
  ListParams request;
  request.cutoffs = TypeCutoffs(reach);
  request.order = RowOrder::by_structure;
  request.superset = true;
  search_->list(request, list_);
}

std::size_t NearMidpoints::memory_bytes() const {
  return list_.j.capacity() * sizeof(std::int32_t) + list_.particle.capacity() * sizeof(std::int32_t) +
         list_.first.capacity() * sizeof(std::int64_t) + wide_.capacity() * sizeof(std::int32_t);
}

}  // namespace dch::necklace::detail
