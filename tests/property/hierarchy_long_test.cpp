// SPDX-License-Identifier: MIT
//
// The same statements at full size: minutes for the all-pairs checks, so `scripts/test --long` runs them.
#include <gtest/gtest.h>

#include "shake.hpp"

namespace dch {
namespace {

class HierarchyLong : public ::testing::TestWithParam<scenes::NamedBox> {};

TEST_P(HierarchyLong, FiveThousandPointsStayValidForTwoHundredSteps) {
  const Box box = GetParam().box;
  for (const double factor : {0.01, 1.0, 30.0})
    ASSERT_NO_FATAL_FAILURE(
        shake(scenes::uniform_in(box, 5000, 3), box, repairing(), factor * r0(repairing()), 200, 8));
}

INSTANTIATE_TEST_SUITE_P(Boxes, HierarchyLong, ::testing::ValuesIn(scenes::all_boxes(17.0)),
                         [](const auto& p) { return p.param.name; });

}  // namespace
}  // namespace dch
