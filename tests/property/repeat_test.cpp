// SPDX-License-Identifier: MIT
//
// The same updates give the same structure, lists, cluster pairs and choice of engine, whatever else the
// machine does meanwhile, on any number of threads and any instruction set.
#include <algorithm>
#include <chrono>
#include <gtest/gtest.h>
#include <string>
#include <thread>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/engines/pair_search.hpp>

#include "instruction_sets.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

constexpr double kRadius = 1.0;
constexpr int kUpdates = 12;

/// All that a search gave and did.
struct Outcome {
  std::vector<std::int64_t> work;  ///< after each update
  std::vector<NeighborList> lists;
  std::vector<ClusterPairs> pairs;
  std::vector<std::string> choices{};  ///< of the engine, each once
};

std::string first_difference(const Outcome& a, const Outcome& b) {
  if (a.work != b.work) return "other work was done";
  if (a.choices != b.choices) return "other engines were chosen";
  for (std::size_t k = 0; k < a.lists.size(); ++k) {
    const NeighborList &p = a.lists[k], &q = b.lists[k];
    if (p.first != q.first || p.particle != q.particle ||
        !std::equal(p.j.begin(), p.j.begin() + p.first.back(), q.j.begin()))  // beyond there may be room
      return "list " + std::to_string(k);
  }
  const auto same_entry = [](const ClusterPairs::Entry& p, const ClusterPairs::Entry& q) {
    return p.cluster == q.cluster && p.mask == q.mask && p.shift == q.shift;
  };
  for (std::size_t k = 0; k < a.pairs.size(); ++k)
    if (a.pairs[k].particle != b.pairs[k].particle ||
        !std::equal(a.pairs[k].entries.begin(), a.pairs[k].entries.end(), b.pairs[k].entries.begin(),
                    b.pairs[k].entries.end(), same_entry))
      return "cluster pairs " + std::to_string(k);
  return "";
}

/// What a run waits for now and then, as if the machine had other things to do.
using Pause = void (*)(int update);
void no_pause(int) {}
void pause_at_times(int update) {
  if (update % 5 == 3) std::this_thread::sleep_for(std::chrono::milliseconds(30));
}

/// Unsorted lists of the grid, which keeps nothing.
std::vector<NeighborList> grid_lists(const Box& box, Executor* executor) {
  const auto search = make_grid_search(kRadius, executor);
  std::vector<Vec3> points = scenes::uniform_in(box, 6000, 5);
  scenes::Random random(7);
  ListParams request;
  request.cutoffs = TypeCutoffs(0.9);
  request.skin = 0.1;
  request.order = RowOrder::unsorted;
  request.shell = 0.1;
  std::vector<NeighborList> lists;
  for (int update = 0; update < 3; ++update) {
    for (Vec3& p : points) p = p + random.in_cube(0.3);
    search->update(points, box);
    lists.push_back(search->list(request));
  }
  return lists;
}

/// Steps of all lengths, so that repairs are put off, done and replaced by builds; with `keys`, particles
/// come and go.
Outcome run(const Box& box, bool keys, Executor* executor, Pause pause) {
  HierarchyParams params;
  params.radius = kRadius;
  params.executor = executor;
  const auto search = make_dch_search(params);
  std::vector<Vec3> points = scenes::uniform_in(box, 6000, 5);
  std::vector<std::uint64_t> names(points.size());
  for (std::size_t k = 0; k < names.size(); ++k) names[k] = k;
  scenes::Random random(6);
  Outcome outcome;
  ListParams request;
  request.cutoffs = TypeCutoffs(kRadius);
  request.order = RowOrder::unsorted;
  for (int update = 0; update < kUpdates; ++update) {
    const double step = update % 4 == 0 ? 0.01 : update % 4 == 1 ? 0.3 : update % 4 == 2 ? 0.7 : 2;
    for (Vec3& p : points) p = p + random.in_cube(step);
    for (std::size_t k = 0; keys && k < points.size(); k += update % 3 == 0 ? 2 : 100)
      names[k] += points.size();
    pause(update);
    search->update(points, box, keys ? Span<const std::uint64_t>(names) : Span<const std::uint64_t>());
    outcome.lists.push_back(search->list(request));
    outcome.pairs.emplace_back();
    search->cluster_pairs(request, outcome.pairs.back());
    const SearchStats& s = search->stats();
    outcome.work.insert(outcome.work.end(), {s.builds, s.repairs, s.refreshes, s.promotions, s.demotions,
                                             s.reparented, s.distances, s.inserted, s.removed});
  }
  EXPECT_GT(search->stats().builds + search->stats().repairs, 3) << "nothing was decided";
  return outcome;
}

/// A liquid that gathers in crowds and spreads again, followed by the engine that chooses.
Outcome run_of_choice(const Box& box, Executor* executor, Pause pause) {
  // Cells of the skewed box hold few points: more of them are needed for a grid to be worth it.
  const bool is_skewed = box.kind() == Box::Kind::triclinic;
  const std::size_t crowds = is_skewed ? 60 : 8, in_each = is_skewed ? 120 : 250;
  constexpr int kUpdatesOfAPhase = 36;  // more than between two looks
  HierarchyParams params;
  params.radius = kRadius;
  params.executor = executor;
  const auto search = make_search("auto", params);
  scenes::Random random(8);
  ListParams request;
  request.cutoffs = TypeCutoffs(kRadius);
  request.order = RowOrder::unsorted;
  const std::vector<Vec3> even = scenes::uniform_in(box, crowds * in_each, 5);
  std::vector<Vec3> crowded;
  while (crowded.size() < even.size())
    crowded.push_back(even[crowded.size() / in_each] + random.in_ball(is_skewed ? 0.4 : 0.2));
  Outcome outcome;
  for (int update = 0; update < 3 * kUpdatesOfAPhase; ++update) {
    std::vector<Vec3> points = update / kUpdatesOfAPhase == 1 ? crowded : even;
    for (Vec3& p : points) p = p + random.in_cube(0.05);
    pause(update);
    search->update(points, box);
    outcome.lists.push_back(search->list(request));
    const SearchStats& s = search->stats();
    outcome.work.insert(outcome.work.end(), {s.builds, s.repairs, s.refreshes, s.distances});
    if (outcome.choices.empty() || outcome.choices.back() != search->choice())
      outcome.choices.push_back(search->choice());
  }
  return outcome;
}

/// The engines alone.
std::string engines_of(const Outcome& outcome) {
  std::string engines, last;
  for (const std::string& choice : outcome.choices) {
    const std::string engine = choice.substr(0, choice.find(':')) + " ";
    if (engine != last) engines += engine;  // the same engine may be chosen anew by other counts
    last = engine;
  }
  return engines;
}

/// One of each metric.
std::vector<scenes::NamedBox> boxes() {
  std::vector<scenes::NamedBox> all;
  for (const scenes::NamedBox& box : scenes::all_boxes(12.0))
    if (box.name == "none" || box.name == "orthorhombic_ppp" || box.name == "triclinic_ppp")
      all.push_back(box);
  return all;
}

class Repeats : public ::testing::TestWithParam<scenes::NamedBox> {};

TEST_P(Repeats, WhateverElseTheMachineDoes) {
  for (const bool keys : {false, true}) {
    const Outcome expected = run(GetParam().box, keys, nullptr, no_pause);
    for (int repeat = 0; repeat < 2; ++repeat)
      EXPECT_EQ(first_difference(expected, run(GetParam().box, keys, nullptr, pause_at_times)), "");
  }
}

TEST_P(Repeats, OnAnyNumberOfThreads) {
  for (const bool keys : {false, true}) {
    const Outcome expected = run(GetParam().box, keys, nullptr, no_pause);
    for (const int threads : {2, 5}) {
      const auto pool = make_thread_pool(threads);
      EXPECT_EQ(first_difference(expected, run(GetParam().box, keys, pool.get(), no_pause)), "")
          << threads << " threads";
    }
  }
}

TEST_P(Repeats, WithAnyInstructionSet) {
  const RestoreInstructionSet restore;
  const Outcome expected = run(GetParam().box, true, nullptr, no_pause);
  for (const InstructionSet set : supported_sets()) {
    set_instruction_set(set);
    EXPECT_EQ(first_difference(expected, run(GetParam().box, true, nullptr, no_pause)), "") << name(set);
  }
}

TEST_P(Repeats, OfTheGrid) {
  const RestoreInstructionSet restore;
  const Outcome expected{{}, grid_lists(GetParam().box, nullptr), {}};
  ASSERT_GT(expected.lists[0].pairs(), 0);
  for (const int threads : {2, 5}) {
    const auto pool = make_thread_pool(threads);
    EXPECT_EQ(first_difference(expected, {{}, grid_lists(GetParam().box, pool.get()), {}}), "") << threads;
  }
  for (const InstructionSet set : supported_sets()) {
    set_instruction_set(set);
    EXPECT_EQ(first_difference(expected, {{}, grid_lists(GetParam().box, nullptr), {}}), "") << name(set);
  }
}

TEST_P(Repeats, OfTheChoiceOnAnyNumberOfThreads) {
  const Outcome expected = run_of_choice(GetParam().box, nullptr, no_pause);
  EXPECT_EQ(engines_of(expected), "grid dch grid ");
  const auto pool = make_thread_pool(3);
  EXPECT_EQ(first_difference(expected, run_of_choice(GetParam().box, pool.get(), no_pause)), "");
}

TEST_P(Repeats, OfTheChoiceWithPausesAndInstructionSets) {
  const RestoreInstructionSet restore;
  const Outcome expected = run_of_choice(GetParam().box, nullptr, no_pause);
  EXPECT_EQ(first_difference(expected, run_of_choice(GetParam().box, nullptr, pause_at_times)), "");
  for (const InstructionSet set : supported_sets()) {
    set_instruction_set(set);
    EXPECT_EQ(first_difference(expected, run_of_choice(GetParam().box, nullptr, no_pause)), "") << name(set);
  }
}

INSTANTIATE_TEST_SUITE_P(Boxes, Repeats, ::testing::ValuesIn(boxes()),
                         [](const auto& p) { return p.param.name; });

}  // namespace
}  // namespace dch
