// SPDX-License-Identifier: MIT
//
// The threads that kernels of a Context share.
#include <atomic>
#include <gtest/gtest.h>

#include "ContextThreads.h"

namespace OpenMMDCH {
namespace {

TEST(ContextThreadsTest, AreAsManyAsThePoolHasAndTheSameForAllWhoHoldThem) {
  OpenMM::ThreadPool pool(3), other(2);
  const auto threads = threadsBeside(pool);
  EXPECT_EQ(threads->threads(), 3);
  EXPECT_EQ(threadsBeside(pool), threads);
  EXPECT_NE(threadsBeside(other), threads);
  EXPECT_EQ(threadsBeside(other)->threads(), 2);
  std::atomic<int> sum{0};
  threads->run(7, [&](int part) { sum += part; });
  EXPECT_EQ(sum, 21);
}

TEST(ContextThreadsTest, EndWithTheLastWhoHoldsThem) {
  OpenMM::ThreadPool pool(2);
  std::weak_ptr<dch::Executor> seen = threadsBeside(pool);
  EXPECT_TRUE(seen.expired());
  const auto threads = threadsBeside(pool);
  EXPECT_EQ(threads->threads(), 2);
}

}  // namespace
}  // namespace OpenMMDCH
