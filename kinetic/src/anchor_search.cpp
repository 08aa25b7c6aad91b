// SPDX-License-Identifier: MIT
#include "anchor_search.hpp"

#include <algorithm>
#include <cmath>

#include "hierarchy_descent.hpp"

namespace dch::kinetic {
namespace {

/// Of half the smallest height of a box, what a list of all balls that touch may reach.
constexpr double kMostOfBox = 0.999;
/// A search is made for balls so many times as large as the largest ones, since they grow.
constexpr double kRoomToGrow = 1.5;

/// Descents rely on parents that cover where they are now, so no repair is put off.
HierarchyParams hierarchy_for(double radius) {
  HierarchyParams params;
  params.radius = radius;
  params.policy = MaintenancePolicy::always_repair;
  return params;
}

}  // namespace

/// Each search looks at all strays, and all points share the cost of a refresh: both come to O(sqrt(n)) a
/// stray. Fewer where there are few points, since new anchors of all cost as much as those of so many.
std::size_t AnchorSearch::most_strays() const {
  const std::size_t points = balls_.size();
  return std::min(static_cast<std::size_t>(4 * std::sqrt(static_cast<double>(points))), 8 + points / 32);
}

AnchorSearch::Octave& AnchorSearch::octave(int exponent) {
  const auto known = octaves_.find(exponent);
  if (known != octaves_.end()) return known->second;
  const double largest =
      std::clamp(std::ldexp(1, exponent + 1), kMinListRadius, std::min(kMaxListRadius, box_.max_cutoff()));
  return octaves_.emplace(exponent, Octave{{}, {}, {}, 0, Hierarchy(hierarchy_for(largest)), {}})
      .first->second;
}

/// A ball stays in its octave while its radius is not far outside: a hierarchy that has the same points is
/// repaired, another one built.
int AnchorSearch::keep_or_choose_octave(std::size_t id) {
  const double radius = balls_[id].radius;
  int& exponent = octave_of_[id];
  if (radius < std::ldexp(0.7, exponent) || radius > std::ldexp(2.8, exponent)) exponent = std::ilogb(radius);
  return exponent;
}

void AnchorSearch::set_all(const std::vector<Ball>& balls) {
  if (balls_.empty())
    for (const Ball& ball : balls) octave_of_.push_back(std::ilogb(ball.radius));
  balls_ = balls;
  is_stray_.resize(balls.size(), 0);
  refresh();
}

void AnchorSearch::set(std::int32_t id, const Ball& ball) {
  balls_[static_cast<std::size_t>(id)] = ball;
  if (!is_stray_[static_cast<std::size_t>(id)]) strays_.push_back(id);
  is_stray_[static_cast<std::size_t>(id)] = 1;
}

void AnchorSearch::refresh() {
  for (auto& [exponent, octave] : octaves_) {
    octave.ids.swap(octave.ids_before);
    octave.ids.clear();
    octave.centers.clear();
    octave.largest = 0;
  }
  for (std::size_t k = 0; k < balls_.size(); ++k) {
    Octave& of_ball = octave(keep_or_choose_octave(k));
    of_ball.ids.push_back(static_cast<std::int32_t>(k));
    of_ball.centers.push_back(balls_[k].center);
    of_ball.largest = std::max(of_ball.largest, balls_[k].radius);
  }
  for (auto octave = octaves_.begin(); octave != octaves_.end();) {
    if (octave->second.ids.empty()) {
      octave = octaves_.erase(octave);
      continue;
    }
    Octave& same = octave->second;
    if (same.ids == same.ids_before) {
      same.hierarchy.update(same.centers, box_);
    } else {
      same.hierarchy.build(same.centers, box_);
    }
    same.view = same.hierarchy.kept_view();
    ++octave;
  }
  for (const std::int32_t id : strays_) is_stray_[static_cast<std::size_t>(id)] = 0;
  strays_.clear();
}

double AnchorSearch::widest_to_list() const {
  return 0.5 * std::min(kMaxListRadius, kMostOfBox * box_.max_cutoff());
}

const NeighborList& AnchorSearch::find_all_touching() {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (const Ball& ball : balls_) {
    centers.push_back(ball.center);
    radii.push_back(ball.radius);
  }
  const double largest = std::max(kMinListRadius, 2 * *std::max_element(radii.begin(), radii.end()));
  if (largest > search_radius_) {
    HierarchyParams params;
    params.radius = std::min(kRoomToGrow * largest, 2 * widest_to_list());
    params.size_classes = true;
    search_ = make_dch_search(params);
    search_radius_ = params.radius;
  }
  search_->update(centers, box_);
  ListParams request;
  request.radii = radii;
  request.order = RowOrder::unsorted;
  search_->list(request, touching_);
  return touching_;
}

void AnchorSearch::find_touching(std::int32_t id, std::vector<std::int32_t>& touching) {
  near_.clear();
  const Ball& self = ball(id);
  const auto take = [&](std::int32_t other) {
    if (other != id) near_.push_back(other);
  };
  for (const auto& [exponent, octave] : octaves_) {
    const auto look_at = [&, &ids = octave.ids](std::int32_t k) {
      const std::int32_t other = ids[static_cast<std::size_t>(k)];
      if (!is_stray_[static_cast<std::size_t>(other)]) take(other);
    };
    for_each_near(*octave.view, self.center, self.radius + octave.largest, look_at);
  }
  std::for_each(strays_.begin(), strays_.end(), take);
  touching.resize(near_.size() + kMostLanes);
  touching.resize(
      kernels_.find_touching(balls_.data(), id, near_.data(), near_.size(), nearest_, touching.data()));
}

}  // namespace dch::kinetic
