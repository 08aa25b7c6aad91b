// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace dch::detail {

/// All points within a radius that have been seen.
class WithinCandidates {
 public:
  explicit WithinCandidates(double radius) : radius2_(radius * radius) {}

  void clear() { entries_.clear(); }
  void add(double distance2, std::int32_t id) {
    if (distance2 <= radius2_) entries_.emplace_back(distance2, id);
  }
  double limit2() const { return radius2_; }
  /// Nearest first, then by id.
  void append_to(std::vector<std::int32_t>& ids, std::vector<double>& distances2) {
    std::sort(entries_.begin(), entries_.end());
    for (const auto& [distance2, id] : entries_) {
      ids.push_back(id);
      distances2.push_back(distance2);
    }
  }

 private:
  double radius2_;
  std::vector<std::pair<double, std::int32_t>> entries_;
};

}  // namespace dch::detail
