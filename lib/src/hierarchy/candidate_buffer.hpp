// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <dch/base/vec3.hpp>

namespace dch::detail {

/// Points to be tested against others: one array a coordinate for the vector units, and no branch that
/// depends on a distance, since about half of the candidates pass and a mispredicted branch costs more than
/// the test.
class CandidateBuffer {
 public:
  void clear() { size_ = 0; }
  std::size_t size() const { return size_; }
  std::int32_t node(std::size_t k) const { return node_[k]; }
  Vec3 position(std::size_t k) const { return {data_[k], data_[k + capacity_], data_[k + 2 * capacity_]}; }

  void append_if(bool keep, Vec3 p, std::int32_t node) {
    if (size_ == capacity_) grow();
    double* at = data_.data() + size_;
    at[0] = p.x;
    at[capacity_] = p.y;
    at[2 * capacity_] = p.z;
    node_[size_] = node;
    size_ += keep;
  }

  /// Appends those of `count` points, moved by `shift`, that `distance2(point)` puts within sqrt(limit2).
  template <class Distance2>
  void append_within(const Vec3* points, const std::int32_t* nodes, std::size_t count, Vec3 shift,
                     const Distance2& distance2, double limit2) {
    while (size_ + count > capacity_) grow();
    double *x = data_.data(), *y = x + capacity_, *z = y + capacity_;
    std::int32_t* node = node_.data();
    std::size_t n = size_;
    for (std::size_t k = 0; k < count; ++k) {
      const Vec3 at = shift + points[k];
      x[n] = at.x;
      y[n] = at.y;
      z[n] = at.z;
      node[n] = nodes[k];
      n += distance2(at) <= limit2;
    }
    size_ = n;
  }

  /// Finds the entries from `first` on within sqrt(limit2) of p. Returns how many; hit(h) and
  /// distance2(hit(h)) tell which and how far.
  template <class Metric>
  std::size_t select(const Metric& metric, Vec3 p, std::size_t first, double limit2) {
    const double *x = data_.data(), *y = x + capacity_, *z = y + capacity_;
    double* d2 = distance2_.data();
    std::int32_t* hit = hit_.data();
    for (std::size_t k = first; k < size_; ++k) d2[k] = metric.distance2(p, Vec3{x[k], y[k], z[k]});
    std::size_t hits = 0;
    for (std::size_t k = first; k < size_; ++k) {
      hit[hits] = static_cast<std::int32_t>(k);
      hits += d2[k] <= limit2;
    }
    return hits;
  }
  /// Holds the first `hits` entries that the last select() of another buffer found.
  void assign_selected(const CandidateBuffer& other, std::size_t hits) {
    while (hits > capacity_) grow();
    const double* from = other.data_.data();
    double* to = data_.data();
    for (std::size_t h = 0; h < hits; ++h) {
      const std::size_t k = other.hit(h);
      for (std::size_t axis = 0; axis < 3; ++axis)
        to[axis * capacity_ + h] = from[axis * other.capacity_ + k];
      node_[h] = other.node_[k];
    }
    size_ = hits;
  }

  std::size_t hit(std::size_t h) const { return static_cast<std::size_t>(hit_[h]); }
  double distance2(std::size_t k) const { return distance2_[k]; }

 private:
  /// All arrays are as wide before capacity_ says so, since memory may run out at any of them.
  void grow() {
    const std::size_t wider = 2 * capacity_ + 64;
    std::vector<double> data(3 * wider);
    distance2_.resize(wider);
    node_.resize(wider);
    hit_.resize(wider);
    for (std::size_t axis = 0; axis < 3; ++axis)
      std::copy_n(data_.data() + axis * capacity_, size_, data.data() + axis * wider);
    data_.swap(data);
    capacity_ = wider;
  }

  std::size_t size_ = 0, capacity_ = 0;
  std::vector<double> data_;  ///< x of all, then y, then z
  std::vector<double> distance2_;
  std::vector<std::int32_t> node_, hit_;
};

}  // namespace dch::detail
