// SPDX-License-Identifier: MIT
#include <atomic>
#include <gmock/gmock.h>
#include <latch>
#include <stdexcept>
#include <string>
#include <sys/resource.h>
#include <thread>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/base/executor.hpp>

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

// What a part has written is then in the cache of the thread that has it next time.
TEST(ThreadPool, GivesThePartsOfAThreadToItAgain) {
  const auto pool = make_thread_pool(3);
  std::vector<std::thread::id> first;
  for (int round = 0; round < 200; ++round) {
    std::vector<std::thread::id> by(6);
    std::latch all_at_work(3);
    pool->run(6, [&](int part) {
      by[static_cast<std::size_t>(part)] = std::this_thread::get_id();
      if (part % 2 == 0) all_at_work.arrive_and_wait();
    });
    ASSERT_EQ(by[0], std::this_thread::get_id());
    if (round == 0) first = by;
    for (const std::size_t part : {0, 2, 4})
      ASSERT_EQ(by[part], first[part]) << "round " << round << ", part " << part;
  }
}

// The first part takes as long as all others, which the other thread runs then.
TEST(ThreadPool, ThreadsThatHaveDoneTheirPartsHelpOthers) {
  const auto pool = make_thread_pool(2);
  std::latch others(9);
  pool->run(10, [&](int part) {
    if (part == 0) {
      others.wait();
    } else {
      others.count_down();
    }
  });
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

/// Calls f(k) on `callers` threads of their own at once.
template <class F>
void on_threads(int callers, const F& f) {
  std::latch all_are_there(callers);
  std::vector<std::thread> threads;
  for (int k = 0; k < callers; ++k)
    threads.emplace_back([&, k] {
      all_are_there.arrive_and_wait();
      f(k);
    });
  for (std::thread& thread : threads) thread.join();
}

TEST(ThreadPool, ServesSeveralCallersAtOnce) {
  for (const int threads : {1, 2, 4}) {
    const auto pool = make_thread_pool(threads);
    std::atomic<int> wrong{0};
    on_threads(3, [&](int caller) {
      for (int round = 0; round < 2000; ++round) {
        std::vector<int> calls(static_cast<std::size_t>(1 + (round + caller) % 7), 0);
        pool->run(static_cast<int>(calls.size()), [&](int part) {
          if (part % 3 == 1) std::this_thread::yield();
          ++calls[static_cast<std::size_t>(part)];
        });
        wrong += calls != std::vector<int>(calls.size(), 1);
      }
    });
    EXPECT_EQ(wrong, 0) << threads << " threads";
  }
}

TEST(ThreadPool, ServesPartsThatCallIt) {
  for (const int threads : {1, 2, 4}) {
    const auto pool = make_thread_pool(threads);
    for (int round = 0; round < 2000; ++round) {
      std::atomic<int> innermost{0};
      pool->run(4, [&](int) { pool->run(3, [&](int) { pool->run(2, [&](int) { ++innermost; }); }); });
      ASSERT_EQ(innermost, 4 * 3 * 2) << threads << " threads, round " << round;
    }
  }
}

TEST(ThreadPool, ServesCallersWhosePartsCallIt) {
  const auto pool = make_thread_pool(3);
  std::atomic<int> wrong{0};
  on_threads(3, [&](int) {
    for (int round = 0; round < 300; ++round) {
      std::atomic<int> inner{0};
      pool->run(3, [&](int) { pool->run(3, [&](int) { ++inner; }); });
      wrong += inner != 9;
    }
  });
  EXPECT_EQ(wrong, 0);
}

TEST(ThreadPool, ThrowsToTheCallerWhosePartThrew) {
  const auto pool = make_thread_pool(3);
  std::atomic<int> wrong{0};
  on_threads(3, [&](int caller) {
    for (int round = 0; round < 500; ++round) {
      const bool throws = (round + caller) % 2 == 0;
      int caught = -1;
      std::atomic<int> ended{0};
      try {
        pool->run(5, [&](int part) {
          if (throws && part == 2) throw caller;
          ++ended;
        });
      } catch (int from) {
        caught = from;
      }
      wrong += caught != (throws ? caller : -1) || ended != (throws ? 4 : 5);
    }
  });
  EXPECT_EQ(wrong, 0);
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
