// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>

#include "crossing/sweep_bounds.hpp"
#include "grid/grid_search.hpp"

namespace dch::necklace::detail {

/// Pairs of balls whose centers may be near enough for the balls to meet, from a search with one reach for
/// all. That reach is twice the largest radius, or less if a few balls are much larger than the others: these
/// are `wide`, and no search is for them.
class NearMidpoints {
 public:
  explicit NearMidpoints(Executor* executor) : executor_(executor) {}

  /// Balls of a negative radius are left out.
  /// @param centers have to stay as they are until all near pairs have been found: there is no copy of them
  /// @throws InvalidPosition
  void update(Span<const Vec3> centers, Span<const SweepBounds> bounds, const Box& box);

  /// Calls use() with pieces of the near pairs, on the executor's threads. Those of pairs with a wide ball
  /// mean nothing.
  void for_each_piece(const std::function<void(const NeighborList&)>& use);

  /// No ball that is searched for is larger.
  float largest() const { return largest_; }
  const std::vector<std::int32_t>& wide() const { return wide_; }

  std::size_t memory_bytes() const;

 private:
  void choose_reach(Span<const SweepBounds> bounds, const Box& box);

  Executor* executor_;
  std::optional<dch::detail::GridSearch> search_;
  double search_radius_ = 0, reach_ = 0;
  float largest_ = 0;
  std::vector<std::int32_t> wide_;
};

}  // namespace dch::necklace::detail
