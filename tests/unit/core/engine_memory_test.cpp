// SPDX-License-Identifier: MIT
//
// What engines hold beyond the list, and how much more memory than it needs a list takes.
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include <dch/engines/pair_search.hpp>

#include "random.hpp"

namespace dch {
namespace {

constexpr int kSide = 32;
constexpr double kRadius = 2.8, kDensity = 0.8442;

class EngineMemory : public testing::TestWithParam<const char*> {
 protected:
  EngineMemory() {
    for (int k = 0; k < kSide * kSide * kSide; ++k)
      points_.push_back(width_ / kSide *
                        Vec3{1.0 * (k % kSide), 1.0 * (k / kSide % kSide), 1.0 * (k / kSide / kSide)});
    move(0.3);
  }
  void move(double far) {
    for (Vec3& p : points_) p = p + random_.in_cube(far);
  }
  void list() {
    search_->update(points_, box_);
    search_->list(request_, list_);
  }

  double width_ = kSide / std::cbrt(kDensity);
  Box box_ = Box::orthorhombic({width_, width_, width_});
  scenes::Random random_{7};
  std::vector<Vec3> points_;
  std::unique_ptr<PairSearch> search_ = make_search(GetParam(), {kRadius, MaintenancePolicy::always_repair});
  ListParams request_ = [] {
    ListParams params;
    params.cutoffs = TypeCutoffs(kRadius);
    params.order = RowOrder::unsorted;
    return params;
  }();
  NeighborList list_;
};

// Positions that are copied are 24 of them.
TEST_P(EngineMemory, IsAtMostSixtyBytesAnAtom) {
  const auto bytes = [&] {
    return static_cast<double>(search_->stats().memory_bytes) / static_cast<double>(points_.size());
  };
  list();
  EXPECT_LE(bytes(), 58);
  for (int step = 0; step < 20; ++step) {
    move(0.15);
    list();
  }
  if (search_->name() == "dch") {
    EXPECT_GT(search_->stats().repairs, 3);
  }
  EXPECT_LE(bytes(), 60);
}

// What is reserved beyond the end was never written to, so the system has not given it.
TEST_P(EngineMemory, OfAListIsLittleMoreThanItsPairs) {
  list();
  EXPECT_LE(static_cast<double>(list_.j.size()), 1.1 * static_cast<double>(list_.first.back()));
  EXPECT_LE(static_cast<double>(list_.j.capacity()), 1.3 * static_cast<double>(list_.first.back()));
}

INSTANTIATE_TEST_SUITE_P(Engines, EngineMemory, testing::Values("dch", "grid"),
                         [](const auto& engine) { return std::string(engine.param); });

}  // namespace
}  // namespace dch
