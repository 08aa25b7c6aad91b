// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace dch::detail {

/// The k nearest points that have been seen, by squared distance, then by id.
class NearestCandidates {
 public:
  void clear(std::int32_t k) {
    k_ = static_cast<std::size_t>(k);
    entries_.clear();
  }
  void add(double distance2, std::int32_t id) {
    const Entry entry{distance2, id};
    if (is_full() && !(entry < entries_.back())) return;
    if (is_full()) entries_.pop_back();
    entries_.insert(std::upper_bound(entries_.begin(), entries_.end(), entry), entry);
  }
  bool is_full() const { return entries_.size() == k_; }
  /// What a point's squared distance may be at most for it to be taken.
  double limit2() const {
    return is_full() ? entries_.back().distance2 : std::numeric_limits<double>::infinity();
  }
  void write(std::int32_t* id, double* distance2) const {
    for (std::size_t j = 0; j < k_; ++j) {
      id[j] = j < entries_.size() ? entries_[j].id : -1;
      distance2[j] = j < entries_.size() ? entries_[j].distance2 : std::numeric_limits<double>::infinity();
    }
  }

 private:
  struct Entry {
    double distance2;
    std::int32_t id;
    bool operator<(const Entry& other) const {
      return distance2 != other.distance2 ? distance2 < other.distance2 : id < other.id;
    }
  };
  std::size_t k_ = 0;
  std::vector<Entry> entries_;
};

}  // namespace dch::detail
