// SPDX-License-Identifier: MIT
//
// Cell vectors along negative axes, as left-handed cells have them: every engine lists what the oracle does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

#include <dch/engines/pair_search.hpp>
#include <dch/lists/all_pairs.hpp>

#include "list_compare.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

class NegativeAxes : public testing::TestWithParam<std::string> {};

TEST_P(NegativeAxes, GiveTheListsOfTheOracle) {
  for (int signs = 0; signs < 8; ++signs) {
    for (int open = 0; open < 7; ++open) {
      const auto sign = [&](int axis) { return (signs >> axis & 1) != 0 ? -1.0 : 1.0; };
      const auto is_periodic = [&](int axis) { return (open >> axis & 1) == 0; };
      const Box box = Box::triclinic({6 * sign(0), 0, 0}, {0, 3.3 * sign(1), 0}, {0, 0, 2.2 * sign(2)},
                                     {is_periodic(0), is_periodic(1), is_periodic(2)});
      const auto points = scenes::uniform_in(box, 80, 5);
      ListParams params;
      params.cutoffs = TypeCutoffs(0.5);
      HierarchyParams engine;
      engine.radius = 0.5;
      const auto search = make_search(GetParam(), engine);
      search->update(points, box);
      ASSERT_EQ(first_difference(search->list(params), all_pairs(points, box, params)), "")
          << "signs " << signs << ", open axes " << open;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, NegativeAxes, testing::Values("dch", "grid", "cell", "auto"),
                         [](const auto& engine) { return engine.param; });

}  // namespace
}  // namespace dch
