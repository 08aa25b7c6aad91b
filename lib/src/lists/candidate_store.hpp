// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/aligned_vector.hpp"
#include "simd/list_kernels.hpp"

namespace dch::detail {

/// Memory for candidates.
class CandidateStore {
 public:
  Candidates at(std::int32_t k) {
    return {x_.data() + k, y_.data() + k, z_.data() + k, id_.data() + k, tag_.data() + k};
  }
  /// Room for that many at least. What there is stays.
  void make_room(std::size_t count) {
    if (id_.size() >= count) return;
    count += count / 8;
    for (auto* axis : {&x_, &y_, &z_, &tag_}) {
      axis->reserve(count);  // else it might take twice as much
      axis->resize(count);
    }
    id_.reserve(count);
    id_.resize(count);
  }
  std::size_t size() const { return id_.size(); }
  std::size_t memory_bytes() const {
    return 4 * x_.capacity() * sizeof(x_[0]) + id_.capacity() * sizeof(id_[0]);
  }

 private:
  AlignedVector<std::int16_t> x_, y_, z_, tag_;
  AlignedVector<std::int32_t> id_;  ///< grows last: the others have room for as many at least
};

}  // namespace dch::detail
