// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <vector>

#include <dch/zonotope/membership.hpp>

#include "effort.hpp"
#include "zonotope_oracle.hpp"
#include "zonotope_scenes.hpp"

namespace dch::zonotope {
namespace {

using scenes::GeneratorKind;

constexpr int kBits = 40;
constexpr double kGap = 0x1p-40;  // 9.1e-13

/// A point anywhere, or on the boundary, or one step of the grid beside it.
Vec3 some_point(scenes::Random& random, const std::vector<Vec3>& u, int kind) {
  if (kind % 4 == 0) return scenes::on_grid(random.in_cube(2), kBits);
  Vec3 point = scenes::boundary_point(random, u);
  if (kind % 4 == 1) return point;
  const Vec3 steps{static_cast<double>(static_cast<int>(random.below(3)) - 1),
                   static_cast<double>(static_cast<int>(random.below(3)) - 1),
                   static_cast<double>(static_cast<int>(random.below(3)) - 1)};
  return point + kGap * steps;
}

/// The same zonotope by more generators than separating axes are tried for.
Zonotope of_many_parts(Vec3 center, const std::vector<Vec3>& u) {
  Zonotope z{center, {}};
  const int parts = u.size() < 5 ? 32 : 4;
  for (const Vec3& v : u)
    z.generators.insert(z.generators.end(), static_cast<std::size_t>(parts), 1.0 / parts * v);
  return z;
}

struct Answers {
  int right = 0, inside = 0, boundary = 0, outside = 0;
};

TEST(ZonotopeMembership, AHundredThousandAnswersAreThoseOfIntegers) {
  constexpr std::uint64_t kSeed = 11;
  scenes::Random random(kSeed);
  Answers seen;
  MembershipStats stats;
  const int zonotopes = effort(2000), points = 50;
  int wrong = 0;
  for (int n = 0; n < zonotopes; ++n) {
    const auto kind = static_cast<GeneratorKind>(n % static_cast<int>(GeneratorKind::count));
    const std::vector<Vec3> u = scenes::grid_generators(random, kind, 1 + random.below(8));
    const oracle::ZonotopeOracle oracle(u, kBits);
    for (int k = 0; k < points; ++k) {
      const Vec3 point = some_point(random, u, k), center = scenes::on_grid(random.in_cube(4), kBits);
      const int side = oracle.side(oracle::scaled(point, kBits));
      ++(side > 0 ? seen.inside : side == 0 ? seen.boundary : seen.outside);
      const Method method = k % 2 == 0   ? Method::automatic
                            : k % 8 == 1 ? Method::exact
                                         : Method::point_location;
      const bool inside = k % 10 == 4 ? contains(of_many_parts(center, u), center + point, method, &stats)
                          : k % 3 == 0
                              ? contains({center, u}, center + point, method, &stats)
                              : intersect({center, {u.begin(), u.begin() + 1}},
                                          {center + point, {u.begin() + 1, u.end()}}, method, &stats);
      wrong += inside != (side >= 0);
      if (inside != (side >= 0) && wrong < 5)
        ADD_FAILURE() << "seed " << kSeed << ", zonotope " << n << " of kind " << n % 8 << ", point " << k;
    }
  }
  std::printf(
      "%d in the interior, %d on the boundary, %d outside; by axes %ld, by GJK %ld, by point location %ld, "
      "exact "
      "%ld\n",
      seen.inside, seen.boundary, seen.outside, long(stats.by_axes), long(stats.by_gjk),
      long(stats.by_point_location), long(stats.exact));
  EXPECT_EQ(wrong, 0);
  for (const std::int64_t by_one : {stats.by_axes, stats.by_gjk, stats.by_point_location, stats.exact})
    EXPECT_GT(by_one, zonotopes * points / 100) << "a way is hardly tried";
  EXPECT_GT(std::min({seen.inside, seen.boundary, seen.outside}), zonotopes * points / 10);
}

}  // namespace
}  // namespace dch::zonotope
