// SPDX-License-Identifier: MIT
// Repair of the power diagram against building it anew.
#include <cmath>
#include <fmt/format.h>
#include <random>

#include <dch/necklace/walks.hpp>
#include <dch/power_diagram/power_diagram.hpp>

#include "parts.hpp"
#include "stopwatch.hpp"

namespace dch::bench {

namespace {

using necklace::Ball;
using necklace::PowerDiagram;

std::vector<Ball> balls_of(const necklace::Shape& shape) {
  std::vector<Ball> balls;
  for (const Vec3& center : shape.positions) balls.push_back({center, 0.5});
  return balls;
}

/// Every ball takes a random step, uniform along each axis with this root mean square.
void move(std::vector<Ball>& balls, double step, std::mt19937_64& engine) {
  for (Ball& ball : balls) {
    for (int axis = 0; axis < 3; ++axis) {
      const double uniform = 2 * static_cast<double>(engine() >> 11) * 0x1p-53 - 1;
      ball.center[axis] += step * std::sqrt(3.0) * uniform;
    }
  }
}

/// Repairs to the end, whatever share of the balls that takes out.
Row measure(const char* name, std::vector<Ball> balls, double step, int rounds) {
  necklace::PowerDiagramParams params;
  params.most_removed = 1;
  PowerDiagram kept(params), built;
  kept.update(balls);
  std::mt19937_64 engine(1);
  std::vector<double> ratios, build_us;
  const auto beads = static_cast<double>(balls.size());
  for (int round = 0; round < rounds; ++round) {
    move(balls, step, engine);
    const double repair = seconds_of([&] { kept.update(balls); });
    built = PowerDiagram();
    const double build = seconds_of([&] { built.update(balls); });
    require_same(kept.edges() == built.edges(), "edges of the diagrams repaired and built");
    ratios.push_back(repair / build);
    build_us.push_back(1e6 * build / beads);
  }
  const double removed = static_cast<double>(kept.stats().removed) / beads / rounds;
  const double edges = static_cast<double>(built.edges().size()) / beads;
  fmt::print("{:<10}{:>9}{:>10}{:>12.3f}{:>13.2f}%{:>13.2f}{:>12.3f}\n", name, balls.size(), step, edges,
             100 * removed, median_of(build_us), median_of(ratios));
  return {{"shape", name},
          {"beads", beads},
          {"step", step},
          {"edges_per_bead", edges},
          {"share_removed", removed},
          {"build_us_per_bead", median_of(build_us)},
          {"repair_to_build", median_of(ratios)}};
}

}  // namespace

Table measure_diagram(int beads, int rounds) {
  Table table;
  fmt::print("{:<10}{:>9}{:>10}{:>12}{:>14}{:>13}{:>12}\n", "shape", "beads", "step", "edges/bead", "removed",
             "build us", "ratio");
  const auto globule = balls_of(necklace::globule(beads, 0.3, 1));
  const auto swollen = balls_of(necklace::self_avoiding_walk(beads, 1, 1));
  for (const double step : {0.0, 1e-5, 1e-4, 3e-4, 1e-3, 0.012}) {
    table.push_back(measure("globule", globule, step, rounds));
    table.push_back(measure("swollen", swollen, step, rounds));
  }
  return table;
}

}  // namespace dch::bench
