// SPDX-License-Identifier: MIT
//
// Kept lists against all pairs: a list that is kept lacks no pair within its cutoff, and one that is given up
// because of a pair lacks a pair. Engines that can tell all say the same.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <dch/engines/verlet_list.hpp>
#include <dch/lists/all_pairs.hpp>

#include "effort.hpp"
#include "list_compare.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

constexpr double kCutoff = 1.0, kSkin = 0.3, kRadius = kCutoff + kSkin;

struct NamedRequest {
  std::string name;
  ListParams params;
};

/// What lists may hold; owns what the requests view.
class Requests {
 public:
  explicit Requests(std::size_t n) {
    scenes::Random random(3);
    std::vector<IndexPair> excluded;
    for (std::size_t i = 0; i < n; ++i) {
      types_.push_back(static_cast<std::int32_t>(i % 5 == 0 ? 0 : 1 + i % 2));
      radii_.push_back(0.5 * kCutoff * (i % 7 == 0 ? 1.0 : std::pow(8, -random.uniform())));
      if (i % 3 == 0 && i + 1 < n)
        excluded.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(i + 1)});
    }
    exclusions_ = Exclusions::from_bonds(n, excluded, 1);
    const auto add = [&](const std::string& name) -> ListParams& {
      all_.push_back({name, {}});
      all_.back().params.cutoffs = TypeCutoffs(kCutoff);
      all_.back().params.skin = kSkin;
      return all_.back().params;
    };
    add("half");
    ListParams& full = add("full, unsorted, exclusions, ghosts");
    full.kind = ListKind::full;
    full.order = RowOrder::unsorted;
    full.exclusions = &exclusions_;
    full.first_ghost = static_cast<std::int32_t>(n - n / 4);
    ListParams& by_types = add("types, some without pairs");
    by_types.types = types_;
    by_types.cutoffs = TypeCutoffs(3, {kCutoff, 0.7, 0.0, 0.7, 0.3, 0.2, 0.0, 0.2, 0.0});
    ListParams& by_radii = add("radii");
    by_radii.radii = radii_;
    by_radii.order = RowOrder::unsorted;
  }
  Requests(const Requests&) = delete;
  Requests& operator=(const Requests&) = delete;
  const std::vector<NamedRequest>& all() const { return all_; }

 private:
  std::vector<std::int32_t> types_;
  std::vector<double> radii_;
  Exclusions exclusions_;
  std::vector<NamedRequest> all_;
};

struct NamedList {
  std::string name;
  VerletList list;
};

/// A list by each engine that can tell.
std::vector<NamedList> lists_of_all_engines(const ListParams& params) {
  HierarchyParams hierarchy, by_class, coarse;
  hierarchy.radius = by_class.radius = coarse.radius = kRadius;
  by_class.size_classes = true;
  coarse.policy = MaintenancePolicy::always_repair;
  std::vector<NamedList> all;
  all.push_back({"hierarchy", {make_dch_search(hierarchy), params}});
  all.push_back({"hierarchy, always repaired", {make_dch_search(coarse), params}});
  all.push_back({"hierarchies by size", {make_dch_search(by_class), params}});
  all.push_back({"grid", {make_grid_search(kRadius), params}});
  all.push_back({"auto", {make_auto_search(hierarchy), params}});
  return all;
}

/// Pairs within their cutoffs now that a list lacks.
std::size_t missing_from(const NeighborList& list, const NeighborList& near) {
  const NeighborList rows = list.particle.empty() ? list : sorted_by_index(list, near.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < near.size(); ++i) {
    const auto row = rows.row(i);
    for (const std::int32_t j : near.row(i)) count += !std::binary_search(row.begin(), row.end(), j);
  }
  return count;
}

/// Follows particles in one box, and checks at each step what every list says of itself.
class Follower {
 public:
  Follower(Box box, const NamedRequest& request, std::vector<Vec3> points)
      : box_(std::move(box)), request_(request), points_(std::move(points)) {
    lists_ = lists_of_all_engines(request.params);
    bare_ = request.params;
    bare_.skin = 0;
    renew();
  }

  /// Moves on, then asks; lists that are stale are made anew.
  void step_to(const std::vector<Vec3>& points, const std::string& what) {
    points_ = points;
    const NeighborList near = all_pairs(points_, box_, bare_);
    const std::size_t fast = count_fast();
    bool is_stale = false;
    for (NamedList& each : lists_) {
      const std::string where = each.name + ", " + request_.name + ", " + what;
      const std::size_t missing = missing_from(each.list.list(), near);
      const ExpiryStats before = each.list.expiry();
      is_stale = each.list.is_stale(points_, box_);
      const ExpiryStats& after = each.list.expiry();
      const bool by_count = after.too_many > before.too_many;
      ASSERT_EQ(after.unknown, 0) << where;
      ASSERT_EQ(by_count, fast > most()) << where << ", " << fast << " fast";
      if (!by_count) {
        ASSERT_EQ(is_stale, missing > 0) << where << ", " << missing << " pairs missing";
        ASSERT_EQ(after.missing > before.missing, is_stale) << where;
      }
      kept_beyond_half_ += !is_stale && fast > 0;
      given_up_for_a_pair_ += is_stale && !by_count;
    }
    if (is_stale) renew();
  }

  const std::vector<Vec3>& points() const { return points_; }
  const Box& box() const { return box_; }
  int kept_beyond_half() const { return kept_beyond_half_; }
  int given_up_for_a_pair() const { return given_up_for_a_pair_; }
  std::size_t most() const {
    return std::max<std::size_t>(16,
                                 static_cast<std::size_t>(kMostFast * static_cast<double>(points_.size())));
  }

 private:
  void renew() {
    for (NamedList& each : lists_) each.list.update(points_, box_);
    at_list_ = points_;
  }
  /// Particles that have moved by more than half the skin; none of a test is within rounding of that.
  std::size_t count_fast() const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < points_.size(); ++i)
      count += std::sqrt(box_.distance2(points_[i], at_list_[i])) > 0.5 * kSkin;
    return count;
  }

  Box box_;
  const NamedRequest& request_;
  ListParams bare_;
  std::vector<Vec3> points_, at_list_;
  std::vector<NamedList> lists_;
  int kept_beyond_half_ = 0, given_up_for_a_pair_ = 0;
};

/// A vector of the lattice, some periods long.
Vec3 periods(const Box& box, scenes::Random& random) {
  Vec3 shift;
  for (int axis = 0; axis < 3; ++axis)
    if (box.periodic(axis)) shift = shift + std::nearbyint(random.uniform(-3, 3)) * box.vector(axis);
  return shift;
}

class ListExpiry : public ::testing::TestWithParam<scenes::NamedBox> {};

// Most particles hardly move, few fly, and any of them may be given in another image than before.
TEST_P(ListExpiry, IsWhenAPairIsMissing) {
  constexpr std::size_t kPoints = 160;
  const Requests requests(kPoints);
  int kept = 0, given_up = 0;
  for (const NamedRequest& request : requests.all()) {
    scenes::Random random(11);
    Follower follower(GetParam().box, request, scenes::uniform_in(GetParam().box, kPoints, 5));
    std::vector<Vec3> points = follower.points(), velocity(kPoints);
    for (std::size_t i = 0; i < kPoints; ++i) velocity[i] = random.in_ball(i % 12 == 0 ? 0.05 : 0.006);
    for (int step = 0; step < effort(60); ++step) {
      for (std::size_t i = 0; i < kPoints; ++i) {
        points[i] = points[i] + velocity[i] + random.in_ball(0.004);
        if (random.below(20) == 0) points[i] = points[i] + periods(follower.box(), random);
      }
      follower.step_to(points, "step " + std::to_string(step));
      if (HasFatalFailure()) return;
    }
    kept += follower.kept_beyond_half();
    given_up += follower.given_up_for_a_pair();
  }
  EXPECT_GT(kept, effort(200)) << "the test says little if lists are never kept beyond half the skin";
  EXPECT_GT(given_up, effort(20)) << "nor if no pair is ever missing";
}

// One particle at a time is anywhere all of a sudden.
TEST_P(ListExpiry, SeesParticlesThatJump) {
  constexpr std::size_t kPoints = 120;
  const Requests requests(kPoints);
  for (const NamedRequest& request : requests.all()) {
    scenes::Random random(12);
    Follower follower(GetParam().box, request, scenes::uniform_in(GetParam().box, kPoints, 6));
    for (int step = 0; step < effort(30); ++step) {
      std::vector<Vec3> points = follower.points();
      for (Vec3& p : points) p = p + random.in_ball(0.01);
      Vec3& p = points[random.below(kPoints)];
      p = p + random.in_ball(std::pow(10, random.uniform(-1, 1.5)));
      follower.step_to(points, "step " + std::to_string(step));
      if (HasFatalFailure()) return;
    }
  }
}

// Two particles that meet, each by its share of the way, amid others that stand still: from just beyond the
// list to just within the cutoff or just without.
TEST_P(ListExpiry, SeesPairsThatMeetAtTheLastMoment) {
  const Requests requests(2);
  const NamedRequest& request = requests.all()[0];
  const Box& box = GetParam().box;
  scenes::Random random(13);
  for (const double share : {0.0, 0.2, 0.45, 0.5, 0.55, 0.8, 1.0}) {
    for (const double aside : {0.0, 0.5, 2.0}) {  // of the way, at right angles
      for (const double off : {-1e-7, 1e-7}) {
        const Vec3 p = scenes::from_fractional(box, {random.uniform(), random.uniform(), random.uniform()});
        const Vec3 any = random.in_ball(1), along = (1 / std::sqrt(norm2(any))) * any;
        const Vec3 across = cross(along, Vec3{along.z, along.x, along.y} + Vec3{0.1, 0.2, 0.3});
        const Vec3 sideways = aside * kSkin / std::sqrt(norm2(across)) * across;
        const std::vector<Vec3> before{p, p + (kRadius + 1e-8) * along};
        const double way = kRadius + 1e-8 - kCutoff - off;
        const std::vector<Vec3> after{before[0] + share * way * along + sideways + periods(box, random),
                                      before[1] - (1 - share) * way * along + sideways};
        Follower follower(box, request, before);
        follower.step_to(after, "share " + std::to_string(share) + ", " + std::to_string(off));
        if (HasFatalFailure()) return;
        ASSERT_EQ(follower.given_up_for_a_pair() > 0, off < 0) << share;
      }
    }
  }
}

// Points on their own, blocks of nothing, deep trees: wide boxes, in which repairs are put off for long.
TEST_P(ListExpiry, SeesParticlesOfThinScenes) {
  constexpr std::size_t kPoints = 250;
  Box box = GetParam().box;
  const Requests requests(kPoints);
  const double wide = 12;
  const Box::Periodic periodic{box.periodic(0), box.periodic(1), box.periodic(2)};
  if (box.kind() != Box::Kind::none)
    box = Box::triclinic(wide * box.vector(0), wide * box.vector(1), wide * box.vector(2), periodic,
                         box.origin());
  scenes::Random random(14);
  std::vector<Vec3> points = scenes::clustered(box, kPoints, 15);
  if (box.kind() == Box::Kind::none)
    for (Vec3& p : points) p = wide * p;
  Follower follower(box, requests.all()[0], points);
  for (int step = 0; step < effort(80); ++step) {
    for (std::size_t i = 0; i < kPoints; ++i)
      points[i] = points[i] + random.in_ball(i % 40 == 0 ? 0.3 : 0.01);
    if (step % 4 == 0) {  // one goes to another's neighborhood
      const Vec3 other = points[random.below(kPoints)];
      points[random.below(kPoints)] = other + random.in_ball(1.2 * kRadius);
    }
    follower.step_to(points, "step " + std::to_string(step));
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(follower.given_up_for_a_pair(), 0);
}

INSTANTIATE_TEST_SUITE_P(Boxes, ListExpiry, ::testing::ValuesIn(scenes::all_boxes(5)),
                         [](const auto& test) { return test.param.name; });

// Where engines cannot tell, or the box is another one, half the skin decides as ever.
TEST(ListExpiryRules, HalfTheSkinDecidesWhereNobodyCanTell) {
  const Requests requests(2);
  const ListParams& params = requests.all()[0].params;
  const Box box = Box::orthorhombic({6, 6, 6}), wider = Box::orthorhombic({6 + 1e-9, 6, 6});
  const std::vector<Vec3> points{{1, 1, 1}, {4, 4, 4}}, far{{1.16, 1, 1}, {4, 4, 4}};
  for (const bool exact : {true, false}) {
    VerletList list(make_dch_search(kRadius), params, exact ? Expiry::exact : Expiry::half_skin);
    list.update(points, box);
    EXPECT_EQ(list.is_stale(far, box), !exact);
    EXPECT_EQ(list.expiry().kept, exact);
    EXPECT_EQ(list.expiry().queries, exact);
    EXPECT_FALSE(list.is_stale(points, wider)) << "by half the skin";
    EXPECT_TRUE(list.is_stale(far, wider)) << "another box";
  }
  VerletList plain(make_cell_search(kRadius), params);
  plain.update(points, box);
  EXPECT_TRUE(plain.is_stale(far, box));
  EXPECT_EQ(plain.expiry().unknown, 1);
  EXPECT_EQ(plain.expiry().queries, 0);
}

}  // namespace
}  // namespace dch
