// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <dch/necklace/wrapped_hierarchy.hpp>

namespace dch::test {

inline bool encloses(const necklace::Ball& cage, const necklace::Ball& bead) {
  return std::sqrt(norm2(bead.center - cage.center)) + bead.radius <= cage.radius * (1 + 1e-11);
}

/// The first cage that lets out a bead of its node. Empty if there is none.
inline std::string leaking_cage(const necklace::CageHierarchy& hierarchy) {
  for (std::size_t k = 0; k < hierarchy.trees().nodes().size(); ++k) {
    const auto& node = hierarchy.trees().nodes()[k];
    for (std::int32_t place = node.first; place < node.first + node.count; ++place) {
      if (!encloses(hierarchy.cages()[k], hierarchy.beads()[static_cast<std::size_t>(place)])) {
        return "cage " + std::to_string(k) + " lets out the bead at place " + std::to_string(place);
      }
    }
  }
  return {};
}

/// What is wrong with a wrapped hierarchy: a cage that lets a bead out, one that is not the least, or a basis
/// that is not its own. Empty if nothing is.
inline std::string fault(const necklace::WrappedHierarchy& hierarchy, double tolerance = 1e-10) {
  if (const std::string leak = leaking_cage(hierarchy); !leak.empty()) return leak;
  for (std::size_t k = 0; k < hierarchy.trees().nodes().size(); ++k) {
    const auto& node = hierarchy.trees().nodes()[k];
    const double radius = hierarchy.cages()[k].radius;
    const auto first = static_cast<std::size_t>(node.first), count = static_cast<std::size_t>(node.count);
    const double least = necklace::enclosing_ball({hierarchy.beads().data() + first, count}).ball.radius;
    const std::string cage = "cage " + std::to_string(k);
    if (std::abs(radius - least) > tolerance * least) {
      return cage + " has the radius " + std::to_string(radius) + ", the least is " + std::to_string(least);
    }
    std::vector<necklace::Ball> basis;
    for (const std::int32_t place : hierarchy.bases()[k].indices()) {
      if (place < node.first || place >= node.first + node.count) return cage + " rests on a bead of another";
      basis.push_back(hierarchy.beads()[static_cast<std::size_t>(place)]);
    }
    if (std::abs(necklace::enclosing_ball(basis).ball.radius - least) > tolerance * least) {
      return cage + " does not rest on its basis";
    }
  }
  return {};
}

}  // namespace dch::test
