// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <dch/necklace/proximity_diagram.hpp>

namespace dch::necklace {

/// What updates of a power diagram did.
struct PowerDiagramStats {
  std::int64_t updates = 0;
  std::int64_t builds = 0;   ///< diagrams made from nothing, the first one too
  std::int64_t repairs = 0;  ///< updates that kept what stayed right
  std::int64_t removed = 0;  ///< balls taken out and put in again by repairs
  std::int64_t hidden = 0;   ///< balls without a cell now
};

struct PowerDiagramParams {
  /// A repair that would take out more than this share of the balls becomes a build, 0 .. 1. The default is
  /// from measurements (docs/necklaces.md): of 10,000 balls it costs about as much as building.
  double most_removed = 0.005;
};

/// The power diagram of balls, as its dual: a regular triangulation with the squares of the radii as weights
/// (CGAL's Regular_triangulation_3). Predicates are exact, so degenerate places are no special case.
///
/// An update under motion (thesis 4.5.2, after Guibas and Russel, "An empirical comparison of techniques for
/// updating Delaunay triangulations", SCG 2004): the new centers are put into the old triangulation. Where a
/// tetrahedron is turned over, or a facet is no longer locally regular, vertices are chosen, taken out of the
/// old triangulation and put in at their new places, until the rest is right: positively oriented and
/// locally regular on all facets, which is a regular triangulation. In fewer than three dimensions it is
/// built anew.
///
/// Cost: O(n) for each test; removing a ball costs many times as much as putting one in, so repair pays for
/// small steps only (docs/necklaces.md). Building is O(n lg n) where the diagram
/// is of linear size. Whoever links this has to keep to the GPL, version 3 or later, of CGAL's
/// triangulations.
class PowerDiagram : public ProximityDiagram {
 public:
  /// @throws InvalidParameter unless 0 <= most_removed <= 1.
  explicit PowerDiagram(const PowerDiagramParams& params = {});
  ~PowerDiagram() override;
  PowerDiagram(PowerDiagram&&) noexcept;
  PowerDiagram& operator=(PowerDiagram&&) noexcept;

  void update(Span<const Ball> balls) override;
  std::vector<IndexPair> edges() const override;
  std::vector<IndexPair> coincident() const override;
  std::string name() const override { return "power diagram"; }

  const PowerDiagramStats& stats() const;
  /// Whether the triangulation is a regular one, as CGAL sees it; O(n), for tests.
  bool is_valid() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dch::necklace
