// SPDX-License-Identifier: MIT
//
// Positions that stay with the caller give the lists that copied ones give, and take no memory in the grid.
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include <dch/engines/pair_search.hpp>
#include <dch/lists/all_pairs.hpp>

#include "list_compare.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

constexpr std::size_t kPoints = 3000;

class UpdateByReference : public testing::TestWithParam<const char*> {
 protected:
  const Box box_ = Box::triclinic({9, 0, 0}, {4, 9, 0}, {3, -4, 9});
  std::unique_ptr<PairSearch> search_ = make_search(GetParam(), {1});
  std::vector<Vec3> points_ = scenes::uniform_in(box_, kPoints, 1);

  void expect_pairs_of(const std::vector<Vec3>& points, const char* when) {
    ListParams request;
    request.cutoffs = TypeCutoffs(1);
    EXPECT_EQ(first_difference(search_->list(request), all_pairs(points, box_, request)), "") << when;
  }
};

TEST_P(UpdateByReference, GivesTheSameLists) {
  const std::vector<Vec3> copied = scenes::uniform_in(box_, kPoints, 2);
  search_->update_by_reference(points_, box_);
  expect_pairs_of(points_, "first");
  search_->update(copied, box_);
  const std::vector<Vec3> before = points_;
  points_ = scenes::uniform_in(box_, kPoints, 3);  // nobody looks at them now
  expect_pairs_of(copied, "after a copy");
  search_->update_by_reference(points_, box_);
  expect_pairs_of(points_, "with others in the same place");
  points_ = before;
  points_.resize(kPoints / 2);
  search_->update_by_reference(points_, box_);
  expect_pairs_of(points_, "with fewer");
}

TEST_P(UpdateByReference, HasNoCopyInTheGrid) {
  const auto bytes = [&](bool by_reference) {
    const auto search = make_search(GetParam(), {1});
    by_reference ? search->update_by_reference(points_, box_) : search->update(points_, box_);
    ListParams request;
    request.cutoffs = TypeCutoffs(1);
    search->list(request);
    return search->stats().memory_bytes;
  };
  const bool is_grid = search_->name() == "grid" || search_->name() == "auto";  // which chooses the grid here
  EXPECT_EQ(bytes(false) - bytes(true), is_grid ? kPoints * sizeof(Vec3) : 0);
}

INSTANTIATE_TEST_SUITE_P(Engines, UpdateByReference, testing::Values("grid", "auto", "dch", "cell"),
                         [](const auto& named) { return std::string(named.param); });

}  // namespace
}  // namespace dch
