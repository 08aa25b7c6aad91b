// SPDX-License-Identifier: MIT
//
// The power diagram of a packed chain.
#include <dch/necklace/shapes.hpp>
#include <dch/necklace/walks.hpp>
#include <dch/power_diagram/power_diagram.hpp>

#include "hard_case.hpp"

namespace dch::hard {
namespace {

double edges_per_bead(const necklace::Shape& shape, bool& valid) {
  std::vector<necklace::Ball> balls;
  for (const Vec3 p : shape.positions) balls.push_back({p, 0.5});
  necklace::PowerDiagram diagram;
  diagram.update(balls);
  valid = valid && diagram.is_valid();
  return static_cast<double>(diagram.edges().size()) / static_cast<double>(balls.size());
}

Finding globules() {
  Finding finding{"", true};
  for (const std::int32_t beads : {512, 4096}) {
    const double edges = edges_per_bead(necklace::globule(beads, 0.1, 1), finding.passed);
    finding.found += (finding.found.empty() ? "" : " and ") + three_digits(edges);
    finding.passed = finding.passed && edges < 9;
  }
  finding.found += " edges a bead";
  return finding;
}

/// A cube's corners lie on one sphere: any triangulation of them will do.
Finding cube_corners() {
  Finding finding{"", true};
  const double edges = edges_per_bead(necklace::grid_necklace(6, 6, 6), finding.passed);
  finding.found =
      std::string(finding.passed ? "regular, " : "not regular, ") + three_digits(edges) + " edges a bead";
  return finding;
}

}  // namespace

std::vector<Case> diagram_cases() {
  return {
      {"power diagram", "packed globule of 512 and 4,096 beads", "edges O(n): fewer than 9 a bead", globules},
      {"power diagram", "grid, whose neighbors lie on spheres by eights", "a regular triangulation",
       cube_corners}};
}

}  // namespace dch::hard
