// SPDX-License-Identifier: MIT
//
// A finder of crossings holds nothing after a step that memory did not suffice for, and what it answers after
// the next start is whole.
#include <memory>
#include <vector>

#include <dch/necklace/crossings.hpp>
#include <dch/necklace/knots.hpp>
#include <dch/necklace/shapes.hpp>

#include "random.hpp"
#include "sweep.hpp"

namespace dch::faults {
namespace {

using necklace::CrossingFinder;

/// A bundle of bonds, half of which go through the others.
struct Bundle {
  static constexpr int kBonds = 40;
  std::vector<IndexPair> bonds;
  std::vector<Vec3> from, to;
  Box box = Box::orthorhombic({8, 8, 8});

  Bundle() {
    scenes::Random random(1);
    for (std::int32_t k = 0; k < kBonds; ++k) {
      bonds.push_back({2 * k, 2 * k + 1});
      const Vec3 center = random.in_cube(1.5), half = random.in_ball(0.7);
      for (const Vec3 end : {center - half, center + half}) {
        from.push_back(end);
        to.push_back(end + Vec3{0, 0, k % 2 == 0 ? 1.0 : -1.0});
      }
    }
    // At rest on each other: decided by integers.
    const std::vector<Vec3> touching{{1, -1, 3}, {1, 1, 3}, {-1, 0, 3}, {1, 0, 3}};
    for (std::size_t k = 0; k < touching.size(); ++k) from[k] = to[k] = touching[k];
  }
  std::unique_ptr<CrossingFinder> started() const {
    auto finder = std::make_unique<CrossingFinder>(from.size(), bonds);
    finder->start(from, box);
    return finder;
  }
};

TEST(CrossingFaults, AStepIsWholeOrNothingIsHeld) {
  const Bundle bundle;
  const auto whole = bundle.started()->step(bundle.to, bundle.box);
  ASSERT_GT(whole.crossings.size(), 1U);
  ASSERT_GT(whole.stats.exact, 0);
  expect_sound(
      sweep([&] { return bundle.started(); }, [&](auto& finder) { finder->step(bundle.to, bundle.box); },
            [&](auto& finder, Ending ending) -> std::string {
              if (ending == Ending::threw) {
                try {
                  finder->step(bundle.to, bundle.box);
                  return "it holds something";
                } catch (const InvalidParameter&) {
                }
              }
              finder->start(bundle.from, bundle.box);
              const auto& found = finder->step(bundle.to, bundle.box);
              return found.crossings.size() == whole.crossings.size() ? "" : "events are missing";
            }),
      20);
}

TEST(CrossingFaults, BondsAreChangedOrNot) {
  const Bundle bundle;
  const std::vector<IndexPair> fewer(bundle.bonds.begin() + 1, bundle.bonds.end());
  expect_sound(sweep([&] { return bundle.started(); }, [&](auto& finder) { finder->set_bonds(fewer); },
                     [&](auto& finder, Ending ending) -> std::string {
                       const std::size_t expected =
                           ending == Ending::threw ? bundle.bonds.size() : fewer.size();
                       if (finder->bonds().size() != expected) return "another number of bonds";
                       return finder->step(bundle.to, bundle.box).started == 0 ? "" : "bonds start anew";
                     }),
               5);
}

TEST(CrossingFaults, InvariantsAreThereOrNot) {
  const std::vector<Vec3> knot = necklace::torus_knot(2, 3, 30).positions;
  expect_sound(sweep([] { return 0; },
                     [&](int) {
                       if (necklace::knot_determinant(knot) != 3) throw std::logic_error("wrong");
                     },
                     [](int, Ending) { return std::string(); }),
               5);
}

}  // namespace
}  // namespace dch::faults
