// SPDX-License-Identifier: MIT
#include "crossing/near_midpoints.hpp"

#include <algorithm>

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

void NearMidpoints::choose_reach(Span<const SweepBounds> bounds, const Box& box) {
  const auto few = kFewestWide + static_cast<std::size_t>(kWideShare * static_cast<double>(bounds.size()));
  std::vector<SweepBounds> top(std::min(few + 1, bounds.size()));
  std::partial_sort_copy(bounds.begin(), bounds.end(), top.begin(), top.end(),
                         [](const SweepBounds& a, const SweepBounds& b) { return a.radius > b.radius; });
  largest_ = top.empty() ? 0 : std::max(top.front().radius, 0.0F);
  if (!top.empty() && top.back().radius > 0 && top.back().radius < kWorthwhile * largest_)
    largest_ = top.back().radius;
  // Beyond half the smallest height a list would have to hold several images.
  const double limit = 0.5 * box.max_cutoff();
  if (largest_ > limit) largest_ = static_cast<float>(limit * (1 - 1e-6));
  wide_.clear();
  for (std::size_t k = 0; k < bounds.size(); ++k) {
    if (bounds[k].radius > largest_) wide_.push_back(static_cast<std::int32_t>(k));
  }
}

void NearMidpoints::update(Span<const Vec3> centers, Span<const SweepBounds> bounds, const Box& box) {
  choose_reach(bounds, box);
  reach_ = std::clamp(2.0 * static_cast<double>(largest_) * (1 + 1e-6), kMinListRadius,
                      std::min(kMaxListRadius, box.max_cutoff()));
  if (!search_ || reach_ > search_radius_ || search_radius_ > box.max_cutoff() ||
      reach_ < search_radius_ / (kReserve * kReserve)) {
    search_radius_ = std::min({kReserve * reach_, kMaxListRadius, box.max_cutoff()});
    search_.emplace(search_radius_, executor_);
  }
  search_->update_by_reference(centers, box);
}

void NearMidpoints::for_each_piece(const std::function<void(const NeighborList&)>& use) {
  ListParams request;
  request.cutoffs = TypeCutoffs(reach_);
  request.superset = true;
  search_->list_in_pieces(request, use);
}

std::size_t NearMidpoints::memory_bytes() const {
  return (search_ ? search_->stats().memory_bytes : 0) + wide_.capacity() * sizeof(std::int32_t);
}

}  // namespace dch::necklace::detail
