// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdio>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <dch/base/error.hpp>
#include <dch/zonotope/gjk.hpp>
#include <dch/zonotope/membership.hpp>
#include <dch/zonotope/order_reduction.hpp>

#include "error_message.hpp"
#include "random.hpp"

namespace dch::zonotope {
namespace {

Zonotope zonotope_in_ball(std::size_t count, std::uint64_t seed, bool is_flat = false) {
  scenes::Random random(seed);
  Zonotope z{random.in_cube(1), {}};
  for (std::size_t k = 0; k < count; ++k) {
    Vec3 v = random.in_ball(1);
    if (is_flat) v.z = v.x + v.y;
    z.generators.push_back(v);
  }
  return z;
}

TEST(OrderReduction, TakesAboutTenGeneratorsOverEpsilonSquared) {
  const Zonotope z = zonotope_in_ball(20000, 41);
  for (const double epsilon : {0.4, 0.2, 0.1}) {
    const Approximation found = approximated(z, epsilon);
    const double constant = static_cast<double>(found.zonotope.generators.size()) * epsilon * epsilon;
    std::printf("epsilon %g: %zu generators, %.1f / epsilon^2\n", epsilon, found.zonotope.generators.size(),
                constant);
    EXPECT_LT(constant, 15);
    EXPECT_LE(found.distance, epsilon * found.diameter);
    scenes::Random random(42);
    for (int k = 0; k < 200; ++k) {
      const Vec3 direction = random.in_ball(1);
      const double of_all = support(z, direction), of_few = support(found.zonotope, direction);
      EXPECT_GE(of_few, of_all - 1e-9);
      EXPECT_LE(of_few, of_all + found.distance * std::sqrt(norm2(direction)) + 1e-9);
      EXPECT_LE(found.diameter, 2 * std::sqrt(3) * support({{}, z.generators}, {1, 0, 0}));
    }
  }
}

TEST(OrderReduction, EnclosesWithoutRounding) {
  for (const bool is_flat : {false, true})
    for (int n = 0; n < 12; ++n) {
      const Zonotope z = zonotope_in_ball(60, 50 + static_cast<std::uint64_t>(n), is_flat);
      const Approximation found = approximated(z, 0.9);
      EXPECT_LT(found.zonotope.generators.size(), 60u);
      EXPECT_TRUE(encloses(found.zonotope, z));
      for (const std::size_t most : {3, 5, 20}) {
        const Zonotope few = reduced(z, most);
        EXPECT_LE(few.generators.size(), most);
        EXPECT_TRUE(encloses(few, z)) << n << ", to " << most;
      }
    }
}

TEST(OrderReduction, ABoxAlongSingularVectorsFitsAnInclinedPlate) {
  const Zonotope plate = zonotope_in_ball(40, 60, true);
  const Zonotope box = reduced(plate, 3);
  EXPECT_LT(volume(box), 1e-6) << "along the axes it would be as thick as wide";
}

TEST(OrderReduction, LeavesFewGeneratorsAsTheyAre) {
  const Zonotope z = zonotope_in_ball(4, 61);
  EXPECT_EQ(approximated(z, 0.1).zonotope.generators, z.generators);
  EXPECT_EQ(approximated(z, 0.1).distance, 0);
  EXPECT_EQ(reduced(z, 4).generators.size(), 4u);
  EXPECT_TRUE(reduced({{1, 2, 3}, {}}, 3).generators.empty());
}

TEST(OrderReduction, RefusesWhatIsOutOfRange) {
  EXPECT_THAT(test::message_of<InvalidParameter>([] { approximated({}, 0); }),
              ::testing::HasSubstr("epsilon = 0"));
  EXPECT_THAT(test::message_of<InvalidParameter>([] { reduced({}, 2); }),
              ::testing::HasSubstr("2 generators"));
  EXPECT_THROW(reduced({{NAN, 0, 0}, {}}, 3), InvalidPosition);
  EXPECT_THROW(approximated({{NAN, 0, 0}, {}}, 0.5), InvalidPosition);
}

}  // namespace
}  // namespace dch::zonotope
