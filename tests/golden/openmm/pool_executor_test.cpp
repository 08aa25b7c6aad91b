// SPDX-License-Identifier: MIT
//
// OpenMM's threads as the library wants them (dch/executor.hpp), though OpenMM's pool knows one task at a
// time.
#include <atomic>
#include <gtest/gtest.h>
#include <stdexcept>
#include <thread>
#include <vector>

#include "PoolExecutor.h"

namespace OpenMMDCH {
namespace {

TEST(PoolExecutorTest, ServesSeveralThreadsAndPartsThatCallIt) {
  OpenMM::ThreadPool pool(3);
  PoolExecutor executor(pool);
  std::atomic<int> innermost{0};
  std::vector<std::thread> callers;
  for (int caller = 0; caller < 3; ++caller)
    callers.emplace_back([&] {
      for (int round = 0; round < 500; ++round)
        executor.run(4, [&](int) { executor.run(3, [&](int) { ++innermost; }); });
    });
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(innermost, 3 * 500 * 4 * 3);
}

TEST(PoolExecutorTest, ThrowsWhenAllPartsHaveEndedAndStaysUsable) {
  OpenMM::ThreadPool pool(2);
  PoolExecutor executor(pool);
  for (const int parts : {1, 8}) {
    std::atomic<int> ended{0};
    const auto task = [&](int part) {
      if (part == 0) throw std::runtime_error("part 0");
      ++ended;
    };
    EXPECT_THROW(executor.run(parts, task), std::runtime_error);
    EXPECT_EQ(ended, parts - 1);
    executor.run(8, [&](int) { ++ended; });
    EXPECT_EQ(ended, parts - 1 + 8);
  }
}

}  // namespace
}  // namespace OpenMMDCH
