// SPDX-License-Identifier: MIT
//
// Lists in pieces hold each pair of the oracle's list once, for every engine, in boxes of every kind.
#include <algorithm>
#include <gtest/gtest.h>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/base/executor.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/lists/all_pairs.hpp>

#include "list_compare.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

constexpr double kReach = 1;

/// All pieces behind each other, and how many there were.
struct Pieces {
  NeighborList together;
  int count = 0;
  double least_margin = 1e300;

  Pieces(PairSearch& search, const ListParams& request) {
    std::mutex mutex;
    search.list_in_pieces(request, [&](const NeighborList& piece) {
      const std::lock_guard<std::mutex> lock(mutex);
      ++count;
      least_margin = std::min(least_margin, piece.margin);
      for (std::size_t r = 0; r < piece.size(); ++r) {
        const auto row = piece.row(r);
        together.particle.push_back(piece.particle.empty() ? static_cast<std::int32_t>(r)
                                                           : piece.particle[r]);
        together.j.insert(together.j.end(), row.begin(), row.end());
        together.first.push_back(static_cast<std::int64_t>(together.j.size()));
      }
    });
  }
};

/// Points enough for several pieces, and what may be asked of them.
struct Asked {
  std::vector<Vec3> points;
  std::vector<double> radii;
  Exclusions exclusions;
  std::vector<ListParams> requests;

  explicit Asked(const Box& box) : points(scenes::uniform_in(box, 1200, 5)) {
    std::vector<IndexPair> bonds;
    for (std::int32_t i = 0; i + 1 < static_cast<std::int32_t>(points.size()); i += 2)
      bonds.push_back({i, i + 1});
    exclusions = Exclusions::from_bonds(points.size(), bonds, 1);
    for (std::size_t i = 0; i < points.size(); ++i) radii.push_back(i % 10 == 0 ? 0.5 * kReach : 0.1);
    ListParams plain;
    plain.cutoffs = TypeCutoffs(kReach);
    ListParams without = plain;
    without.exclusions = &exclusions;
    ListParams with_ghosts = plain;
    with_ghosts.first_ghost = 500;
    ListParams full = plain;  // which is not looked at
    full.kind = ListKind::full;
    ListParams by_radius;
    by_radius.radii = radii;
    requests = {plain, without, with_ghosts, full, by_radius};
  }
};

class ListPieces : public testing::TestWithParam<scenes::NamedBox> {};

TEST_P(ListPieces, AreTheListTogether) {
  const Box& box = GetParam().box;
  const Asked asked(box);
  const auto threads = make_thread_pool(3);
  std::vector<std::unique_ptr<PairSearch>> engines;
  engines.push_back(make_grid_search(kReach));
  engines.push_back(make_grid_search(kReach, threads.get()));
  engines.push_back(make_auto_search({kReach}));
  engines.push_back(make_dch_search(kReach));
  engines.push_back(make_cell_search(kReach));
  for (const auto& search : engines) search->update(asked.points, box);
  int most = 0;
  for (std::size_t k = 0; k < asked.requests.size(); ++k) {
    ListParams half = asked.requests[k];
    half.kind = ListKind::half;
    const NeighborList expected = all_pairs(asked.points, box, half);
    for (const auto& search : engines) {
      const Pieces pieces(*search, asked.requests[k]);
      EXPECT_EQ(first_difference(sorted_by_index(pieces.together, asked.points.size()), expected), "")
          << search->name() << ", request " << k;
      most = std::max(most, pieces.count);
    }
  }
  EXPECT_GT(most, 1) << "several pieces";
}

TEST_P(ListPieces, OfASupersetSayTheirMargin) {
  const Box& box = GetParam().box;
  const Asked asked(box);
  ListParams request = asked.requests.front();
  request.superset = true;
  request.order = RowOrder::unsorted;
  const auto search = make_grid_search(kReach);
  search->update(asked.points, box);
  const NeighborList list = search->list(request);
  const Pieces pieces(*search, request);
  EXPECT_EQ(first_difference(sorted_by_index(pieces.together, asked.points.size()),
                             sorted_by_index(list, asked.points.size())),
            "");
  EXPECT_EQ(pieces.least_margin, list.margin);
}

INSTANTIATE_TEST_SUITE_P(Boxes, ListPieces, testing::ValuesIn(scenes::all_boxes(4)),
                         [](const auto& named) { return named.param.name; });

TEST(ListInPieces, RefusesARadiusBeyondThatOfTheEngine) {
  for (const char* name : {"grid", "auto", "dch", "cell"}) {
    const auto search = make_search(name, {kReach});
    const Box box = Box::orthorhombic({9, 9, 9});
    search->update(scenes::uniform_in(box, 50, 1), box);
    ListParams request;
    request.cutoffs = TypeCutoffs(1.5 * kReach);
    EXPECT_THROW(search->list_in_pieces(request, [](const NeighborList&) {}), InvalidParameter) << name;
  }
}

/// Where lists reach half the box no cells can be had.
TEST(ListInPieces, AreTheListInASmallBox) {
  const Box box = Box::orthorhombic({2.01, 2.01, 2.01});
  const Asked asked(box);
  const auto search = make_grid_search(1.004);
  search->update(asked.points, box);
  ListParams request = asked.requests.front();
  request.cutoffs = TypeCutoffs(1.004);
  EXPECT_EQ(first_difference(sorted_by_index(Pieces(*search, request).together, asked.points.size()),
                             all_pairs(asked.points, box, request)),
            "");
}

}  // namespace
}  // namespace dch
