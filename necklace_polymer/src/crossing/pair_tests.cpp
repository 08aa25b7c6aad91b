// SPDX-License-Identifier: MIT
#include "crossing/pair_tests.hpp"

#include <algorithm>
#include <cmath>

namespace dch::necklace::detail {

bool PairTests::share_bead(std::int32_t a, std::int32_t b) const {
  const IndexPair p = scene_.bonds[static_cast<std::size_t>(a)],
                  q = scene_.bonds[static_cast<std::size_t>(b)];
  return p[0] == q[0] || p[0] == q[1] || p[1] == q[0] || p[1] == q[1];
}

void PairTests::take_rows(const NearMidpoints& near, std::size_t first, std::size_t last) {
  const Box& box = scene_.motion.middle_box();
  for (std::size_t row = first; row < last; ++row) {
    const std::int32_t owner = near.owner(row);
    if (radius(owner) < 0 || near.is_wide(radius(owner))) continue;
    std::optional<Bond> own;  // made when a partner passes the balls
    for (const std::int32_t partner : near.partners(row)) {
      if (radius(partner) < 0 || near.is_wide(radius(partner))) continue;
      const std::int32_t p = std::min(owner, partner), q = std::max(owner, partner);
      const Vec3 between = box.nearest_image(center(q) - center(p));
      const double reach = static_cast<double>(radius(p)) + static_cast<double>(radius(q));
      if (norm2(between) > reach * reach) {  // never of bonds that share a bead
        ++found.stats.near_pairs;
        ++found.stats.by_ball;
        continue;
      }
      if (share_bead(owner, partner)) continue;
      ++found.stats.near_pairs;
      if (!own) own = bond_at(owner);
      const Bond other = bond_at(partner);
      if (owner == p) {
        take(*own, other, between);
      } else {
        take(other, *own, between);
      }
    }
  }
}

void PairTests::take_wide(const NearMidpoints& near, std::int32_t bond) {
  const Box& box = scene_.motion.middle_box();
  const Bond own = bond_at(bond);
  for (std::int32_t other = 0; static_cast<std::size_t>(other) < scene_.bonds.size(); ++other) {
    // Of two wide bonds that of the lower number takes the pair.
    if (radius(other) < 0 || (near.is_wide(radius(other)) && other <= bond) || share_bead(bond, other))
      continue;
    const std::int32_t p = std::min(bond, other), q = std::max(bond, other);
    const Vec3 nearest = box.nearest_image(center(q) - center(p));
    const double reach = static_cast<double>(radius(p)) + static_cast<double>(radius(q));
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
          ++found.stats.near_pairs;
          if (norm2(between) > reach * reach) {
            ++found.stats.by_ball;
            continue;
          }
          if (!partner) partner = bond_at(other);
          if (bond == p) {
            take(own, *partner, between);
          } else {
            take(*partner, own, between);
          }
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
