// SPDX-License-Identifier: MIT
//
// Every instruction set gives what the definitions in list_kernels.hpp say, saturation and wrapping included.
//
// More than 300 lines: one test a kernel, each beside the definition that it is compared with.
#include "simd/list_kernels.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <gtest/gtest.h>
#include <vector>

#include "instruction_sets.hpp"
#include "scenes.hpp"

namespace dch::detail {
namespace {

int saturated(int v) { return std::clamp(v, -32768, 32767); }
int square(int d) { return (d * d + 0x4000) >> 15; }
int wrapped(int v) { return static_cast<std::int16_t>(static_cast<std::uint16_t>(v)); }

std::int16_t coordinate(scenes::Random& random, int most) {
  return static_cast<std::int16_t>(static_cast<int>(random.below(2 * static_cast<std::size_t>(most) + 1)) -
                                   most);
}

class ListKernelsTest : public ::testing::TestWithParam<InstructionSet> {
 protected:
  void SetUp() override {
    if (!is_supported(GetParam())) GTEST_SKIP() << "this processor has no " << name(GetParam());
  }
  const ListKernels& kernels() const { return list_kernels(GetParam()); }
};

/// Random candidates with room for what kernels read and write beyond.
struct CandidateArrays {
  CandidateArrays(std::size_t count, int most, scenes::Random& random)
      : x(count + kChunk), y(count + kChunk), z(count + kChunk), tag(count + kChunk), id(count + kChunk) {
    for (auto* axis : {&x, &y, &z})
      for (std::int16_t& at : *axis) at = coordinate(random, most);
    for (std::int16_t& at : tag) at = coordinate(random, 32767);  // lanes beyond hold anything
    for (std::size_t k = 0; k < id.size(); ++k) id[k] = static_cast<std::int32_t>(random.below(1000000));
  }
  Candidates view() { return {x.data(), y.data(), z.data(), id.data(), tag.data()}; }
  std::vector<std::int16_t> x, y, z, tag;
  std::vector<std::int32_t> id;
};

enum class Limit { one, by_size, by_type };
constexpr Limit kLimits[] = {Limit::one, Limit::by_size, Limit::by_type};

/// Limits of any of the three kinds, random, and as their definitions have them.
struct RandomLimits {
  RandomLimits(Limit which, CandidateArrays& candidates, std::size_t count, int most, scenes::Random& random)
      : kind(which) {
    const auto number = [&](int below) {
      return static_cast<std::int16_t>(random.below(static_cast<std::size_t>(below)));
    };
    row_limits.middle = number(most);
    row_limits.band = number(random.below(3) == 0 ? 1 : 500);
    row_limits.skin = number(500);
    row_limits.raise = number(500);
    row_limits.by_type = by_type;
    row_limits.rows = row;
    for (TypeLimits& of_type : by_type)
      for (std::int16_t& limit : of_type.limit)
        limit = static_cast<std::int16_t>(number(most) - (random.below(4) == 0 ? most : 0));
    const int tags = kind == Limit::by_type ? kKernelTypes : 12000;
    for (std::size_t k = 0; k < count; ++k) candidates.tag[k] = number(tags);
    for (std::int16_t& tag : row) tag = number(tags);
  }
  int middle(int r, int tag) const {
    if (kind == Limit::one) return row_limits.middle;
    if (kind == Limit::by_type) return by_type[row[r]].limit[tag];
    return saturated(square(saturated(tag + row_limits.skin + row[r])) + row_limits.raise);
  }
  /// What a filter goes by.
  int out(int tag) const {
    if (kind == Limit::one) return row_limits.middle;
    return kind == Limit::by_type ? by_type[row[0]].limit[tag]
                                  : saturated(square(row[0] + tag) + row_limits.band);
  }

  Limit kind;
  RowLimits row_limits;
  std::int16_t row[kBlock];  ///< sizes or types of the rows
  TypeLimits by_type[kKernelTypes];
};

BlockPoints random_points(scenes::Random& random, int most) {
  BlockPoints points;
  for (auto* axis : {points.x, points.y, points.z})
    for (int lane = 0; lane < kBlock; ++lane) axis[lane] = coordinate(random, most);
  return points;
}

/// Rows of a block by their definition.
struct ExpectedRows {
  std::vector<std::int32_t> j, end;
  std::vector<OpenLanes> open;

  /// @param excluded kFewExcluded a row, or none
  ExpectedRows(const BlockPoints& points, int rows, const CandidateArrays& c, std::size_t count,
               const RandomLimits& limits, const RandomLimits* near, bool own_first,
               const std::vector<std::int32_t>& excluded) {
    for (int r = 0; r < rows; ++r)
      for (int part = 0; part < (near != nullptr ? 2 : 1); ++part) {
        const auto begin = static_cast<std::int32_t>(j.size());
        for (std::size_t k = 0; k < count; ++k) {
          if (k % kChunk == 0)
            open.push_back({r, static_cast<std::int32_t>(end.size()), static_cast<std::int32_t>(k / kChunk),
                            static_cast<std::int32_t>(j.size()) - begin, 0, 0});
          const int t = saturated(
              saturated(square(wrapped(c.x[k] - points.x[r])) + square(wrapped(c.y[k] - points.y[r]))) +
              square(wrapped(c.z[k] - points.z[r])));
          if (own_first && k <= static_cast<std::size_t>(r)) continue;
          const auto of_row = excluded.begin() + (excluded.empty() ? 0 : kFewExcluded * r);
          if (!excluded.empty() && std::count(of_row, of_row + kFewExcluded, c.id[k]) > 0) continue;
          if (near != nullptr && (t < near->middle(r, c.tag[k])) != (part == 0)) continue;
          const int middle = limits.middle(r, c.tag[k]), band = limits.row_limits.band;
          const std::uint32_t bit = 1u << (k % kChunk);
          if (t < middle) {
            j.push_back(c.id[k]);
            open.back().within |= bit;
          }
          if (t >= middle - band && t < middle + band) open.back().lanes |= bit;
        }
        end.push_back(static_cast<std::int32_t>(j.size()));
      }
    open.erase(std::remove_if(open.begin(), open.end(), [](const OpenLanes& o) { return o.lanes == 0; }),
               open.end());
  }
};

TEST_P(ListKernelsTest, RowsHoldWhatIsWithinTheirLimitsAndNoteWhatIsOpen) {
  scenes::Random random(1);
  for (int trial = 0; trial < 600; ++trial) {
    const int most = trial % 4 == 0 ? 16383 : 4000;  // differences up to twice that
    const std::size_t count = random.below(260);
    const bool own_first = count >= kBlock && trial % 2 == 0, has_shell = trial % 5 == 0;
    const auto rows = static_cast<std::int32_t>(random.below(kBlock + 1));
    const BlockPoints points = random_points(random, most);
    CandidateArrays candidates(count, most, random);
    const RandomLimits limits(kLimits[trial % 3], candidates, count, trial % 2 ? 3000 : 32000, random);
    RandomLimits near = limits;
    near.row_limits.middle = static_cast<std::int16_t>(limits.row_limits.middle / 2);
    near.row_limits.skin = static_cast<std::int16_t>(limits.row_limits.skin / 2);
    near.row_limits.raise = near.row_limits.band = 0;
    near.row_limits.by_type = near.by_type;
    near.row_limits.rows = near.row;
    std::vector<std::int32_t> excluded;
    if (count > 0 && trial % 7 < 3) {
      excluded.resize(kFewExcluded * kBlock, -1);
      for (std::int32_t& id : excluded)
        if (random.below(3) > 0) id = candidates.id[random.below(count)];
    }
    const ExpectedRows expected(points, rows, candidates, count, limits, has_shell ? &near : nullptr,
                                own_first, excluded);

    const auto kernel = limits.kind == Limit::one       ? kernels().rows
                        : limits.kind == Limit::by_size ? kernels().rows_by_size
                                                        : kernels().rows_by_type;
    std::vector<std::int32_t> j(kBlock * (count + kChunk) + kChunk + 1, -7), end(2 * kBlock);
    std::vector<OpenLanes> open(2 * kBlock * (count / kChunk + 1));
    const std::int32_t noted =
        kernel(points, rows, candidates.view(), static_cast<std::int32_t>(count), limits.row_limits,
               has_shell ? &near.row_limits : nullptr,
               {j.data(), end.data(), open.data(), own_first, excluded.empty() ? nullptr : excluded.data()});
    ASSERT_TRUE(std::equal(expected.end.begin(), expected.end.end(), end.begin())) << trial;
    ASSERT_TRUE(std::equal(expected.j.begin(), expected.j.end(), j.begin())) << trial;
    ASSERT_EQ(j[expected.j.size() + kChunk], -7) << "writes farther than it says";
    ASSERT_EQ(noted, static_cast<std::int32_t>(expected.open.size())) << trial;
    for (std::size_t k = 0; k < expected.open.size(); ++k) {
      ASSERT_EQ(open[k].row, expected.open[k].row);
      ASSERT_EQ(open[k].segment, expected.open[k].segment);
      ASSERT_EQ(open[k].chunk, expected.open[k].chunk);
      ASSERT_EQ(open[k].before, expected.open[k].before);
      ASSERT_EQ(open[k].lanes, expected.open[k].lanes);
      ASSERT_EQ(open[k].within, expected.open[k].within);
    }
  }
}

TEST_P(ListKernelsTest, FilterKeepsWhatIsNearTheBox) {
  scenes::Random random(4);
  for (int trial = 0; trial < 300; ++trial) {
    const int most = trial % 4 == 0 ? 16383 : 4000;
    const std::size_t count = random.below(170);
    CandidateArrays from(count, most, random), to(count + kChunk, most, random);
    std::vector<std::uint32_t> valid(count / kChunk + 1);
    for (std::uint32_t& lanes : valid) lanes = static_cast<std::uint32_t>(random.below(std::size_t{1} << 32));
    const std::uint32_t* const chosen = trial % 2 ? valid.data() : nullptr;
    BlockSpan box;
    for (int axis = 0; axis < 3; ++axis) {
      box.center[axis] = coordinate(random, most);
      box.half_width[axis] = static_cast<std::int16_t>(random.below(3000));
    }
    const RandomLimits limits(kLimits[trial % 3], from, count, 8000, random);
    CandidateArrays expected = from;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const std::int16_t at[3] = {from.x[k], from.y[k], from.z[k]};
      int t = 0;
      for (int axis = 0; axis < 3; ++axis)
        t = saturated(
            t + square(std::max(0, std::abs(wrapped(at[axis] - box.center[axis])) - box.half_width[axis])));
      if (t >= limits.out(from.tag[k]) || (chosen && (valid[k / kChunk] >> (k % kChunk) & 1) == 0)) continue;
      expected.x[kept] = from.x[k];
      expected.y[kept] = from.y[k];
      expected.z[kept] = from.z[k];
      expected.tag[kept] = from.tag[k];
      expected.id[kept++] = from.id[k];
    }
    const bool in_place = trial % 5 == 0;
    const Candidates target = in_place ? from.view() : to.view();
    const auto size = static_cast<std::int32_t>(count);
    std::int32_t found = 0;
    switch (limits.kind) {
      case Limit::one:
        found = kernels().filter(box, limits.row_limits.middle, from.view(), chosen, size, target);
        break;
      case Limit::by_size:
        found = kernels().filter_by_size(box, limits.row[0], limits.row_limits.band, from.view(), chosen,
                                         size, target);
        break;
      case Limit::by_type:
        found =
            kernels().filter_by_type(box, limits.by_type[limits.row[0]], from.view(), chosen, size, target);
        break;
    }
    ASSERT_EQ(found, static_cast<std::int32_t>(kept));
    for (std::size_t k = 0; k < kept; ++k) {
      ASSERT_EQ(target.x[k], expected.x[k]);
      ASSERT_EQ(target.y[k], expected.y[k]);
      ASSERT_EQ(target.z[k], expected.z[k]);
      ASSERT_EQ(target.id[k], expected.id[k]);
      ASSERT_TRUE(limits.kind == Limit::one || target.tag[k] == expected.tag[k]);
    }
  }
}

TEST_P(ListKernelsTest, GatherPutsShiftedBlocksSideBySide) {
  scenes::Random random(5);
  std::vector<BlockPoints> points(20);
  std::vector<std::int32_t> ids(points.size() * kBlock);
  for (BlockPoints& block : points)
    for (auto* axis : {block.x, block.y, block.z})
      for (int lane = 0; lane < kBlock; ++lane) axis[lane] = coordinate(random, 32767);
  std::vector<std::int16_t> tags(ids.size());
  for (std::size_t k = 0; k < ids.size(); ++k) {
    ids[k] = static_cast<std::int32_t>(3 * k);
    tags[k] = coordinate(random, 32767);
  }
  std::vector<BlockRange> ranges(4);
  for (BlockRange& range : ranges)
    for (auto& shift : range.point_shift) {
      const int most = random.below(2) == 0 ? 32767 : 10;  // with and without saturation
      shift[0] = coordinate(random, most);
      shift[1] = static_cast<std::int16_t>(shift[0] / 2);
    }
  const std::vector<std::int32_t> range_end{2, 2, 6, 9};
  std::vector<std::int32_t> block(9);
  for (std::int32_t& b : block) b = static_cast<std::int32_t>(random.below(points.size()));
  CandidateArrays to(block.size() * kBlock, 1, random);
  kernels().gather(block.data(), range_end.data(), ranges.data(), 4, points.data(), ids.data(), tags.data(),
                   to.view());
  for (std::size_t n = 0; n < block.size(); ++n)
    for (std::size_t lane = 0; lane < kBlock; ++lane) {
      const BlockPoints& from = points[block[n]];
      const auto* const shift = ranges[n < 2 ? 0 : n < 6 ? 2 : 3].point_shift;
      const auto shifted = [&](std::int16_t at, int axis) {
        return saturated(saturated(at + shift[axis][0]) + shift[axis][1]);
      };
      ASSERT_EQ(to.x[n * kBlock + lane], shifted(from.x[lane], 0));
      ASSERT_EQ(to.y[n * kBlock + lane], shifted(from.y[lane], 1));
      ASSERT_EQ(to.z[n * kBlock + lane], shifted(from.z[lane], 2));
      ASSERT_EQ(to.id[n * kBlock + lane], ids[static_cast<std::size_t>(block[n]) * kBlock + lane]);
      ASSERT_EQ(to.tag[n * kBlock + lane], tags[static_cast<std::size_t>(block[n]) * kBlock + lane]);
    }
}

TEST_P(ListKernelsTest, ShiftMovesWholeBlocksAndNoMore) {
  scenes::Random random(8);
  for (const std::int32_t count : {0, 1, kBlock, 3 * kBlock - 2}) {
    const CandidateArrays from(4 * kBlock, 32767, random);
    CandidateArrays to = from;
    const std::int16_t by[] = {coordinate(random, 32767), coordinate(random, 32767),
                               coordinate(random, 32767)};
    kernels().shift(to.view(), by, count);
    const std::size_t end = static_cast<std::size_t>((count + kBlock - 1) / kBlock * kBlock);
    for (std::size_t k = 0; k < from.x.size(); ++k) {
      ASSERT_EQ(to.x[k], k < end ? wrapped(from.x[k] + by[0]) : from.x[k]) << count;
      ASSERT_EQ(to.y[k], k < end ? wrapped(from.y[k] + by[1]) : from.y[k]) << count;
      ASSERT_EQ(to.z[k], k < end ? wrapped(from.z[k] + by[2]) : from.z[k]) << count;
    }
    ASSERT_EQ(to.id, from.id);
    ASSERT_EQ(to.tag, from.tag);
  }
}

TEST_P(ListKernelsTest, LeaveOutKeepsTheOrderOfTheOthers) {
  scenes::Random random(6);
  for (int trial = 0; trial < 300; ++trial) {
    const std::size_t count = random.below(70);
    std::vector<std::int32_t> row(count + 16), to(count + 17, -7), excluded(random.below(20));
    for (std::int32_t& id : row) id = static_cast<std::int32_t>(random.below(60));
    for (std::int32_t& id : excluded) id = static_cast<std::int32_t>(random.below(60));
    std::vector<std::int32_t> expected;
    for (std::size_t k = 0; k < count; ++k)
      if (std::find(excluded.begin(), excluded.end(), row[k]) == excluded.end()) expected.push_back(row[k]);
    const bool in_place = trial % 2 == 0;
    const std::int32_t left =
        kernels().leave_out(row.data(), static_cast<std::int32_t>(count), excluded.data(),
                            static_cast<std::int32_t>(excluded.size()), in_place ? row.data() : to.data());
    ASSERT_EQ(to[expected.size() + 16], -7) << "writes farther than it says";
    std::vector<std::int32_t>& result = in_place ? row : to;
    result.resize(static_cast<std::size_t>(left));
    ASSERT_EQ(result, expected);
  }
}

BlockSpan random_span(scenes::Random& random, int most) {
  BlockSpan span{};
  for (int axis = 0; axis < 3; ++axis) {
    span.center[axis] = coordinate(random, most);
    span.half_width[axis] = static_cast<std::int16_t>(random.below(3000));
  }
  return span;
}

/// Boxes as the kernels take them.
struct SpanArrays {
  explicit SpanArrays(const std::vector<BlockSpan>& spans) {
    for (int axis = 0; axis < 3; ++axis) {
      center[axis].resize(spans.size() + kChunk);
      half_width[axis].resize(spans.size() + kChunk);
      for (std::size_t k = 0; k < spans.size(); ++k) {
        center[axis][k] = spans[k].center[axis];
        half_width[axis][k] = spans[k].half_width[axis];
      }
    }
    for (std::size_t k = 0; k < spans.size() + kChunk; ++k) number.push_back(static_cast<std::int32_t>(k));
  }
  BlockSpans view() const {
    return {{center[0].data(), center[1].data(), center[2].data()},
            {half_width[0].data(), half_width[1].data(), half_width[2].data()},
            number.data()};
  }
  std::vector<std::int16_t> center[3], half_width[3];
  std::vector<std::int32_t> number;
};

TEST_P(ListKernelsTest, CollectFindsTheBoxesThatAreNear) {
  scenes::Random random(3);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<BlockSpan> spans(1 + random.below(90));
    for (BlockSpan& span : spans) span = random_span(random, 8000);
    const SpanArrays boxes(spans);
    std::vector<BlockRange> ranges(1 + random.below(6));
    std::size_t total = 0;
    for (BlockRange& range : ranges) {
      range = {};
      range.first = static_cast<std::int32_t>(random.below(spans.size()));
      const std::size_t rest = spans.size() - static_cast<std::size_t>(range.first);
      range.count = static_cast<std::int32_t>(random.below(rest + 1));
      total += static_cast<std::size_t>(range.count);
      for (std::int16_t& shift : range.box_shift) shift = coordinate(random, 11000);
    }
    std::vector<std::int32_t> block(total + kChunk), range_end(ranges.size());
    const BlockSpan around = random_span(random, 12000);
    const auto limit = static_cast<std::int16_t>(random.below(4000));
    const std::int32_t found =
        kernels().collect(around, limit, boxes.view(), ranges.data(),
                          static_cast<std::int32_t>(ranges.size()), block.data(), range_end.data());
    std::int32_t expected = 0;
    for (std::size_t r = 0; r < ranges.size(); ++r) {
      for (std::int32_t b = ranges[r].first; b < ranges[r].first + ranges[r].count; ++b) {
        const BlockSpan& span = spans[static_cast<std::size_t>(b)];
        int gap2 = 0;
        for (int axis = 0; axis < 3; ++axis) {
          const int apart = std::abs(span.center[axis] + ranges[r].box_shift[axis] - around.center[axis]);
          gap2 =
              saturated(gap2 + square(std::max(apart - span.half_width[axis] - around.half_width[axis], 0)));
        }
        if (gap2 >= limit) continue;
        ASSERT_LT(expected, found);
        ASSERT_EQ(block[static_cast<std::size_t>(expected++)], b);
      }
      ASSERT_EQ(range_end[r], expected);
    }
    ASSERT_EQ(found, expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, ListKernelsTest, ::testing::ValuesIn(kInstructionSets), [](const auto& p) {
  std::string text = name(p.param);
  text.erase(std::remove(text.begin(), text.end(), '.'), text.end());
  return text;
});

TEST(InstructionSetTest, OnlySupportedSetsCanBeChosen) {
  const InstructionSet before = instruction_set();
  EXPECT_TRUE(is_supported(before));
  EXPECT_TRUE(is_supported(InstructionSet::portable));
  set_instruction_set(InstructionSet::portable);
  EXPECT_EQ(instruction_set(), InstructionSet::portable);
  set_instruction_set(before);
}

}  // namespace
}  // namespace dch::detail
