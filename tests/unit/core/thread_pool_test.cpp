// SPDX-License-Identifier: MIT
#include <atomic>
#include <gtest/gtest.h>
#include <stdexcept>
#include <vector>

#include <dch/error.hpp>
#include <dch/executor.hpp>

namespace dch {
namespace {

TEST(ThreadPool, RunsEveryPartOnce) {
  for (const int threads : {1, 2, 5}) {
    const auto pool = make_thread_pool(threads);
    EXPECT_EQ(pool->threads(), threads);
    for (const int parts : {0, 1, 3, 100}) {
      std::vector<std::atomic<int>> calls(static_cast<std::size_t>(parts));
      pool->run(parts, [&](int part) { ++calls[static_cast<std::size_t>(part)]; });
      for (const auto& count : calls) EXPECT_EQ(count, 1);
    }
  }
}

TEST(ThreadPool, ServesManyTasksInARow) {
  const auto pool = make_thread_pool(3);
  std::atomic<int> sum{0};
  for (int task = 0; task < 2000; ++task) pool->run(4, [&](int part) { sum += part; });
  EXPECT_EQ(sum, 2000 * 6);
}

TEST(ThreadPool, ThrowsOnAndStaysUsable) {
  const auto pool = make_thread_pool(2);
  std::atomic<int> ended{0};
  EXPECT_THROW(pool->run(8,
                         [&](int part) {
                           if (part == 3) throw std::runtime_error("part 3");
                           ++ended;
                         }),
               std::runtime_error);
  EXPECT_EQ(ended, 7);
  pool->run(2, [&](int) { ++ended; });
  EXPECT_EQ(ended, 9);
}

TEST(ThreadPool, RefusesNumbersOutOfRange) {
  EXPECT_THROW(make_thread_pool(0), InvalidParameter);
  EXPECT_THROW(make_thread_pool(-2), InvalidParameter);
  EXPECT_THROW(make_thread_pool(5000), InvalidParameter);
}

}  // namespace
}  // namespace dch
