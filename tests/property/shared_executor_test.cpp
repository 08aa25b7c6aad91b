// SPDX-License-Identifier: MIT
//
// Hosts that lend one set of threads to several objects, each used by a thread of its own.
#include <atomic>
#include <gtest/gtest.h>
#include <string>
#include <thread>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/forces/lennard_jones.hpp>
#include <dch/lists/all_pairs.hpp>

#include "effort.hpp"
#include "list_compare.hpp"
#include "listed_hierarchy.hpp"
#include "random.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

constexpr double kCutoff = 1.0;

/// A scene with its list, and what searches it on an executor that others use too.
class Searcher {
 public:
  Searcher(Executor& executor, std::uint64_t seed) : points_(scenes::uniform_in(box_, 150, seed)) {
    request_.cutoffs = TypeCutoffs(kCutoff);
    expected_ = all_pairs(points_, box_, request_);
    HierarchyParams params;
    params.radius = kCutoff;
    params.executor = &executor;
    search_ = make_dch_search(params);
  }

  /// Empty, or what is wrong with the list.
  std::string search() {
    search_->update(points_, box_);
    return first_difference(search_->list(request_), expected_);
  }

 private:
  Box box_ = Box::orthorhombic({4, 5, 4.5});
  std::vector<Vec3> points_;
  ListParams request_;
  NeighborList expected_;
  std::unique_ptr<PairSearch> search_;
};

TEST(SharedExecutor, GivesEachThreadItsWholeList) {
  for (const int threads : {2, 3}) {
    const auto pool = make_thread_pool(threads);
    std::vector<Searcher> searchers;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) searchers.emplace_back(*pool, seed);
    std::vector<std::string> wrong(searchers.size());
    std::vector<std::thread> users;
    for (std::size_t k = 0; k < searchers.size(); ++k)
      users.emplace_back([&, k] {
        for (int round = 0; round < effort(1000) && wrong[k].empty(); ++round)
          wrong[k] = searchers[k].search();
      });
    for (std::thread& user : users) user.join();
    for (const std::string& difference : wrong) EXPECT_EQ(difference, "") << threads << " threads";
  }
}

TEST(SharedExecutor, ThreadsMakeListsWithinItsParts) {
  const auto pool = make_thread_pool(3);
  std::vector<Searcher> searchers;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) searchers.emplace_back(*pool, seed);
  std::vector<std::string> wrong(searchers.size());
  for (int round = 0; round < 100; ++round)
    pool->run(static_cast<int>(searchers.size()), [&](int part) {
      const auto k = static_cast<std::size_t>(part);
      if (wrong[k].empty()) wrong[k] = searchers[k].search();
    });
  for (const std::string& difference : wrong) EXPECT_EQ(difference, "");
}

/// The parts of these wait for each other.
TEST(SharedExecutor, ThreadsSumUpForcesSideBySide) {
  const Box box = Box::orthorhombic({24, 24, 24});
  scenes::Random random(5);
  std::vector<Vec3> points;
  for (int k = 0; k < 24 * 24 * 24; ++k)
    points.push_back(Vec3{k % 24 + 0.0, k / 24 % 24 + 0.0, k / 576 + 0.0} + random.in_ball(0.1));
  ListParams request;
  request.cutoffs = TypeCutoffs(1.5);
  HierarchyParams params;
  params.radius = 1.5;
  ListedHierarchy hierarchy(params);
  hierarchy.build(points, box);
  ClusterPairs pairs;
  hierarchy.cluster_pairs(request, pairs);
  ASSERT_GE(pairs.tasks.size(), 4u);
  const auto forces_on = [&](Executor* executor) {
    LennardJones potential({1, 0.9, 1.5});
    potential.set_executor(executor);
    std::vector<Vec3> forces(points.size());
    for (int round = 0; round < 5; ++round)
      potential.add_forces(pairs, ForcePrecision::double_precision, forces);
    return forces;
  };
  const std::vector<Vec3> expected = forces_on(nullptr);
  const auto pool = make_thread_pool(4);
  std::vector<std::vector<Vec3>> found(3);
  std::vector<std::thread> users;
  for (auto& forces : found) users.emplace_back([&] { forces = forces_on(pool.get()); });
  for (std::thread& user : users) user.join();
  for (const auto& forces : found) EXPECT_EQ(forces, expected);
}

}  // namespace
}  // namespace dch
