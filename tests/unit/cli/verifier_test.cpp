// SPDX-License-Identifier: MIT
#include "engines/verifier.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <dch/lists/all_pairs.hpp>

#include "small_scene.hpp"

namespace dch::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

ListParams params_of(ListKind kind, double skin = 0) {
  ListParams params;
  params.cutoffs = TypeCutoffs(2);
  params.skin = skin;
  params.kind = kind;
  return params;
}

/// Drops the k-th entry of a list.
void drop(NeighborList& list, std::int64_t k) {
  list.j.erase(list.j.begin() + static_cast<std::ptrdiff_t>(k));
  for (std::int64_t& begin : list.first) begin -= begin > k ? 1 : 0;
}

/// Appends an entry to row i.
void add(NeighborList& list, std::size_t i, std::int32_t j) {
  list.j.insert(list.j.begin() + static_cast<std::ptrdiff_t>(list.first[i + 1]), j);
  for (std::size_t k = i + 1; k < list.first.size(); ++k) ++list.first[k];
}

VerifyResult verify(VerifyMode mode, const ListParams& params, const trajectory::Frame& frame,
                    const NeighborList& list, bool is_new = true) {
  Verifier verifier(mode, params, 1);
  Verifier::Subject subject;
  subject.index = 3;
  subject.frame = &frame;
  subject.list = &list;
  subject.list_is_new = is_new;
  verifier.check(subject);
  return verifier.result();
}

/// Whether all atoms are verified, or a sample; and whether the list is full, or half of one.
class VerifierModes : public testing::TestWithParam<std::tuple<bool, bool>> {
 protected:
  VerifyMode mode() const { return std::get<0>(GetParam()) ? VerifyMode::all : VerifyMode::sample; }
  ListKind kind() const { return std::get<1>(GetParam()) ? ListKind::full : ListKind::half; }
};
INSTANTIATE_TEST_SUITE_P(SampleAndAll, VerifierModes, testing::Combine(testing::Bool(), testing::Bool()),
                         [](const auto& modes) {
                           return std::string(std::get<0>(modes.param) ? "all_" : "sample_") +
                                  (std::get<1>(modes.param) ? "full" : "half");
                         });

TEST_P(VerifierModes, FindsNothingInARightList) {
  const trajectory::Frame frame = random_frame(200);
  const ListParams params = params_of(kind(), 0.5);
  const VerifyResult result = verify(mode(), params, frame, all_pairs(frame.positions, frame.box, params));
  EXPECT_EQ(result.mismatches, 0);
  EXPECT_EQ(result.rows, 200);
  EXPECT_THAT(result.frames, ElementsAre(3));
}

TEST_P(VerifierModes, NamesAMissingPair) {
  const trajectory::Frame frame = random_frame(200);
  const ListParams params = params_of(kind());
  NeighborList list = all_pairs(frame.positions, frame.box, params);
  const std::size_t row = static_cast<std::size_t>(
      std::upper_bound(list.first.begin(), list.first.end(), 17) - list.first.begin() - 1);
  const std::int64_t id_i = frame.ids[row], id_j = frame.ids[static_cast<std::size_t>(list.j[17])];
  drop(list, 17);
  const VerifyResult result = verify(mode(), params, frame, list);
  ASSERT_GE(result.mismatches, 1);
  const Mismatch& first = result.first.front();
  EXPECT_EQ(first.what, "missing");
  EXPECT_EQ(std::min(first.atom_a, first.atom_b), std::min(id_i, id_j));
  EXPECT_EQ(std::max(first.atom_a, first.atom_b), std::max(id_i, id_j));
  EXPECT_LE(first.distance, 2);
  EXPECT_THAT(first.message("nm"), HasSubstr("frame 3: pair of atoms " + std::to_string(first.atom_a)));
  EXPECT_THAT(first.message("nm"), HasSubstr("(nm) is missing"));
}

TEST_P(VerifierModes, NamesAnExtraPair) {
  trajectory::Frame frame = random_frame(50);
  frame.positions[10] = {0, 0, 0};
  frame.positions[49] = {5, 5, 5};
  const ListParams params = params_of(kind());
  NeighborList list = all_pairs(frame.positions, frame.box, params);
  add(list, 10, 49);
  const VerifyResult result = verify(mode(), params, frame, list);
  ASSERT_GE(result.mismatches, 1);
  EXPECT_EQ(result.first.front().what, "extra");
  EXPECT_NEAR(result.first.front().distance, std::sqrt(75.0), 1e-12);
}

TEST(Verifier, ReportsRowsOutOfOrderAndRepeatedEntries) {
  const trajectory::Frame frame = random_frame(100);
  const ListParams params = params_of(ListKind::half);
  NeighborList list = all_pairs(frame.positions, frame.box, params);
  std::size_t row = 0;
  while (list.row(row).size() < 2) ++row;
  std::swap(list.j[static_cast<std::size_t>(list.first[row])],
            list.j[static_cast<std::size_t>(list.first[row]) + 1]);
  const VerifyResult swapped = verify(VerifyMode::all, params, frame, list);
  EXPECT_EQ(swapped.mismatches, 1);
  EXPECT_EQ(swapped.first.front().what, "order");
  EXPECT_THAT(swapped.first.front().message("nm"), HasSubstr("atom " + std::to_string(frame.ids[row])));

  list = all_pairs(frame.positions, frame.box, params);
  add(list, row, list.row(row)[list.row(row).size() - 1]);
  EXPECT_EQ(verify(VerifyMode::all, params, frame, list).mismatches, 1);
}

TEST(Verifier, AsksOfAKeptListOnlyThePairsWithinTheCutoff) {
  trajectory::Frame frame = random_frame(200);
  const ListParams params = params_of(ListKind::half, 0.8);
  const NeighborList list = all_pairs(frame.positions, frame.box, params);
  scenes::Random random(3);
  for (Vec3& position : frame.positions) position = position + random.in_ball(0.4);
  EXPECT_GT(verify(VerifyMode::all, params, frame, list, true).mismatches, 0);
  EXPECT_EQ(verify(VerifyMode::all, params, frame, list, false).mismatches, 0);
  EXPECT_EQ(verify(VerifyMode::sample, params, frame, list, false).mismatches, 0);
  for (Vec3& position : frame.positions) position = position + random.in_ball(3);
  EXPECT_GT(verify(VerifyMode::all, params, frame, list, false).mismatches, 0);
}

TEST(Verifier, HonorsExclusions) {
  const trajectory::Frame frame = random_frame(100);
  ListParams params = params_of(ListKind::half);
  const NeighborList without = all_pairs(frame.positions, frame.box, params);
  const std::vector<IndexPair> pairs{{without.row(0)[0], 0}, {without.row(1)[0], 1}};
  const Exclusions exclusions = Exclusions::from_pairs(100, pairs);
  params.exclusions = &exclusions;
  const NeighborList with = all_pairs(frame.positions, frame.box, params);
  EXPECT_EQ(verify(VerifyMode::sample, params, frame, with).mismatches, 0);
  EXPECT_EQ(verify(VerifyMode::all, params, frame, without).mismatches, 2);
}

TEST(Verifier, KeepsTheFirstMismatchesOnlyButCountsAll) {
  const trajectory::Frame frame = random_frame(200);
  const ListParams params = params_of(ListKind::half);
  NeighborList none;
  none.first.assign(201, 0);
  const VerifyResult result = verify(VerifyMode::all, params, frame, none);
  EXPECT_EQ(result.mismatches, all_pairs(frame.positions, frame.box, params).pairs());
  EXPECT_EQ(result.first.size(), Verifier::kMaxReported);
}

TEST(Verifier, ChecksTheHierarchyOfNewLists) {
  const trajectory::Frame frame = random_frame(100);
  const ListParams params = params_of(ListKind::half);
  const auto search = make_dch_search(2);
  search->update(frame.positions, frame.box);
  const NeighborList list = all_pairs(frame.positions, frame.box, params);
  Verifier verifier(VerifyMode::all, params, 2);
  Verifier::Subject subject{0, 0, &frame, &list, true, search.get()};
  verifier.check(subject);
  subject.list_is_new = false;
  verifier.check(subject);
  EXPECT_EQ(verifier.result().structure_checks, 1);
  EXPECT_EQ(verifier.result().mismatches, 0);
}

TEST(Verifier, SamplesTenFramesAndAThousandAtomsOfEach) {
  const trajectory::Frame frame = random_frame(1500);
  const ListParams params = params_of(ListKind::half);
  const NeighborList list = all_pairs(frame.positions, frame.box, params);
  Verifier verifier(VerifyMode::sample, params, 1000);
  for (std::int64_t k = 0; k < 1000; ++k) verifier.check({k, 2 * k, &frame, &list, true, nullptr});
  EXPECT_EQ(verifier.result().rows, 10000);
  EXPECT_THAT(verifier.result().frames, ElementsAre(0, 222, 444, 666, 888, 1110, 1332, 1554, 1776, 1998));
}

TEST(Verifier, LooksAtNothingWithoutBeingAsked) {
  const trajectory::Frame frame = random_frame(10);
  NeighborList wrong;
  const VerifyResult result = verify(VerifyMode::none, params_of(ListKind::half), frame, wrong);
  EXPECT_EQ(result.rows, 0);
  EXPECT_TRUE(result.frames.empty());
}

TEST(SpreadEvenly, TakesFirstAndLast) {
  EXPECT_THAT(spread_evenly(0, 10), ElementsAre());
  EXPECT_THAT(spread_evenly(1, 10), ElementsAre(0));
  EXPECT_THAT(spread_evenly(3, 10), ElementsAre(0, 1, 2));
  EXPECT_THAT(spread_evenly(42, 4), ElementsAre(0, 13, 27, 41));
}

}  // namespace
}  // namespace dch::cli
