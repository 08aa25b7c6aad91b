// SPDX-License-Identifier: MIT
//
// Pairs over all images that memory did not suffice for: what is handed in stays as it was.
#include <dch/engines/neighbor_pairs.hpp>

#include "scene.hpp"

namespace dch::faults {
namespace {

class NeighborPairsFaults : public testing::TestWithParam<double> {
 protected:
  NeighborPairsFaults() : box_(Box::triclinic({3, 0, 0}, {1, 3, 0}, {0, -1, 3})) {
    points_ = scenes::uniform_in(box_, 60, 3);
    params_.cutoffs = TypeCutoffs(GetParam());
    params_.skin = 0.2;
    expected_ = neighbor_pairs(points_, box_, params_).listed();
  }

  Box box_;
  std::vector<Vec3> points_;
  NeighborPairsParams params_;
  std::int64_t expected_ = 0;
};

TEST_P(NeighborPairsFaults, LeaveWhatWas) {
  expect_sound(sweep([] { return NeighborPairs(); },
                     [&](NeighborPairs& pairs) { neighbor_pairs(points_, box_, params_, pairs); },
                     [&](const NeighborPairs& pairs, Ending ending) -> std::string {
                       const std::int64_t right = ending == Ending::returned ? expected_ : 0;
                       return pairs.listed() == right ? "" : "it holds " + std::to_string(pairs.listed());
                     }),
               20);
}

TEST_P(NeighborPairsFaults, FollowOrStay) {
  std::vector<Vec3> wrapped = points_;
  for (Vec3& p : wrapped) p = p + box_.vector(1);
  wrapped[7] = points_[7];
  expect_sound(sweep([&] { return neighbor_pairs(points_, box_, params_); },
                     [&](NeighborPairs& pairs) { pairs.follow(wrapped, box_); },
                     [&](const NeighborPairs& pairs, Ending ending) -> std::string {
                       const std::vector<Vec3>& now = ending == Ending::returned ? wrapped : points_;
                       std::string fault;
                       pairs.for_each_in_row(7, now, [&](std::int32_t, const NeighborPairs::Shift&, Vec3 d) {
                         if (norm2(d) > GetParam() * GetParam()) fault = "a pair is too far apart";
                       });
                       return fault;
                     }),
               1);
}

INSTANTIATE_TEST_SUITE_P(Cutoffs, NeighborPairsFaults, testing::Values(0.9, 2.0),
                         [](const auto& cutoff) { return cutoff.param < 1 ? "Direct" : "ManyImages"; });

}  // namespace
}  // namespace dch::faults
