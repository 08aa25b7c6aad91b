// SPDX-License-Identifier: MIT
#include "crossing/pair_tests.hpp"

#include <algorithm>
#include <cmath>

namespace dch::necklace::detail {
namespace {

constexpr std::int64_t kAhead = 16;    ///< pairs whose bonds, in no cache, are asked for before their turn
constexpr std::size_t kTogether = 64;  ///< pairs, about, whose beads are asked for together

}  // namespace

bool PairTests::share_bead(std::int32_t a, std::int32_t b) const {
  const IndexPair p = scene_.bonds[static_cast<std::size_t>(a)],
                  q = scene_.bonds[static_cast<std::size_t>(b)];
  return p[0] == q[0] || p[0] == q[1] || p[1] == q[0] || p[1] == q[1];
}

void PairTests::take_piece(const NeighborList& piece) {
  const std::int64_t last = piece.first.back() - 1;
  for (std::size_t row = 0; row < piece.size(); ++row) {
    const std::int32_t owner = piece.particle.empty() ? static_cast<std::int32_t>(row) : piece.particle[row];
    for (std::int64_t k = piece.first[row]; k < piece.first[row + 1]; ++k) {
      ask_for(piece.j[static_cast<std::size_t>(std::min(k + kAhead, last))]);
      meet(owner, piece.j[static_cast<std::size_t>(k)]);
    }
    if (met_.size() >= kTogether) take_met();
  }
  take_met();
}

void PairTests::ask_for(std::int32_t bond) const {
  __builtin_prefetch(&bounds(bond));
  __builtin_prefetch(&scene_.centers[static_cast<std::size_t>(bond)]);
}

/// Keeps a near pair for take_met() unless it is rejected at once.
void PairTests::meet(std::int32_t owner, std::int32_t partner) {
  if (is_left_out(owner) || is_left_out(partner)) return;
  const Vec3 between = scene_.motion.middle_box().nearest_image(center(partner) - center(owner));
  if (rejects(owner, partner, between)) return;  // none that share a bead
  met_.push_back({owner, partner, between});
  __builtin_prefetch(&scene_.bonds[static_cast<std::size_t>(partner)]);
}

/// Beads of many bonds stand in no cache. So all are asked for before the first is looked at.
void PairTests::take_met() {
  const auto bonded = [&](const Met& pair) { return share_bead(pair.owner, pair.partner); };
  met_.erase(std::remove_if(met_.begin(), met_.end(), bonded), met_.end());
  for (const Met& pair : met_) {
    scene_.motion.ask_for(scene_.bonds[static_cast<std::size_t>(pair.owner)]);
    scene_.motion.ask_for(scene_.bonds[static_cast<std::size_t>(pair.partner)]);
  }
  std::optional<Bond> own;
  for (const Met& pair : met_) {
    ++found.stats.near_pairs;
    if (!own || own->index != pair.owner) own = bond_at(pair.owner);
    take_either(*own, bond_at(pair.partner), pair.between);
  }
  met_.clear();
}

bool PairTests::rejects(std::int32_t p, std::int32_t q, Vec3 between) {
  const bool by_ball = is_apart_by_ball(bounds(p), bounds(q), between);
  if (!by_ball && !is_apart_by_bounds(bounds(p), bounds(q), between)) return false;
  ++found.stats.near_pairs;
  ++(by_ball ? found.stats.by_ball : found.stats.by_box);
  return true;
}

void PairTests::take_wide(std::int32_t bond) {
  const Box& box = scene_.motion.middle_box();
  const Bond own = bond_at(bond);
  for (std::int32_t other = 0; static_cast<std::size_t>(other) < scene_.bonds.size(); ++other) {
    // Of two wide bonds that of the lower number takes the pair.
    if (bounds(other).is_left_out() || (is_wide(other) && other <= bond) || share_bead(bond, other)) continue;
    const Vec3 nearest = box.nearest_image(center(other) - center(bond));
    const double reach = static_cast<double>(bounds(bond).radius) + static_cast<double>(bounds(other).radius);
    std::array<int, 3> images{};
    if (reach > box.max_cutoff()) {
      for (std::size_t k = 0; k < static_cast<std::size_t>(box.rank()); ++k)
        images[k] = static_cast<int>(std::ceil(reach * std::sqrt(norm2(box.reduced_dual()[k])) + 0.5)) + 1;
    }
    std::optional<Bond> partner;
    for (int a = -images[0]; a <= images[0]; ++a) {
      for (int b = -images[1]; b <= images[1]; ++b) {
        for (int c = -images[2]; c <= images[2]; ++c) {
          const Vec3 between = nearest + (a * box.reduced()[0] + b * box.reduced()[1] + c * box.reduced()[2]);
          if (rejects(bond, other, between)) continue;
          ++found.stats.near_pairs;
          if (!partner) partner = bond_at(other);
          take_either(own, *partner, between);
        }
      }
    }
  }
}

void PairTests::take(const Bond& p, const Bond& q, Vec3 between) {
  const Vec3 unshifted = center(q.index) - center(p.index);
  const Image image = between == unshifted ? Image{} : scene_.motion.middle_image(between - unshifted);
  const double magnitude =
      std::max(p.step.magnitude, q.step.magnitude) + scene_.motion.shift_magnitude(image);
  // Centers and generators are each off by less than twice the error of an end; there are six of them, in
  // three dimensions.
  const double margin = scene_.thickness + 32 * kEndError * magnitude;
  if (is_apart_by_box(p.sweep, q.sweep, between, margin)) {
    ++found.stats.by_box;
  } else if (is_apart_by_zonotope(p.sweep, q.sweep, between, margin)) {
    ++found.stats.by_zonotope;
  } else {
    take_near(p, q, image);
  }
}

void PairTests::take_near(const Bond& p, const Bond& q, const Image& image) {
  const Vec3 from = scene_.motion.shift_from(image), to = scene_.motion.shift_to(image);
  const MovingBond shifted{q.step.ends.from_a + from, q.step.ends.from_b + from, q.step.ends.to_a + to,
                           q.step.ends.to_b + to};
  const double magnitude =
      std::max(p.step.magnitude, q.step.magnitude) + scene_.motion.shift_magnitude(image);
  const PairMotion motion(p.step.ends, shifted, magnitude);
  BondEncounter encounter;
  bool may_touch = false;
  if (!crossings_by_cubic(motion, encounter)) {
    const auto beads = [&](const Bond& bond) { return scene_.bonds[static_cast<std::size_t>(bond.index)]; };
    may_touch = crossings_by_integers(motion, scene_.motion.ends(beads(p), beads(q), p.step, q.step, image),
                                      encounter);
    ++found.stats.exact;
  } else if (encounter.count == 0) {
    ++found.stats.by_cubic;
  }
  if (scene_.thickness > 0 || (may_touch && encounter.count == 0))
    note_contact(motion, scene_.thickness, encounter);
  note(p, q, encounter);
}

void PairTests::note(const Bond& p, const Bond& q, const BondEncounter& encounter) {
  const bool has_sign = static_cast<std::size_t>(q.index) < scene_.on_chains;  // p < q
  for (int k = 0; k < encounter.count; ++k) {
    BondCrossing crossing;
    static_cast<Crossing&>(crossing) = encounter.crossings[static_cast<std::size_t>(k)];
    crossing.p = p.index;
    crossing.q = q.index;
    if (!has_sign) crossing.sign = 0;
    found.crossings.push_back(crossing);
  }
  if (encounter.contact)
    found.contacts.push_back({p.index, q.index, encounter.contact_time, encounter.contact_distance});
}

}  // namespace dch::necklace::detail
