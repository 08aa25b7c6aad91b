// SPDX-License-Identifier: MIT
#include "crossing/encounter.hpp"

#include <string>

#include <dch/base/error.hpp>
#include <dch/geometry/box.hpp>
#include <dch/geometry/separating_axes.hpp>

#include "crossing/cubic_passages.hpp"
#include "crossing/exact_crossings.hpp"
#include "crossing/segment_distance.hpp"

namespace dch::necklace {
namespace detail {
namespace {

/// Of the bonds' size: how much farther apart bonds count as within a distance.
constexpr double kContactTolerance = 1e-6;
/// A grazing approach takes some 1 / sqrt(kContactTolerance) steps; more than this is none that ends.
constexpr int kMaxAdvances = 100000;

void take_passage(const PairMotion& motion, const Passage& passage, BondEncounter& out) {
  const double t = passage.time;
  const Vec3 a = motion.origin_p[0] + t * motion.p[0], b = motion.origin_p[1] + t * motion.p[1];
  out.crossings[static_cast<std::size_t>(out.count++)] = {
      t, passage.on_p, passage.on_q, (1 - passage.on_p) * a + passage.on_p * b, -passage.sign};
}

}  // namespace

bool is_apart_by_box(const BondSweep& p, const BondSweep& q, Vec3 between, double margin) {
  for (int axis = 0; axis < 3; ++axis) {
    const double reach = std::abs(p.along[axis]) + std::abs(q.along[axis]) +
                         std::abs(p.motion[axis] - q.motion[axis]) + std::abs(p.twist[axis]) +
                         std::abs(q.twist[axis]) + margin;
    if (std::abs(between[axis]) > reach * (1 + 1e-12)) return true;
  }
  return false;
}

bool is_apart_by_zonotope(const BondSweep& p, const BondSweep& q, Vec3 between, double margin) {
  const std::array<Vec3, 5> generators{p.along, q.along, p.motion - q.motion, p.twist, q.twist};
  return zonotope_is_apart(between, {generators.data(), generators.size()}, margin);
}

bool crossings_by_cubic(const PairMotion& motion, BondEncounter& out) {
  const CubicPassages found = cubic_passages(motion);
  if (!found.certain) return false;
  out.decided_by = EncounterStage::cubic;
  for (int k = 0; k < found.count; ++k)
    take_passage(motion, found.passages[static_cast<std::size_t>(k)], out);
  return true;
}

bool crossings_by_integers(const PairMotion& motion, const PairEnds& ends, BondEncounter& out) {
  const ExactPassages found = exact_passages(ends);
  out.decided_by = EncounterStage::exact;
  for (const Passage& passage : found.passages) take_passage(motion, passage, out);
  return found.degenerate;
}

void note_contact(const PairMotion& motion, double distance, BondEncounter& out) {
  const double tolerance = kContactTolerance * (motion.size + distance) + 2 * motion.error;
  const double speed = motion.largest_speed();
  double t = 0;
  for (int advance = 0; advance < kMaxAdvances; ++advance) {
    const double apart =
        std::sqrt(closest_on_segments(PairMotion::at(motion.bond_p, t), PairMotion::at(motion.bond_q, t),
                                      PairMotion::at(motion.between, t))
                      .distance2);
    out.contact_time = t;
    out.contact_distance = apart;
    out.contact = apart <= distance + tolerance;
    if (out.contact || t == 1) break;
    t = (apart - distance) < speed * (1 - t) ? t + (apart - distance) / speed : 1;
  }
  if (!out.contact) out.contact_time = out.contact_distance = 0;
}

}  // namespace detail

BondEncounter bond_encounter(const MovingBond& p, const MovingBond& q, double thickness,
                             const std::array<std::uint64_t, 4>& beads) {
  if (!(thickness >= 0) || !std::isfinite(thickness)) {
    throw InvalidParameter("the thickness is " + std::to_string(thickness) +
                           "; it has to be finite and at least 0");
  }
  double magnitude = 0;
  for (const Vec3 end : {p.from_a, p.from_b, p.to_a, p.to_b, q.from_a, q.from_b, q.to_a, q.to_b}) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!(std::abs(end[axis]) <= kMaxCoordinate)) {
        throw InvalidPosition("an end of a bond has a coordinate that is " + std::to_string(end[axis]) +
                              "; coordinates have to be finite and at most 1e100");
      }
    }
    magnitude = std::max(magnitude, detail::largest(end));
  }
  BondEncounter out;
  const detail::PairMotion motion(p, q, magnitude);
  const detail::BondSweep sweep_p(p), sweep_q(q);
  // The sweeps are off by what rounding does to their centers and generators, each by less than the error of
  // a coordinate; five generators and a center, in three dimensions.
  if (detail::is_apart_by_zonotope(sweep_p, sweep_q, sweep_q.center - sweep_p.center,
                                   thickness + 12 * motion.error))
    return out;
  bool may_touch = false;
  if (!detail::crossings_by_cubic(motion, out)) {
    detail::PairEnds ends;
    ends.from = {{{p.from_a, {}}, {p.from_b, {}}, {q.from_a, {}}, {q.from_b, {}}}};
    ends.to = {{{p.to_a, {}}, {p.to_b, {}}, {q.to_a, {}}, {q.to_b, {}}}};
    ends.beads = beads;
    may_touch = detail::crossings_by_integers(motion, ends, out);
  }
  if (thickness > 0 || (may_touch && out.count == 0)) detail::note_contact(motion, thickness, out);
  return out;
}

}  // namespace dch::necklace
