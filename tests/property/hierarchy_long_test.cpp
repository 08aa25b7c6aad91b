// SPDX-License-Identifier: MIT
//
// The same statements at full size: minutes for the all-pairs checks, so `scripts/test --long` runs them.
#include <gtest/gtest.h>

#include "shake.hpp"

namespace dch {
namespace {

class HierarchyLong : public ::testing::TestWithParam<scenes::NamedBox> {};

// In triclinic boxes a nearest image costs the checks some ten times as much: up to an hour each.
TEST_P(HierarchyLong, ThousandsOfPointsStayValidForTwoHundredSteps) {
  const Box box = GetParam().box;
  for (const double factor : {0.01, 1.0, 30.0})
    ASSERT_NO_FATAL_FAILURE(
        shake(scenes::uniform_in(box, 5000, 3), box, repairing(), factor * r0(repairing()), 200, 8));
}

INSTANTIATE_TEST_SUITE_P(Boxes, HierarchyLong, ::testing::ValuesIn(scenes::all_boxes(12.0)),
                         [](const auto& p) { return p.param.name; });

}  // namespace
}  // namespace dch
