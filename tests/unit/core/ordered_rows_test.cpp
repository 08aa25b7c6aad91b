// SPDX-License-Identifier: MIT
//
// Rows of pieces that come in any order stand as if all had been appended one after the other.
#include "lists/ordered_rows.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <numeric>
#include <random>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/lists/neighbor_list.hpp>

#include "lists/row_parts.hpp"

namespace dch::detail {
namespace {

using Pieces = std::vector<std::vector<NeighborList>>;  // by piece and list

class OrderedRowsTest : public testing::TestWithParam<bool> {
 protected:
  static constexpr std::size_t kLists = 2;

  NeighborList list_of(int rows) {
    NeighborList list;
    start_rows(list);
    for (int r = 0; r < rows; ++r) {
      list.particle.push_back(next_++);
      const int near = draw(4), far = draw(3);
      list.j.resize(static_cast<std::size_t>(list.first.back()));
      for (int k = 0; k < near + far; ++k) list.j.push_back(draw(1000));
      if (GetParam()) list.near_end.push_back(list.first.back() + near);
      list.first.push_back(list.first.back() + near + far);
    }
    list.j.resize(list.j.size() + 7, -1);  // as lists have it that are longer than their rows
    return list;
  }
  Pieces pieces_of(int count) {
    Pieces pieces(static_cast<std::size_t>(count));
    for (auto& lists : pieces)
      for (std::size_t r = 0; r < kLists; ++r) lists.push_back(list_of(draw(4)));
    return pieces;
  }
  int draw(int end) { return std::uniform_int_distribution<int>(0, end - 1)(random_); }
  std::vector<int> any_order(int count) {
    std::vector<int> order(static_cast<std::size_t>(count));
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), random_);
    return order;
  }
  static void append(const NeighborList& piece, NeighborList& out) {
    out.j.resize(static_cast<std::size_t>(out.first.back()));
    for (std::size_t r = 0; r < piece.size(); ++r) {
      out.particle.push_back(piece.particle[r]);
      if (!piece.near_end.empty())
        out.near_end.push_back(out.first.back() + piece.near_end[r] - piece.first[r]);
      const Span<const std::int32_t> row = piece.row(r);
      out.j.insert(out.j.end(), row.begin(), row.end());
      out.first.push_back(static_cast<std::int64_t>(out.j.size()));
    }
  }
  static void expect_same(NeighborList got, NeighborList expected) {
    got.j.resize(static_cast<std::size_t>(got.first.back()));
    expected.j.resize(static_cast<std::size_t>(expected.first.back()));
    EXPECT_EQ(got.first, expected.first);
    EXPECT_EQ(got.particle, expected.particle);
    EXPECT_EQ(got.near_end, expected.near_end);
    EXPECT_EQ(got.j, expected.j);
  }

 private:
  std::mt19937 random_{7};
  std::int32_t next_ = 0;
};

TEST_P(OrderedRowsTest, StandAsIfOnePieceHadComeAfterTheOther) {
  std::vector<NeighborList> got(kLists);
  for (int scene = 0; scene < 300; ++scene) {
    const Pieces pieces = pieces_of(draw(9));
    const int count = static_cast<int>(pieces.size());
    std::vector<NeighborList> expected;
    for (std::size_t r = 0; r < kLists; ++r) {  // some lists have room, and rows of a layer before
      if (scene % 3 == 0) got[r] = {};
      start_rows(got[r]);
      append(list_of(draw(3)), got[r]);
      expected.push_back(got[r]);
      for (const auto& lists : pieces) append(lists[r], expected[r]);
    }
    const std::vector<NeighborList*> out{&got[0], &got[1]};
    OrderedRows rows(out, count);
    std::vector<int> waiting;
    std::vector<bool> counted(pieces.size());
    for (const int piece : any_order(count)) {
      rows.count(piece, pieces[static_cast<std::size_t>(piece)].data());
      counted[static_cast<std::size_t>(piece)] = true;
      const bool known = std::all_of(counted.begin(), counted.begin() + piece, [](bool is) { return is; });
      if (!rows.place(piece, pieces[static_cast<std::size_t>(piece)].data())) {
        waiting.push_back(piece);
      } else {
        EXPECT_TRUE(known) << scene;
      }
    }
    rows.make_room();
    for (const int piece : waiting)
      EXPECT_TRUE(rows.place(piece, pieces[static_cast<std::size_t>(piece)].data())) << scene;
    for (std::size_t r = 0; r < kLists; ++r) expect_same(got[r], expected[r]);
  }
}

// Else each list would be held twice.
TEST_P(OrderedRowsTest, TakePiecesAsTheyComeWhereThereIsRoom) {
  const Pieces pieces = pieces_of(40);
  std::vector<NeighborList> got(kLists);
  const std::vector<NeighborList*> out{&got[0], &got[1]};
  for (int list = 0; list < 2; ++list) {
    for (NeighborList* each : out) start_rows(*each);
    OrderedRows rows(out, 40);
    int placed = 0;
    for (int piece = 0; piece < 40; ++piece) {
      rows.count(piece, pieces[static_cast<std::size_t>(piece)].data());
      placed += static_cast<int>(rows.place(piece, pieces[static_cast<std::size_t>(piece)].data()));
    }
    EXPECT_EQ(placed == 40, list == 1);
    EXPECT_EQ(got[0].near_end.capacity() > 0, GetParam() && list == 1);
    rows.make_room();
    for (int piece = placed; piece < 40; ++piece)
      ASSERT_TRUE(rows.place(piece, pieces[static_cast<std::size_t>(piece)].data()));
  }
}

TEST_P(OrderedRowsTest, HaveAShellThatTheListBeforeHadNot) {
  NeighborList got = list_of(30), piece = list_of(20);
  got.near_end = std::vector<std::int64_t>();
  start_rows(got);
  const std::vector<NeighborList*> out{&got};
  OrderedRows rows(out, 1);
  rows.count(0, &piece);
  EXPECT_EQ(rows.place(0, &piece), !GetParam());
  rows.make_room();
  ASSERT_TRUE(rows.place(0, &piece));
  expect_same(got, piece);
}

TEST_P(OrderedRowsTest, LeaveAListThatIsLongEnoughWhereItIs) {
  NeighborList piece = list_of(20), got;
  got.j.resize(static_cast<std::size_t>(piece.first.back()));
  start_rows(got);
  const std::int32_t* const at = got.j.data();
  const std::vector<NeighborList*> out{&got};
  OrderedRows rows(out, 1);
  rows.count(0, &piece);
  rows.make_room();
  EXPECT_EQ(got.j.data(), at);
}

TEST(StartRows, MakesAnEmptyHalfListThatKeepsItsMemory) {
  NeighborList list;
  list.kind = ListKind::full;
  list.margin = 1;
  list.first = {0, 3};
  list.particle = {5};
  list.near_end = {1};
  list.j = {6, 7, 8};
  start_rows(list);
  EXPECT_EQ(list.kind, ListKind::half);
  EXPECT_EQ(list.margin, 0);
  EXPECT_EQ(list.size(), 0U);
  EXPECT_TRUE(list.particle.empty() && list.near_end.empty());
  EXPECT_EQ(list.j.size(), 3U);
}

INSTANTIATE_TEST_SUITE_P(Shells, OrderedRowsTest, testing::Bool(),
                         [](const auto& shell) { return shell.param ? "WithAShell" : "WithoutAShell"; });

// What threads hold beside the list does not grow with it.
TEST(RowParts, HoldTwoPiecesForAThread) {
  struct Gatherer {
    void use(InstructionSet) {}
    static std::int64_t memory_bytes() { return 0; }
    static ListWork work() { return {}; }
  };
  constexpr int kThreads = 2;
  const auto pool = make_thread_pool(kThreads);
  RowParts<Gatherer> parts;
  NeighborList list;
  for (int time = 0; time < 3; ++time) {
    start_rows(list);
    parts.find(pool.get(), {&list}, [](Gatherer&, RowFinder&, NeighborList* lists, int share, int shares) {
      constexpr int kRows = 4'000'000;
      for (int row = share_begin(kRows, share, shares); row < share_begin(kRows, share + 1, shares); ++row) {
        lists->particle.push_back(row);
        lists->j.resize(static_cast<std::size_t>(lists->first.back()));
        lists->j.insert(lists->j.end(), {row, row + 1});
        lists->first.push_back(lists->first.back() + 2);
      }
    });
    ASSERT_EQ(list.particle.size(), 4'000'000U);
    for (std::int32_t row = 0; row < 4'000'000; row += 1000) {
      ASSERT_EQ(list.particle[static_cast<std::size_t>(row)], row);
      ASSERT_EQ(list.row(static_cast<std::size_t>(row))[1], row + 1);
    }
  }
  EXPECT_LT(parts.memory_bytes(), 12'000'000U);  // the list takes 80 million
}

}  // namespace
}  // namespace dch::detail
