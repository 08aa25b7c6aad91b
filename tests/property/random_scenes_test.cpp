// SPDX-License-Identifier: MIT
//
// Lists of scenes in which everything is random: box, points, sizes, exclusions, ghosts, threads, instruction
// set, policy. `scripts/test --long` makes ten thousand of them (random_scenes_long_test.cpp).
#include <gtest/gtest.h>

#include "effort.hpp"
#include "random_scene.hpp"

namespace dch {
namespace {

TEST(RandomScenes, ListsEqualTheOracle) {
  for (int k = 0; k < effort(200); ++k)
    ASSERT_NO_FATAL_FAILURE(RandomScene(1000000 + static_cast<std::uint64_t>(k)).check());
}

}  // namespace
}  // namespace dch
