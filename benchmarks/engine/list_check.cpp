// SPDX-License-Identifier: MIT
#include "list_check.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <future>

#include "pair_check.hpp"

namespace dch::bench {
namespace {

/// The sums of a contender's lists at the scene's present positions; `made` is overwritten.
std::vector<PairSum> sums_of(Contender& contender, const Scene& scene, std::vector<NeighborList>& made) {
  contender.make_lists(scene, made);
  std::vector<PairSum> sums;
  for (std::size_t list = 0; list < made.size(); ++list)
    sums.push_back(contender.makes_supersets() ? sum_within(made[list], scene, list) : sum_of(made[list]));
  return sums;
}

std::int64_t pairs_in(const std::vector<PairSum>& sums) {
  std::int64_t pairs = 0;
  for (const PairSum& sum : sums) pairs += sum.pairs;
  return pairs;
}

std::vector<PairSum> all_expected(const Scene& scene) {
  std::vector<PairSum> expected;
  for (std::size_t list = 0; list < std::max<std::size_t>(1, scene.list_radii.size()); ++list)
    expected.push_back(expected_pairs(scene, list));
  return expected;
}

void expect_pairs(const Scene& scene, int configuration, const std::vector<PairSum>& found,
                  const std::vector<PairSum>& expected) {
  if (found != expected)
    throw WrongAnswer(fmt::format("{}: the lists at configuration {} have {} pairs, expected {}", scene.name,
                                  configuration, pairs_in(found), pairs_in(expected)));
}

void validate(const Scene& scene, int configuration, const Contenders& contenders) {
  for (const auto& contender : contenders)
    if (const std::string fault = contender->validate(); !fault.empty())
      throw WrongAnswer(fmt::format("{}: the structure of '{}' at configuration {} is broken: {}", scene.name,
                                    contender->name(), configuration, fault));
}

}  // namespace

CheckedLists check_lists(Scene& scene, Contenders& contenders, const ListCheck& check) {
  std::vector<NeighborList> made(std::max<std::size_t>(1, scene.list_radii.size()));
  std::vector<PairSum> wanted;
  CheckedLists checked;
  const int validate_every =
      check.structures_checked > 0 ? std::max(1, check.last / check.structures_checked) : 0;
  scene.restart();
  for (const auto& contender : contenders) contender->reset();
  for (int k = 0; k == 0 || (k <= check.last && scene.step()); ++k) {
    wanted.clear();
    const bool compare = check.expect_all || k == 0;
    // Beside the contenders.
    std::future<std::vector<PairSum>> expected;
    if (compare) expected = std::async(std::launch::async, [&scene] { return all_expected(scene); });
    for (const auto& contender : contenders) {
      if (contender->makes_supersets() && k % check.superset_every != 0) continue;
      if (k % contender->every() != 0) continue;
      const std::vector<PairSum> found = sums_of(*contender, scene, made);
      if (wanted.empty()) wanted = found;
      if (wanted != found)
        throw WrongAnswer(fmt::format(
            "{}: the lists of '{}' at configuration {} have {} pairs, those of '{}' {}", scene.name,
            contender->name(), k, pairs_in(found), contenders.front()->name(), pairs_in(wanted)));
    }
    if (compare) {
      expect_pairs(scene, k, wanted, expected.get());
      ++checked.expected;
    }
    if (validate_every > 0 && k % validate_every == 0) {
      validate(scene, k, contenders);
      ++checked.structures;
    }
    ++checked.configurations;
    checked.last_pairs = pairs_in(wanted);
    checked.last_hash = 0;
    for (const PairSum& sum : wanted) checked.last_hash += sum.hash;
    checked.pairs += checked.last_pairs;
  }
  if (!check.expect_all && checked.configurations > 1) {
    expect_pairs(scene, checked.configurations - 1, wanted, all_expected(scene));
    ++checked.expected;
  }
  return checked;
}

}  // namespace dch::bench
