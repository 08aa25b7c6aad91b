// SPDX-License-Identifier: MIT
//
// The kinetic DCH with the four certificates of the thesis: valid after every event, and with the same edges
// at the same times as the engine for production.
#include <gtest/gtest.h>

#include "effort.hpp"
#include "kinetic_both.hpp"

namespace dch::kinetic {
namespace {

TEST(KineticHierarchy, IsValidAndAgreesWithTheEngineInRandomScenes) {
  std::int64_t events = 0;
  for (int k = 0; k < effort(28); ++k) {
    events += check_both({4200000 + static_cast<std::uint64_t>(k), static_cast<std::size_t>(7 * k % 30)}, 2);
    ASSERT_FALSE(testing::Test::HasFailure());
  }
  EXPECT_GT(events, effort(1200));
}

}  // namespace
}  // namespace dch::kinetic
