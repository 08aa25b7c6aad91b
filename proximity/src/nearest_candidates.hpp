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
    if (!is_full()) entries_.push_back(entry);
    // From the end: most come in the order of their distances.
    std::size_t place = entries_.size() - 1;
    for (; place > 0 && entry < entries_[place - 1]; --place) entries_[place] = entries_[place - 1];
    entries_[place] = entry;
  }
  bool is_full() const { return entries_.size() == k_; }
  /// What a point's squared distance may be at most for it to be taken.
  double limit2() const {
    return is_full() ? entries_.back().distance2 : std::numeric_limits<double>::infinity();
  }
  void write(std::int32_t* id, double* distance2) const {
    for (std::size_t j = 0; j < entries_.size(); ++j) {
      id[j] = entries_[j].id;
      distance2[j] = entries_[j].distance2;
    }
    std::fill(id + entries_.size(), id + k_, -1);
    std::fill(distance2 + entries_.size(), distance2 + k_, std::numeric_limits<double>::infinity());
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
