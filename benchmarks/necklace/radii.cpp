// SPDX-License-Identifier: MIT
// Layered against wrapped cages.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include <dch/base/error.hpp>
#include <dch/necklace/layered_hierarchy.hpp>
#include <dch/necklace/walks.hpp>
#include <dch/necklace/wrapped_hierarchy.hpp>
#include <dch/trajectory/reader.hpp>

#include "parts.hpp"

namespace dch::bench {

namespace {

using necklace::Necklace;
using necklace::Shape;

/// Chains at rest.
struct Scene {
  std::string name;
  Necklace necklace;
  std::vector<Vec3> positions;
  Box box;
};

Scene scene_of(const std::string& name, const Shape& shape, double radius) {
  return {name, necklace_of(shape, radius), shape.positions, Box::none()};
}

Scene first_frame(const std::string& path, int chain_beads) {
  trajectory::Frame frame;
  if (!trajectory::open_trajectory(path)->read(frame)) throw Error(path + " has no frame");
  const std::size_t beads = frame.positions.size(), length = static_cast<std::size_t>(chain_beads);
  if (beads == 0 || beads % length != 0) {
    throw Error(path + " has " + std::to_string(beads) + " beads, which are not whole chains of " +
                std::to_string(chain_beads) + "; give --chain-beads");
  }
  necklace::Chains chains(beads);
  std::vector<std::int32_t> chain(length);
  for (std::size_t first = 0; first < beads; first += length) {
    for (std::size_t k = 0; k < length; ++k) chain[k] = static_cast<std::int32_t>(first + k);
    chains.add(chain);
  }
  return {"trajectory", Necklace(chains, 0.5), frame.positions, frame.box};
}

/// Ratios of radii over all cages of two beads and more.
Row measure(const Scene& scene) {
  necklace::WrappedHierarchy wrapped(scene.necklace, {1, necklace::Verification::cascade});
  necklace::LayeredHierarchy layered(scene.necklace, {1});
  wrapped.build(scene.positions, scene.box);
  layered.update(scene.positions, scene.box);
  double sum = 0, cages = 0, roots = 0, largest = 0;
  for (std::size_t k = 0; k < wrapped.cages().size(); ++k) {
    if (wrapped.trees().nodes()[k].count < 2) continue;
    const double ratio = layered.cages()[k].radius / wrapped.cages()[k].radius;
    require_same(ratio >= 1 - 1e-10, "wrapped cages and the least ones");
    largest = std::max(largest, ratio);
    sum += ratio;
    ++cages;
  }
  for (const std::int32_t root : wrapped.trees().roots()) {
    const auto k = static_cast<std::size_t>(root);
    roots += layered.cages()[k].radius / wrapped.cages()[k].radius;
  }
  roots /= static_cast<double>(wrapped.trees().roots().size());
  const auto beads = static_cast<double>(scene.necklace.chains().beads(0).size());
  const double bound = std::sqrt(std::floor(std::log2(beads)));
  fmt::print("{:<20}{:>9}{:>11.4f}{:>11.4f}{:>11.4f}{:>18.4f}\n", scene.name, scene.positions.size(), roots,
             sum / cages, largest, bound);
  return {{"shape", scene.name}, {"beads", static_cast<double>(scene.positions.size())},
          {"root", roots},       {"mean", sum / cages},
          {"largest", largest},  {"sqrt_floor_lg_n", bound}};
}

}  // namespace

Table measure_radii(std::int64_t most_beads, const std::string& trajectory, int chain_beads) {
  Table table;
  fmt::print("{:<20}{:>9}{:>11}{:>11}{:>11}{:>18}\n", "shape", "beads", "roots", "mean", "largest",
             "sqrt(floor lg n)");
  for (std::int32_t k = 1; std::int64_t{1} << k <= most_beads; ++k)
    table.push_back(measure(scene_of("tight set", necklace::tight_set(k), 0)));
  const auto n = static_cast<std::int32_t>(most_beads);
  table.push_back(measure(scene_of("self-avoiding walk", necklace::self_avoiding_walk(n, 1, 1), 0.49)));
  table.push_back(measure(scene_of("random walk", necklace::random_walk(n, 1), 0.49)));
  table.push_back(measure(scene_of("helix", necklace::helix(n, 3.2, 0.3, 0.06), 0.49)));
  table.push_back(measure(scene_of("globule", necklace::globule(n, 0.1, 1), 0.38)));
  if (!trajectory.empty()) table.push_back(measure(first_frame(trajectory, chain_beads)));
  return table;
}

}  // namespace dch::bench
