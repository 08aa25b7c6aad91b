// SPDX-License-Identifier: MIT
//
// A million events of the kinetic DCH, valid after each one, with the edges of the engine for production.
#include <cstdint>
#include <gtest/gtest.h>

#include "kinetic_both.hpp"

namespace dch::kinetic {
namespace {

TEST(KineticHierarchyLong, AMillionEventsAreValid) {
  std::int64_t events = 0;
  for (std::uint64_t k = 0; events < 1000000; ++k) {
    events += check_both({4300000 + k, 20}, 10);
    ASSERT_FALSE(testing::Test::HasFailure());
  }
}

}  // namespace
}  // namespace dch::kinetic
