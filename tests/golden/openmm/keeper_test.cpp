// SPDX-License-Identifier: MIT
//
// The pairs of the CPU platform: for particles that have wandered through many periods of the box, for those
// that have moved beyond half the skin, and in boxes that change.
#include <cmath>
#include <gtest/gtest.h>

#include <dch/base/error.hpp>
#include <dch/engines/expiry_test.hpp>
#include <dch/lists/stale_test.hpp>

#include "ClusterPairKeeper.h"
#include "cluster_pair_check.hpp"
#include "random.hpp"

namespace OpenMMDCH {
namespace {

using dch::Box;
using dch::Vec3;

constexpr double kCutoff = 0.9;

std::vector<Vec3> jittered_lattice(int per_side, const Box& box, dch::scenes::Random& random) {
  std::vector<Vec3> positions;
  for (int k = 0; k < per_side * per_side * per_side; ++k) {
    const double x = (k % per_side + 0.3 * random.uniform()) / per_side;
    const double y = (k / per_side % per_side + 0.3 * random.uniform()) / per_side;
    const double z = (k / per_side / per_side + 0.3 * random.uniform()) / per_side;
    positions.push_back(x * box.vector(0) + y * box.vector(1) + z * box.vector(2));
  }
  return positions;
}

struct Walk {
  std::int64_t searches;
  std::size_t split;  ///< clusters, at most at any step, that refreshing had to bring together
};

/// Small steps of particles, each up to so many periods away from the box, with every pair checked.
Walk walk(const Box& box, double periods_away) {
  dch::scenes::Random random(7);
  std::vector<Vec3> positions = jittered_lattice(8, box, random);
  dch::scenes::Random far(8);
  for (Vec3& p : positions)
    for (int axis = 0; axis < 3; ++axis)
      p = p + std::round(periods_away * far.uniform(-1, 1)) * box.vector(axis);
  const auto executor = dch::make_thread_pool(1);
  const dch::Exclusions none;
  ClusterPairKeeper keeper(kCutoff, none, *executor);
  dch::ListParams within;
  within.cutoffs = dch::TypeCutoffs(kCutoff);
  Walk result{0, 0};
  for (int step = 0; step < 12; ++step) {
    const dch::ClusterPairs& pairs = keeper.at(positions, box);
    EXPECT_EQ(dch::cluster_pair_fault(pairs, positions, box, within), "")
        << "step " << step << ", " << periods_away << " periods away, " << box.description();
    if (step > 0) result.split = std::max(result.split, pairs.split_clusters.size());
    for (Vec3& p : positions) p = p + random.in_ball(0.004);
  }
  result.searches = keeper.searches();
  return result;
}

TEST(ClusterPairKeeperTest, ParticlesThatWanderedCostNoMore) {
  for (const Box& box :
       {Box::orthorhombic({3, 3.2, 3.4}), Box::triclinic({3, 0, 0}, {1.4, 3, 0}, {-1.3, 1.2, 3})}) {
    const Walk at_home = walk(box, 0);
    EXPECT_EQ(at_home.searches, 1);
    for (const double periods_away : {1.0, 1e3, 1e6}) {
      const Walk away = walk(box, periods_away);
      EXPECT_EQ(away.searches, 1) << periods_away << " periods away, " << box.description();
      EXPECT_EQ(away.split, 0u) << periods_away << " periods away, " << box.description();
    }
  }
}

/// A keeper of pairs within kCutoff, each answer of which is checked unless it is asked for unchecked.
class CheckedKeeper {
 public:
  CheckedKeeper() { within.cutoffs = dch::TypeCutoffs(kCutoff); }

  void unchecked_at(const std::vector<Vec3>& positions, const Box& box) { keeper.at(positions, box); }
  void at(const std::vector<Vec3>& positions, const Box& box) {
    EXPECT_EQ(dch::cluster_pair_fault(keeper.at(positions, box), positions, box, within), "")
        << keeper.searches() << " searches, " << box.description();
  }
  std::int64_t searches() const { return keeper.searches(); }

 private:
  std::unique_ptr<dch::Executor> executor = dch::make_thread_pool(1);
  dch::Exclusions none;
  dch::ListParams within;
  ClusterPairKeeper keeper{kCutoff, none, *executor};
};

TEST(ClusterPairKeeperTest, PairsAreKeptWhileNoneIsMissing) {
  constexpr double kSkin = 0.1 * kCutoff;
  for (const Box& box :
       {Box::orthorhombic({3, 3.2, 3.4}), Box::triclinic({3, 0, 0}, {1.4, 3, 0}, {-1.3, 1.2, 3})}) {
    dch::scenes::Random random(9);
    std::vector<Vec3> positions = jittered_lattice(8, box, random), velocity(positions.size());
    for (std::size_t i = 0; i < velocity.size(); ++i)
      velocity[i] = random.in_ball(i % 64 == 0 ? 0.25 * kSkin : 0.05 * kSkin);
    CheckedKeeper keeper;
    dch::StaleTest half(kSkin);
    std::int64_t searchesByHalf = 0;
    for (int step = 0; step < 100; ++step) {
      keeper.at(positions, box);
      if (half.is_stale(positions, box)) {
        half.remember(positions, box);
        ++searchesByHalf;
      }
      for (std::size_t i = 0; i < velocity.size(); ++i) positions[i] = positions[i] + velocity[i];
    }
    EXPECT_LT(1.2 * static_cast<double>(keeper.searches()), static_cast<double>(searchesByHalf))
        << box.description();
    EXPECT_GT(keeper.searches(), 5);
  }
}

/// The rule that a keeper goes by, all of it at each time.
class PlainRule {
 public:
  void at(const std::vector<Vec3>& positions, const Box& box) {
    if (!expiry.is_stale(positions, box, request, *search)) return;
    search->update(positions, box);
    search->cluster_pairs(request, pairs);
    expiry.remember(positions, box, request);
    ++searches;
  }
  std::int64_t searches = 0;

 private:
  static dch::ListParams asked() {
    dch::ListParams request;
    request.cutoffs = dch::TypeCutoffs(kCutoff);
    request.skin = 0.1 * kCutoff;
    return request;
  }
  static dch::HierarchyParams params() {
    dch::HierarchyParams params;
    params.radius = asked().list_radius();
    return params;
  }
  const dch::ListParams request = asked();
  std::unique_ptr<dch::PairSearch> search = dch::make_dch_search(params());
  dch::ExpiryTest expiry{request.skin, dch::Expiry::exact, dch::KeptImages::as_found};
  dch::ClusterPairs pairs;
};

/// Positions and boxes: particles that fly, some fast and some far from the box, alone or not, a
/// box that is scaled with them now and then and put back every other time, jumps to other images.
class Motion {
 public:
  Motion(const Box& ofMotion, int perSide, double periodsAway) : box(ofMotion) {
    positions = jittered_lattice(perSide, box, random);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      velocity.push_back(random.in_ball(i % 64 == 0 ? 0.02 : 0.004));
      for (int axis = 0; box.any_periodic() && axis < 3; ++axis)
        positions[i] = positions[i] + std::round(periodsAway * random.uniform(-1, 1)) * box.vector(axis);
    }
  }
  void next(int step) {
    for (std::size_t i = 0; i < velocity.size(); ++i) positions[i] = positions[i] + velocity[i];
    if (!box.any_periodic()) return;
    if (step % 10 == 9)
      for (std::size_t i = 0; i < positions.size(); i += 3) positions[i] = box.wrap(positions[i]);
    if (step % 7 == 3) scale(step % 14 == 3 ? 1.004 : 1.003);
    if (step % 14 == 4) scale(1 / 1.004);
  }
  Box box;
  std::vector<Vec3> positions;

 private:
  void scale(double by) {
    box = Box::triclinic(by * box.vector(0), by * box.vector(1), by * box.vector(2));
    for (Vec3& p : positions) p = by * p;
  }
  dch::scenes::Random random{14};
  std::vector<Vec3> velocity;
};

TEST(ClusterPairKeeperTest, PairsAreMadeAnewWhenThePlainRuleSays) {
  for (const Box& box :
       {Box::orthorhombic({5, 5.2, 5.4}), Box::triclinic({5, 0, 0}, {1.4, 5, 0}, {-1.3, 1.2, 5}),
        Box::orthorhombic({5, 5.2, 5.4}, {false, false, false})})
    for (const int perSide : {5, 11})
      for (const double periodsAway : {0.0, 0.6, 1e3}) {
        Motion run(box, perSide, periodsAway);
        CheckedKeeper keeper;
        PlainRule rule;
        for (int step = 0; step < 60; ++step) {
          if (step % 8 == 7)
            keeper.at(run.positions, run.box);
          else
            keeper.unchecked_at(run.positions, run.box);
          rule.at(run.positions, run.box);
          ASSERT_EQ(keeper.searches(), rule.searches)
              << "step " << step << ", " << perSide << ", " << periodsAway << ", " << box.description();
          run.next(step);
        }
        EXPECT_GT(rule.searches, 1);
        EXPECT_LT(rule.searches, 40);
      }
}

TEST(ClusterPairKeeperTest, NumbersThatAreNoneAreRefusedAndLeaveNothing) {
  const Box box = Box::orthorhombic({5, 5.2, 5.4});
  dch::scenes::Random random(15);
  std::vector<Vec3> positions = jittered_lattice(11, box, random);
  CheckedKeeper keeper;
  keeper.at(positions, box);
  for (const double none : {std::nan(""), HUGE_VAL}) {
    std::vector<Vec3> wrong = positions;
    wrong[17].z = none;
    EXPECT_THROW(keeper.at(wrong, box), dch::InvalidPosition);
    keeper.at(positions, box);
  }
  EXPECT_EQ(keeper.searches(), 3);
}

// One that meets nobody is in no cluster.
TEST(ClusterPairKeeperTest, AParticleOnItsOwnIsSeenToCome) {
  for (const Box& box : {Box(), Box::orthorhombic({8, 8, 8})}) {
    CheckedKeeper keeper;
    std::vector<Vec3> positions{{1, 1, 1}, {1.5, 1, 1}, {3.4, 1, 1}};
    for (int step = 0; step < 30; ++step) {
      keeper.at(positions, box);
      positions[2].x -= 0.04;
    }
    EXPECT_GT(keeper.searches(), 1);
    EXPECT_LT(keeper.searches(), 10);
  }
}

TEST(ClusterPairKeeperTest, OtherTypesMakeNoNewSearch) {
  const Box box = Box::orthorhombic({3, 3.2, 3.4});
  dch::scenes::Random random(10);
  std::vector<Vec3> positions = jittered_lattice(8, box, random);
  const auto executor = dch::make_thread_pool(1);
  const dch::Exclusions none;
  ClusterPairKeeper keeper(kCutoff, none, *executor);
  for (const int types : {3, 1, 4, 2}) {
    std::vector<std::int32_t> type;
    for (std::size_t i = 0; i < positions.size(); ++i)
      type.push_back(static_cast<std::int32_t>(random.below(types)));
    keeper.setTypes(types == 1 ? std::vector<std::int32_t>() : type, types);
    for (const bool jumps : {false, types == 4}) {
      if (jumps) positions[0] = positions[0] + Vec3{1.5, 0, 0};
      const dch::ClusterPairs& pairs = keeper.at(positions, box);
      EXPECT_EQ(pairs.types, types);
      for (std::size_t k = 0; k < pairs.particle.size(); ++k) {
        const bool is_typed = types > 1 && pairs.particle[k] >= 0;
        EXPECT_EQ(pairs.type[k], is_typed ? type[static_cast<std::size_t>(pairs.particle[k])] : 0);
      }
    }
  }
  EXPECT_EQ(keeper.searches(), 2);
}

// Two particles that are paired in one image, and come near each other in the next one.
TEST(ClusterPairKeeperTest, AnotherImageOfAPairIsSeen) {
  constexpr double kSkin = 0.1 * kCutoff, kSide = 2 * (kCutoff + kSkin) + 1e-6;
  const Box box = Box::orthorhombic({kSide, kSide, kSide});
  CheckedKeeper keeper;
  keeper.at({{0, 1, 1}, {kCutoff + 0.99 * kSkin, 1, 1}}, box);
  keeper.at({{-0.9 * kSkin, 1, 1}, {kCutoff + 1.2 * kSkin, 1, 1}}, box);
  EXPECT_EQ(keeper.searches(), 2);
}

// What a barostat does: box and particles are scaled, forces are asked for, and all is put back.
TEST(ClusterPairKeeperTest, ABoxThatIsTriedNeedsNoSearch) {
  for (const Box& box :
       {Box::orthorhombic({5, 5.2, 5.4}), Box::triclinic({5, 0, 0}, {1.4, 5, 0}, {-1.3, 1.2, 5})}) {
    dch::scenes::Random random(10);
    std::vector<Vec3> positions = jittered_lattice(11, box, random);
    CheckedKeeper keeper;
    keeper.at(positions, box);
    for (const double scale : {1.02, 0.98}) {
      const Box tried = Box::triclinic(scale * box.vector(0), scale * box.vector(1), scale * box.vector(2));
      std::vector<Vec3> scaled;
      for (const Vec3& p : positions) scaled.push_back(scale * p + random.in_ball(0.03));
      keeper.at(scaled, tried);
      keeper.at(positions, box);
    }
    EXPECT_EQ(keeper.searches(), 1) << box.description();
  }
}

}  // namespace
}  // namespace OpenMMDCH
