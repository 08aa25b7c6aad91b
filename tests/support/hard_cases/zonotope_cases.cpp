// SPDX-License-Identifier: MIT
//
// Zonotopes that the thesis excludes, and such that come as close as doubles tell.
#include <cmath>

#include <dch/zonotope/membership.hpp>
#include <dch/zonotope/space_time.hpp>
#include <dch/zonotope/zonotope.hpp>

#include "hard_case.hpp"

namespace dch::hard {
namespace {

using namespace zonotope;

/// A truncated octahedron from 6 generators, some cut in pieces, and zero ones among them.
Finding merged_generators() {
  Zonotope pieces;
  for (const Vec3 v : {Vec3{1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1}, {0, 1, 1}, {0, 1, -1}})
    for (const double part : {0.125, 0.0, -0.375}) pieces.generators.push_back(part * v);
  const Zonotope merged = canonical(pieces);
  const bool same =
      volume(pieces) == 32 && volume(merged) == 32 && encloses(merged, pieces) && encloses(pieces, merged);
  bool apart = false;
  for (const Vec3 touching : {Vec3{2, 1, 0}, {1.5, 1.5, 0}, {1, 1, 1}, {2, 0, 0}})
    apart = apart || !contains(pieces, touching) || contains(pieces, 1.0000001 * touching);
  return {std::to_string(merged.generators.size()) + " generators of 18, " +
              (same ? "the same zonotope of volume 32" : "another zonotope") + ", " +
              (apart ? "a false answer" : "no false answer"),
          merged.generators.size() == 6 && same && !apart};
}

Finding boxes_at_a_gap() {
  std::string found;
  bool passed = true;
  for (const double gap : {1e-12, 0x1p-52, 0.0, -0x1p-52, -1e-12}) {
    const Zonotope left{{0, 0, 0}, {{0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}}};
    Zonotope right = left;
    right.center = {1 + gap, 0.3, -0.2};
    const bool meet = intersect(left, right);
    passed = passed && meet == (gap <= 0);
    found += (found.empty() ? "" : ", ") + std::string(meet ? "intersect" : "apart");
  }
  return {found, passed};
}

/// The corner of a turning cube comes to a wall and no farther.
Finding grazing() {
  const Zonotope cube{{}, {{0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}}};
  const Zonotope wall{{std::sqrt(0.5) + 1, 0, 0}, {{1, 0, 0}, {0, 3, 0}, {0, 0, 3}}};
  const FirstMeeting meeting = first_meeting(cube, {{}, {}, {0, 0, 1}, std::acos(0.0)}, wall, {}, 1e-6);
  const bool in_doubt = meeting.outcome != Meeting::none && std::abs(meeting.to - 0.5) < 0.01;
  return {in_doubt ? "in doubt near the middle of the step, after less than 100,000 intervals" : "lost",
          in_doubt && meeting.intervals < 100000};
}

}  // namespace

std::vector<Case> zonotope_cases() {
  return {{"zonotopes", "parallel, zero and coplanar generators", "the same volume, no false answer",
           merged_generators},
          {"zonotopes", "boxes at a gap of 1e-12, 2^-52, 0, -2^-52, -1e-12",
           "apart, apart, and three that intersect", boxes_at_a_gap},
          {"zonotopes", "a turning cube that grazes a wall", "the bisection of the step ends", grazing}};
}

}  // namespace dch::hard
