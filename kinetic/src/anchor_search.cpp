// SPDX-License-Identifier: MIT
#include "anchor_search.hpp"

#include <algorithm>
#include <cmath>

#include "hierarchy_descent.hpp"

namespace dch::kinetic {
namespace {

/// Each search looks at all strays, and all points share the cost of a refresh: both come to O(sqrt(n)) a
/// stray.
std::size_t most_strays(std::size_t points) {
  return static_cast<std::size_t>(8 * std::sqrt(static_cast<double>(points)));
}

/// Descents rely on parents that cover where they are now, so no repair is put off.
HierarchyParams hierarchy_for(double radius) {
  HierarchyParams params;
  params.radius = radius;
  params.policy = MaintenancePolicy::always_repair;
  return params;
}

}  // namespace

AnchorSearch::Octave& AnchorSearch::octave_of(double radius) {
  const int octave = std::ilogb(radius);
  const auto known = octaves_.find(octave);
  if (known != octaves_.end()) return known->second;
  const double largest =
      std::clamp(std::ldexp(1, octave + 1), kMinListRadius, std::min(kMaxListRadius, box_.max_cutoff()));
  return octaves_.emplace(octave, Octave{{}, {}, {}, 0, Hierarchy(hierarchy_for(largest)), {}}).first->second;
}

void AnchorSearch::set_all(const std::vector<Ball>& balls) {
  balls_ = balls;
  is_stray_.assign(balls.size(), 0);
  strays_.reserve(most_strays(balls.size()) + 1);
  refresh();
}

void AnchorSearch::set(std::int32_t id, const Ball& ball) {
  balls_[static_cast<std::size_t>(id)] = ball;
  if (!is_stray_[static_cast<std::size_t>(id)]) strays_.push_back(id);
  is_stray_[static_cast<std::size_t>(id)] = 1;
  if (strays_.size() > most_strays(balls_.size())) refresh();
}

void AnchorSearch::refresh() {
  for (auto& [exponent, octave] : octaves_) {
    octave.ids.swap(octave.ids_before);
    octave.ids.clear();
    octave.centers.clear();
    octave.largest = 0;
  }
  for (std::size_t k = 0; k < balls_.size(); ++k) {
    Octave& octave = octave_of(balls_[k].radius);
    octave.ids.push_back(static_cast<std::int32_t>(k));
    octave.centers.push_back(balls_[k].center);
    octave.largest = std::max(octave.largest, balls_[k].radius);
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

void AnchorSearch::find_touching(std::int32_t id, std::vector<std::int32_t>& touching) const {
  touching.clear();
  const Ball& self = ball(id);
  for (const auto& [exponent, octave] : octaves_) {
    const auto look_at = [&, &ids = octave.ids](std::int32_t k) {
      const std::int32_t other = ids[static_cast<std::size_t>(k)];
      if (other != id && !is_stray_[static_cast<std::size_t>(other)] && touch(id, other))
        touching.push_back(other);
    };
    for_each_near(*octave.view, self.center, self.radius + octave.largest, look_at);
  }
  for (const std::int32_t other : strays_)
    if (other != id && touch(id, other)) touching.push_back(other);
}

}  // namespace dch::kinetic
