// SPDX-License-Identifier: MIT
//
// Rows edited where they stand are those that a copy with the edits gives.
#include <gtest/gtest.h>
#include <utility>
#include <vector>

#include "lists/open_pairs.hpp"
#include "scenes.hpp"

namespace dch::detail {
namespace {

/// Segments of random ids, and edits of some share of the places.
struct RandomRows {
  RandomRows(scenes::Random& random, std::size_t edits_in_100) : ends{0} {
    const std::size_t segments = 1 + random.below(12);
    for (std::size_t s = 0; s < segments; ++s) {
      std::vector<std::int32_t>& to = expected.emplace_back();
      const auto length = static_cast<std::int32_t>(random.below(20));
      for (std::int32_t place = 0; place <= length; ++place) {
        const auto segment = static_cast<std::int32_t>(s);
        for (; random.below(100) < edits_in_100 / 2; to.push_back(edits.back().id))
          edits.push_back({segment, place, new_id(), true});
        if (place == length) break;
        ids.push_back(new_id());
        if (random.below(100) < edits_in_100) {
          edits.push_back({segment, place, ids.back(), false});
        } else {
          to.push_back(ids.back());
        }
      }
      ends.push_back(static_cast<std::int32_t>(ids.size()));
    }
  }
  std::int32_t new_id() { return ++last_id; }

  std::vector<std::int32_t> ids, ends;
  std::vector<RowEdit> edits;
  std::vector<std::vector<std::int32_t>> expected;  ///< by segment
  std::int32_t last_id = 0;
};

TEST(RowEdits, WhereRowsStand) {
  scenes::Random random(1);
  for (int trial = 0; trial < 3000; ++trial) {
    RandomRows rows(random, std::vector<std::size_t>{0, 2, 10, 40, 90}[trial % 5]);
    rows.ids.resize(rows.ids.size() + rows.edits.size());
    apply_edits(rows.edits, rows.ids.data(), rows.ends);
    ASSERT_EQ(rows.ends.size(), rows.expected.size() + 1);
    ASSERT_EQ(rows.ends[0], 0);
    for (std::size_t s = 0; s < rows.expected.size(); ++s)
      ASSERT_EQ(
          std::vector<std::int32_t>(rows.ids.begin() + rows.ends[s], rows.ids.begin() + rows.ends[s + 1]),
          rows.expected[s])
          << trial << ", segment " << s;
  }
}

}  // namespace
}  // namespace dch::detail
