// SPDX-License-Identifier: MIT
//
// A host's own threads: an executor over OpenMP is a few lines, and gives the lists that a pool gives. Not
// under the thread sanitizer, which does not know the locks of GCC's OpenMP runtime.
#include <atomic>
#include <exception>
#include <gtest/gtest.h>
#include <omp.h>
#include <stdexcept>
#include <thread>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/lists/all_pairs.hpp>

#include "list_compare.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

/// Each thread that calls run() has a team of its own. Parts that call it have the thread that they are on:
/// by default OpenMP opens no parallel region within another.
class OpenMpExecutor final : public Executor {
 public:
  explicit OpenMpExecutor(int threads) : threads_(threads) {}
  int threads() const override { return threads_; }
  void run(int parts, const std::function<void(int)>& task) override {
    std::exception_ptr error;
#pragma omp parallel for num_threads(threads_) schedule(dynamic)
    for (int part = 0; part < parts; ++part) {
      try {
        task(part);
      } catch (...) {
#pragma omp critical
        error = std::current_exception();
      }
    }
    if (error) std::rethrow_exception(error);
  }

 private:
  int threads_;
};

TEST(OpenMpExecutorTest, GivesTheListsOfOneThread) {
  const Box box = Box::orthorhombic({9, 10, 11});
  const std::vector<Vec3> points = scenes::uniform_in(box, 3000, 1);
  ListParams request;
  request.cutoffs = TypeCutoffs(1.0);
  for (const int threads : {1, 2, 4}) {
    OpenMpExecutor executor(threads);
    HierarchyParams params;
    params.radius = 1.0;
    params.executor = &executor;
    const auto search = make_dch_search(params);
    scenes::Random random(2);
    std::vector<Vec3> moved = points;
    for (int step = 0; step < 5; ++step) {
      search->update(moved, box);
      ASSERT_EQ(first_difference(search->list(request), all_pairs(moved, box, request)), "")
          << threads << " threads, step " << step;
      for (Vec3& p : moved) p = p + random.in_cube(0.2);
    }
  }
}

TEST(OpenMpExecutorTest, ServesSeveralThreadsAndPartsThatCallIt) {
  OpenMpExecutor executor(3);
  std::atomic<int> innermost{0};
  std::vector<std::thread> callers;
  for (int caller = 0; caller < 3; ++caller)
    callers.emplace_back([&] {
      for (int round = 0; round < 100; ++round)
        executor.run(4, [&](int) { executor.run(3, [&](int) { ++innermost; }); });
    });
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(innermost, 3 * 100 * 4 * 3);
}

TEST(OpenMpExecutorTest, HandsOnWhatATaskThrows) {
  OpenMpExecutor executor(2);
  EXPECT_THROW(executor.run(4,
                            [](int part) {
                              if (part == 3) throw std::runtime_error("part 3");
                            }),
               std::runtime_error);
}

}  // namespace
}  // namespace dch
