// SPDX-License-Identifier: MIT
//
// Necklaces: degenerate enclosing balls, and the visited pairs that Theorem 4.5.1 counts.
#include <algorithm>
#include <cmath>

#include <dch/necklace/contacts.hpp>
#include <dch/necklace/layered_hierarchy.hpp>
#include <dch/necklace/shapes.hpp>
#include <dch/necklace/walks.hpp>
#include <dch/necklace/wrapped_hierarchy.hpp>

#include "ball_scenes.hpp"
#include "contact_oracle.hpp"
#include "hard_case.hpp"

namespace dch::hard {
namespace {

using namespace necklace;

constexpr double kRadius = 0.49;  // of beads one apart

Finding cube_corners() {
  std::string found;
  bool passed = true;
  for (const double side : {1e-6, 1.0, 1e6}) {
    std::vector<Ball> corners = scenes::hard_balls()[0].balls;
    for (Ball& corner : corners) corner.center = side * corner.center;
    const EnclosingBall ball = enclosing_ball(corners);
    const double ratio = ball.ball.radius / side, off = std::abs(ratio - std::sqrt(3.0) / 2);
    found += (found.empty() ? "R/a = " : ", ") + three_digits(ratio) +
             " (off by less than 1e-13: " + (off < 1e-13 ? "yes" : "no") + ")";
    passed = passed && off < 1e-13 && ball.basis.size >= 2 && ball.basis.size <= 4;
  }
  return {found, passed};
}

WrappedHierarchy wrapped_of(const Shape& shape, double radius) {
  WrappedHierarchy hierarchy(necklace_of(shape, radius), {1, Verification::cascade});
  hierarchy.build(shape.positions, Box::none());
  return hierarchy;
}

/// Lemma 4.4.3.
Finding tight_sets() {
  std::string found;
  bool passed = true;
  for (const std::int32_t k : {1, 2, 5, 9, 12}) {
    const Shape set = tight_set(k);
    LayeredHierarchy layered(necklace_of(set, 0), {1});
    layered.update(set.positions, Box::none());
    const double ratio = layered.cages()[0].radius / wrapped_of(set, 0).cages()[0].radius;
    passed = passed && std::abs(ratio - std::sqrt(double(k))) < 1e-9;
    found = three_digits(ratio) + " for k = " + std::to_string(k);
  }
  return {found, passed};
}

struct Visited {
  double beads = 0;
  std::int64_t pairs = 0;
  bool in_contact = false;
};

Visited visited(const Shape& shape, int skip_bonds) {
  ContactStats stats;
  const WrappedHierarchy hierarchy = wrapped_of(shape, kRadius);
  const bool in_contact = !find_contacts(hierarchy, {0, skip_bonds, true, true}, &stats).empty();
  return {static_cast<double>(shape.positions.size()), stats.cage_pairs, in_contact};
}

Finding lines(const Effort& effort) {
  std::string found;
  bool passed = true;
  for (std::int32_t n = 2; n <= effort.most_beads; n *= 4) {
    const Visited line = visited(grid_necklace(n, 1, 1), 0);
    passed = passed && line.pairs == n - 1 && !line.in_contact;
    found = std::to_string(line.pairs) + " for n = " + std::to_string(n);
  }
  return {found, passed};
}

/// Visited pairs over the law, for sides of the grid; each as stated, to the digits that it is stated with.
struct Growth {
  std::int32_t side;
  double expected, digits;
};

Finding grids(const Effort& effort, bool in_space, const std::vector<Growth>& growth) {
  Finding finding{"", true};
  for (const Growth& one : growth) {
    const Shape shape = grid_necklace(one.side, one.side, in_space ? one.side : 1);
    if (shape.positions.size() > static_cast<std::size_t>(effort.most_beads)) break;
    const Visited grid = visited(shape, 0);
    const double law = in_space ? std::pow(grid.beads, 4.0 / 3) : grid.beads * std::log2(grid.beads),
                 ratio = static_cast<double>(grid.pairs) / law;
    finding.passed = finding.passed && !grid.in_contact && std::abs(ratio - one.expected) <= one.digits;
    finding.found += (finding.found.empty() ? "" : ", ") + three_digits(ratio);
  }
  return finding;
}

double visited_per_bead(const Shape& shape) {
  const Visited found = visited(shape, 1);
  return static_cast<double>(found.pairs) / found.beads;
}

Finding helices() {
  const double ratio = visited_per_bead(helix(4096, 3.2, 0.3, 0.1));
  return {three_digits(ratio) + " for n = 4096", ratio > 10.3 && ratio < 12.5};
}

Finding walks() {
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) sum += visited_per_bead(random_walk(4096, seed));
  return {three_digits(sum / 8) + ", mean of 8 walks of n = 4096", sum / 8 > 20 && sum / 8 < 30};
}

Finding packed_globule() {
  const ContactQuery query{0.1, 1, true, true};
  Finding finding{"", true};
  for (const std::int32_t beads : {512, 4096}) {
    const Shape shape = globule(beads, 0.1, 1);
    ContactStats stats;
    const auto found = test::pairs_of(find_contacts(wrapped_of(shape, 0.5), query, &stats));
    const auto expected = test::contact_oracle(necklace_of(shape, 0.5), shape.positions, Box::none(), query);
    const double per_bead = static_cast<double>(stats.cage_pairs) / beads;
    finding.found += (finding.found.empty() ? "" : "; ") + std::to_string(found.size()) +
                     " contacts, by all pairs " + std::to_string(expected.size()) + ", " +
                     three_digits(per_bead) + " visited pairs a bead";
    finding.passed = finding.passed && found == expected && !found.empty() && per_bead > 10;
  }
  return finding;
}

Finding knots() {
  std::string found;
  bool passed = true;
  for (const auto& [p, q, beads] : {std::array{2, 3, 120}, {2, 5, 200}, {2, 7, 300}, {3, 4, 300}}) {
    const bool contact = any_contact(wrapped_of(torus_knot(p, q, beads), kRadius), {0, 1, true, true});
    found += (found.empty() ? "T(" : ", T(") + std::to_string(p) + "," + std::to_string(q) + ") " +
             (contact ? "contact" : "none");
    passed = passed && !contact;
  }
  return {found, passed};
}

}  // namespace

std::vector<Case> necklace_cases(const Effort& effort) {
  const std::string area = "necklaces";
  return {
      {area, "8 cube corners, all on one sphere", "R = sqrt(3)/2 a = 0.866 a on any minimal support",
       cube_corners},
      {area, "the tight set of Lemma 4.4.3, up to k = 12", "layered/wrapped = sqrt(k): 3.46 for 12",
       tight_sets},
      {area, "collinear beads, r = 0.49", "n - 1 visited pairs", [effort] { return lines(effort); }},
      {area, "grid in the plane, n = 16, 256, 4,096, 65,536", "visited/(n lg n) from 1.39 to 2.03",
       [effort] {
         return grids(effort, false,
                      {{4, 1.39, 0.005}, {16, 1.72, 0.005}, {64, 1.91, 0.005}, {256, 2.03, 0.005}});
       }},
      {area, "grid in space, n = 64, 512, 4,096, 32,768", "visited/n^(4/3): 4.7, 6.1, 7.1, 7.6",
       [effort] {
         return grids(effort, true, {{4, 4.7, 0.05}, {8, 6.1, 0.05}, {16, 7.1, 0.05}, {32, 7.6, 0.05}});
       }},
      {area, "helix of radius 3.2, 0.3 rad and a rise of 0.1 a bead", "about 11.4 visited pairs a bead",
       helices},
      {area, "random walks", "about 25 visited pairs a bead", walks},
      {area, "packed globules of 512 and 4,096 beads", "contacts of all pairs; visited pairs >> n",
       packed_globule},
      {area, "trefoil and torus knots", "no contact", knots},
  };
}

}  // namespace dch::hard
