// SPDX-License-Identifier: MIT
//
// Motions that are made to be degenerate, in boxes of every kind and through their faces, as the finder sees
// them. Coordinates and cell vectors are short binary fractions, so that what is made is what a wrapped
// position is: nothing is rounded.
#include "constructed_motions.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

#include <dch/necklace/crossings.hpp>

#include "crossing_perturbation.hpp"
#include "effort.hpp"
#include "random.hpp"
#include "scenes.hpp"

namespace {

using dch::Box;
using dch::IndexPair;
using dch::Vec3;
using dch::crossing_oracle::Event;
using dch::crossings::kAnyNumber;
using dch::crossings::kKinds;
using dch::crossings::Motion;
using dch::necklace::CrossingFinder;
using dch::necklace::MovingBond;
using dch::scenes::Random;

constexpr std::uint64_t kSeed = 20261125;

/// In another basis, of small integers, which keeps planes, lines and multiple roots.
void turn(Motion& motion, Random& random) {
  std::array<Vec3, 3> basis;
  do {
    for (Vec3& v : basis) {
      for (int axis = 0; axis < 3; ++axis) v[axis] = static_cast<double>(random.below(3)) - 1;
    }
  } while (dot(cross(basis[0], basis[1]), basis[2]) == 0);
  for (auto& frame : motion.frames) {
    for (Vec3& p : frame) p = p.x * basis[0] + (p.y * basis[1] + p.z * basis[2]);
  }
}

double coarse(double x) { return std::round(std::ldexp(x, 12)) * 0x1p-12; }
Vec3 coarse(Vec3 v) { return {coarse(v.x), coarse(v.y), coarse(v.z)}; }

Box coarse(const Box& box) {
  if (box.kind() == Box::Kind::none) return box;
  const Box::Periodic periodic{box.periodic(0), box.periodic(1), box.periodic(2)};
  return Box::triclinic(coarse(box.vector(0)), coarse(box.vector(1)), coarse(box.vector(2)), periodic,
                        coarse(box.origin()));
}

/// Near a corner, an edge or a face of the box, or anywhere.
Vec3 place(Random& random, const Box& box) {
  Vec3 at;
  for (int axis = 0; axis < 3; ++axis) at[axis] = random.below(3) == 0 ? random.uniform() : 0;
  const Vec3 there = dch::scenes::from_fractional(box, at);
  return {std::round(8 * there.x) / 8, std::round(8 * there.y) / 8, std::round(8 * there.z) / 8};
}

bool share_bead(IndexPair p, IndexPair q) {
  return p[0] == q[0] || p[0] == q[1] || p[1] == q[0] || p[1] == q[1];
}

std::vector<Event> exact_events(const std::vector<Vec3>& from, const std::vector<Vec3>& to, IndexPair p,
                                IndexPair q) {
  const auto moving = [&](IndexPair bond) {
    const auto a = static_cast<std::size_t>(bond[0]), b = static_cast<std::size_t>(bond[1]);
    return MovingBond{from[a], from[b], to[a], to[b]};
  };
  const auto number = [](std::int32_t bead) { return static_cast<std::uint64_t>(bead); };
  constexpr int kDepth = 800;
  const auto whole = dch::crossing_oracle::perturbed(
      {moving(p), moving(q)}, {number(p[0]), number(p[1]), number(q[0]), number(q[1])});
  const auto events = dch::crossing_oracle::Oracle(whole, kDepth).events();
  EXPECT_TRUE(events) << "the oracle does not know";
  return dch::crossing_oracle::without_cancelling(*events);
}

struct Seen {
  int motions = 0, crossings = 0, touches = 0, missed = 0, invented = 0, through_faces = 0;
  std::int64_t exact = 0;
};

void follow(const Motion& motion, const Box& box, Vec3 by, Seen& seen) {
  std::vector<std::vector<Vec3>> inside = motion.frames;
  bool is_through_face = false;
  for (auto& frame : inside) {
    for (std::size_t k = 0; k < frame.size(); ++k) {
      const Vec3 moved = frame[k] + by;
      frame[k] = box.wrap(moved);
      is_through_face |= frame[k] - moved != inside[0][0] - (motion.frames[0][0] + by);
    }
  }
  CrossingFinder finder(inside[0].size(), motion.bonds);
  ASSERT_EQ(std::vector<IndexPair>(finder.bonds().begin(), finder.bonds().end()), motion.bonds);
  finder.start(inside[0], box);
  int crossings = 0;
  bool touches = false;
  for (std::size_t step = 1; step < inside.size(); ++step) {
    const auto& found = finder.step(inside[step], box);
    EXPECT_TRUE(found.undetermined.empty());
    seen.exact += found.stats.exact;
    touches |= !found.contacts.empty();
    crossings += static_cast<int>(found.crossings.size());
    for (std::size_t p = 0; p < motion.bonds.size(); ++p) {
      for (std::size_t q = p + 1; q < motion.bonds.size(); ++q) {
        if (share_bead(motion.bonds[p], motion.bonds[q])) continue;
        const auto expected =
            exact_events(motion.frames[step - 1], motion.frames[step], motion.bonds[p], motion.bonds[q]);
        std::vector<int> signs, of_oracle;
        for (const auto& crossing : found.crossings) {
          if (crossing.p == static_cast<std::int32_t>(p) && crossing.q == static_cast<std::int32_t>(q))
            signs.push_back(crossing.sign);
        }
        for (const Event& event : expected) of_oracle.push_back(-event.sign);
        EXPECT_EQ(signs, of_oracle) << "step " << step;
        const int more = static_cast<int>(signs.size()) - static_cast<int>(of_oracle.size());
        (more > 0 ? seen.invented : seen.missed) += std::abs(more);
      }
    }
  }
  if (motion.crossings != kAnyNumber) {
    EXPECT_EQ(crossings, motion.crossings);
  }
  if (motion.is_touch) {
    EXPECT_TRUE(touches);
  }
  ++seen.motions;
  seen.crossings += crossings;
  seen.touches += touches ? 1 : 0;
  seen.through_faces += is_through_face ? 1 : 0;
}

/// Each kind in each box: 1,080 motions in the long test, a third of them in the short one.
TEST(ConstructedMotions, NoneIsMissedAndNoneIsInvented) {
  Random random(kSeed);
  const auto boxes = dch::scenes::all_boxes(32);
  const int rounds = std::getenv("DCH_TEST_LONG") != nullptr ? 12 : dch::effort(4);
  std::map<std::string, Seen> seen;
  Seen all;
  for (int round = 0; round < rounds; ++round) {
    for (const auto& [name, make] : kKinds) {
      for (const auto& named : boxes) {
        const Box box = coarse(named.box);
        Motion motion = make(random);
        turn(motion, random);
        const testing::ScopedTrace trace(__FILE__, __LINE__,
                                         name + ", " + named.name + ", round " + std::to_string(round));
        follow(motion, box, place(random, box), seen[name]);
      }
    }
  }
  for (const auto& [name, of_kind] : seen) {
    std::printf("%s: %d motions, %d through faces, %d crossings, %d touches, %ld pairs by integers\n",
                name.c_str(), of_kind.motions, of_kind.through_faces, of_kind.crossings, of_kind.touches,
                static_cast<long>(of_kind.exact));
    all.motions += of_kind.motions;
    all.missed += of_kind.missed;
    all.invented += of_kind.invented;
    all.through_faces += of_kind.through_faces;
  }
  std::printf("%d motions, %d through faces, %d crossings missed, %d invented, seed %llu\n", all.motions,
              all.through_faces, all.missed, all.invented, static_cast<unsigned long long>(kSeed));
  EXPECT_EQ(all.motions, rounds * static_cast<int>(kKinds.size() * boxes.size()));
  EXPECT_GT(all.through_faces, all.motions / 3);
  EXPECT_EQ(all.missed, 0);
  EXPECT_EQ(all.invented, 0);
}

}  // namespace
