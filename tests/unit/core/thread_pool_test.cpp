// SPDX-License-Identifier: MIT
#include <atomic>
#include <gmock/gmock.h>
#include <stdexcept>
#include <string>
#include <sys/resource.h>
#include <vector>

#include <dch/error.hpp>
#include <dch/executor.hpp>

#include "error_message.hpp"

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

#if !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)  // which reserve terabytes themselves
TEST(ThreadPool, SaysHowManyThreadsThereAreIfNotEnough) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  const rlimit little{rlim_t{2} << 30, before.rlim_max};  // the stacks of some 200 threads
  ASSERT_EQ(setrlimit(RLIMIT_AS, &little), 0);
  const std::string message = test::message_of<Error>([] { make_thread_pool(4096); });
  ASSERT_EQ(setrlimit(RLIMIT_AS, &before), 0);
  EXPECT_THAT(message, testing::HasSubstr("of a pool of 4096 threads only "));
  EXPECT_THAT(message, testing::HasSubstr("choose fewer"));
}
#endif

}  // namespace
}  // namespace dch
