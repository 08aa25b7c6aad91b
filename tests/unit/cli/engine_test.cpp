// SPDX-License-Identifier: MIT
#include "engines/engine.hpp"

#include <gtest/gtest.h>
#include <ostream>

#include <dch/base/error.hpp>
#include <dch/lists/all_pairs.hpp>

#include "list_compare.hpp"
#include "small_scene.hpp"

namespace dch::cli {

inline std::ostream& operator<<(std::ostream& out, EngineKind kind) { return out << to_string(kind); }

namespace {

class Engines : public testing::TestWithParam<EngineKind> {
 protected:
  Engine engine(double radius) const {
    EngineOptions options;
    options.kind = GetParam();
    return make_engine(options, radius);
  }
};
INSTANTIATE_TEST_SUITE_P(All, Engines,
                         testing::Values(EngineKind::dch, EngineKind::grid, EngineKind::automatic,
                                         EngineKind::cell, EngineKind::allpairs),
                         [](const auto& scene) { return to_string(scene.param); });

TEST_P(Engines, FollowMotionAndGiveTheOraclesLists) {
  const Engine engine = this->engine(2.5);
  EXPECT_EQ(engine.search->name(), to_string(GetParam()));
  EXPECT_EQ(engine.keeps_hierarchy, may_keep_hierarchy(GetParam()));
  ListParams params;
  params.cutoffs = TypeCutoffs(2.5);
  trajectory::Frame frame = random_frame(300);
  scenes::Random random(5);
  for (int step = 0; step < 5; ++step) {
    engine.search->update(frame.positions, frame.box);
    EXPECT_EQ(first_difference(engine.search->list(params), all_pairs(frame.positions, frame.box, params)),
              "");
    for (Vec3& position : frame.positions) position = position + random.in_ball(0.3);
  }
  const SearchStats& stats = engine.search->stats();
  EXPECT_EQ(stats.builds + stats.repairs + stats.refreshes, 5);
  EXPECT_EQ(engine.search->choice().empty(), GetParam() != EngineKind::automatic);
  EXPECT_GT(stats.list_seconds, 0);
  EXPECT_GT(stats.maintain_seconds, 0);
}

/// Two threads by name; it counts the tasks that it is given, and calls their parts one by one.
class CountingExecutor final : public Executor {
 public:
  explicit CountingExecutor(int& runs) : runs_(runs) {}
  int threads() const override { return 2; }
  void run(int parts, const std::function<void(int)>& task) override {
    ++runs_;
    for (int part = 0; part < parts; ++part) task(part);
  }

 private:
  int& runs_;
};

TEST(DchEngine, WorksWithTheThreadsItIsGiven) {
  int runs = 0;
  const Engine engine = make_engine(EngineOptions(), 2.5, std::make_unique<CountingExecutor>(runs));
  const trajectory::Frame frame = random_frame(3000);
  engine.search->update(frame.positions, frame.box);
  ListParams params;
  params.cutoffs = TypeCutoffs(2.5);
  const NeighborList list = engine.search->list(params);
  EXPECT_GT(runs, 0);
  EXPECT_EQ(first_difference(list, all_pairs(frame.positions, frame.box, params)), "");
  ASSERT_NE(engine.threads, nullptr);
  EXPECT_EQ(engine.threads->threads(), 2);
}

TEST_P(Engines, TakeAnotherNumberOfAtomsAndNoneAtAll) {
  const Engine engine = this->engine(1);
  for (const std::size_t n : {20, 50, 0, 10}) {
    const trajectory::Frame frame = random_frame(n);
    engine.search->update(frame.positions, frame.box);
    EXPECT_EQ(engine.search->list(ListParams()).size(), n);
  }
}

TEST_P(Engines, RefuseACutoffBeyondHalfTheBox) {
  const Engine engine = this->engine(6);
  const trajectory::Frame frame = random_frame(20);
  ListParams params;
  params.cutoffs = TypeCutoffs(6);
  EXPECT_THROW(
      {
        engine.search->update(frame.positions, frame.box);
        engine.search->list(params);
      },
      CutoffTooLarge);
}

}  // namespace
}  // namespace dch::cli
