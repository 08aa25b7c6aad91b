// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/lists/exclusions.hpp>
#include <dch/necklace/enclosing_ball.hpp>

#pragma GCC visibility push(default)
namespace dch::necklace {

/// A diagram of balls in open space whose edges join balls that are next to each other, such as the power
/// diagram (thesis 4.5.2). ClosestPair is handed one; the library itself has none, since the one of the
/// project stands on CGAL and its license.
class ProximityDiagram {
 public:
  virtual ~ProximityDiagram() = default;

  /// Takes the balls; what it has of their last places may be repaired. Any displacement, any number; the
  /// result is that of a new diagram.
  /// @throws InvalidPosition for a center that is not finite or beyond kMaxCoordinate.
  virtual void update(Span<const Ball> balls) = 0;

  /// Indices of balls that share an edge, each pair {a, b} with a < b once, ascending.
  ///
  /// What ClosestPair relies on: if all radii are equal, two balls share an edge whenever no third center,
  /// apart from those at the same places, lies in the closed ball whose diameter joins their centers. Of
  /// balls at one place one stands for all.
  virtual std::vector<IndexPair> edges() const = 0;

  /// Balls that are left out of edges(), since one with the same center and radius stands for them:
  /// {ball, the one that does}, ascending.
  virtual std::vector<IndexPair> coincident() const = 0;
  /// The name of before, for one version.
  [[deprecated("it is coincident() now")]] std::vector<IndexPair> doubles() const { return coincident(); }

  virtual std::string name() const = 0;  ///< "power diagram"
};

}  // namespace dch::necklace
#pragma GCC visibility pop
