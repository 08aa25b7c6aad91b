// SPDX-License-Identifier: MIT
//
// Ten thousand scenes in which everything is random.
#include <gtest/gtest.h>

#include "random_scene.hpp"

namespace dch {
namespace {

constexpr std::uint64_t kScenesInTest = 1000;

class RandomScenesLong : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomScenesLong, ListsEqualTheOracle) {
  for (std::uint64_t k = 0; k < kScenesInTest; ++k)
    ASSERT_NO_FATAL_FAILURE(RandomScene(kScenesInTest * GetParam() + k).check());
}

INSTANTIATE_TEST_SUITE_P(Thousands, RandomScenesLong, ::testing::Range<std::uint64_t>(0, 10));

}  // namespace
}  // namespace dch
