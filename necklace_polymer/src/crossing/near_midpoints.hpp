// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/base/span.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/geometry/box.hpp>

namespace dch::necklace::detail {

/// Pairs of balls whose centers may be near enough for the balls to meet, from a search with one reach for
/// all. That reach is twice the largest radius, or less if a few balls are much larger than the others: these
/// are `wide`, and no search is for them.
class NearMidpoints {
 public:
  explicit NearMidpoints(Executor* executor) : executor_(executor) {}

  /// Balls of a negative radius are left out.
  /// @throws InvalidPosition
  void update(Span<const Vec3> centers, Span<const float> radii, const Box& box);

  /// How many rows there are; row k has its owner and its near partners. Those of pairs with a wide ball mean
  /// nothing.
  std::size_t rows() const { return list_.size(); }
  std::int32_t owner(std::size_t row) const {
    return list_.particle.empty() ? static_cast<std::int32_t>(row) : list_.particle[row];
  }
  Span<const std::int32_t> partners(std::size_t row) const { return list_.row(row); }

  bool is_wide(float radius) const { return radius > largest_; }
  const std::vector<std::int32_t>& wide() const { return wide_; }

  std::size_t memory_bytes() const;

 private:
  void choose_reach(Span<const float> radii, const Box& box);

  Executor* executor_;
  std::unique_ptr<PairSearch> search_;
  double search_radius_ = 0;
  float largest_ = 0;  ///< no ball that is searched for is larger
  std::vector<std::int32_t> wide_;
  NeighborList list_;
};

}  // namespace dch::necklace::detail
