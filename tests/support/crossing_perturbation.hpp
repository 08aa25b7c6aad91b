// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "crossing_oracle.hpp"

/// The rule for motions that are not generic, as the library states it, with a number for its infinitesimal.
namespace dch::crossing_oracle {

/// Of the perturbation: each bead stands at x + eps w at all times. An eps of 2^-kEpsilonBits of a unit of
/// coordinates is infinitesimal for coordinates that are short: multiples of 2^-30 below 2^10.
inline constexpr unsigned kEpsilonBits = 704;

/// The direction w of a bead as the library's comment says it: hashed by the finalizer of SplitMix64.
inline Int direction(std::uint64_t bead, std::uint64_t axis) {
  const auto mix = [](std::uint64_t x) {
    x += 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31);
  };
  return static_cast<std::int64_t>(mix(mix(bead) ^ axis)) / 2;
}

/// The motion of the perturbed beads, which is generic whatever the motion is.
inline WholeMotion perturbed(WholeMotion motion, const std::array<std::uint64_t, 4>& beads) {
  // Units of 2^-kUnitBits have no use for their last digits here.
  constexpr unsigned kUnused = kUnitBits - 30;
  for (auto* const ends : {&motion.from, &motion.to}) {
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        Int& x = (*ends)[k][axis];
        x = ((x >> kUnused) << (kEpsilonBits + 62)) + direction(beads[k], axis);
      }
    }
  }
  return motion;
}

/// Those within 2^-50 of each other are as many as their signs add up to.
inline std::vector<Event> without_cancelling(const std::vector<Event>& events) {
  std::vector<Event> result;
  for (std::size_t k = 0; k < events.size();) {
    const std::size_t first = k;
    int sum = 0;
    for (; k < events.size() && events[k].time - events[first].time <= 0x1p-50; ++k) sum += events[k].sign;
    for (int n = 0; n < std::abs(sum); ++n) result.push_back({events[first].time, sum > 0 ? 1 : -1});
  }
  return result;
}

}  // namespace dch::crossing_oracle
