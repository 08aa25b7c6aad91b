// SPDX-License-Identifier: MIT
//
// Every instruction set gives what the definitions in list_kernels.hpp say, saturation and wrapping included.
#include "simd/list_kernels.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <gtest/gtest.h>
#include <vector>

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
    one_in = static_cast<std::int16_t>(random.below(static_cast<std::size_t>(most)));
    one_out = static_cast<std::int16_t>(std::min<std::size_t>(32767, one_in + random.below(400)));
    band = static_cast<std::int16_t>(random.below(500));
    for (int a = 0; a < kKernelTypes; ++a)
      for (int b = 0; b < kKernelTypes; ++b) {
        type_in[a].limit[b] = static_cast<std::int16_t>(random.below(static_cast<std::size_t>(most)));
        type_out[a].limit[b] =
            static_cast<std::int16_t>(std::min<std::size_t>(32767, type_in[a].limit[b] + random.below(400)));
      }
    const std::size_t tags = kind == Limit::by_type ? kKernelTypes : 12000;
    for (std::size_t k = 0; k < count; ++k) candidates.tag[k] = static_cast<std::int16_t>(random.below(tags));
    for (std::int16_t& tag : row) tag = static_cast<std::int16_t>(random.below(tags));
  }
  int in(int r, int tag) const {
    if (kind == Limit::one) return one_in;
    return kind == Limit::by_type ? type_in[row[r]].limit[tag] : square(row[r] + tag) - band;
  }
  int out(int r, int tag) const {
    if (kind == Limit::one) return one_out;
    return kind == Limit::by_type ? type_out[row[r]].limit[tag] : saturated(square(row[r] + tag) + band);
  }

  Limit kind;
  std::int16_t one_in, one_out, band;
  std::int16_t row[kBlock];  ///< sizes or types of the rows
  TypeLimits type_in[kKernelTypes], type_out[kKernelTypes];
};

TEST_P(ListKernelsTest, TestTellsInsideFromOpenPairs) {
  scenes::Random random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const int most = trial % 4 == 0 ? 16383 : 4000;  // differences up to twice that
    const std::size_t count = random.below(170);
    const auto chunks = static_cast<std::int32_t>((count + kChunk - 1) / kChunk), stride = chunks + trial % 2;
    BlockPoints points;
    for (int lane = 0; lane < kBlock; ++lane) {
      points.x[lane] = coordinate(random, most);
      points.y[lane] = coordinate(random, most);
      points.z[lane] = coordinate(random, most);
    }
    CandidateArrays candidates(count, most, random);
    const RandomLimits limits(kLimits[trial % 3], candidates, count, trial % 2 ? 3000 : 32767, random);
    std::vector<std::uint32_t> mask(static_cast<std::size_t>(kBlock * stride));
    std::vector<Unsettled> unsettled(static_cast<std::size_t>(kBlock * chunks));
    const auto size = static_cast<std::int32_t>(count);
    std::int32_t left = 0;
    switch (limits.kind) {
      case Limit::one:
        left = kernels().test(points, candidates.view(), size, limits.one_in, limits.one_out, mask.data(),
                              stride, unsettled.data());
        break;
      case Limit::by_size:
        left = kernels().test_by_size(points, limits.row, candidates.view(), size, limits.band, mask.data(),
                                      stride, unsettled.data());
        break;
      case Limit::by_type:
        left = kernels().test_by_type(points, limits.row, candidates.view(), size, limits.type_in,
                                      limits.type_out, mask.data(), stride, unsettled.data());
        break;
    }
    std::int32_t expected_left = 0;
    for (int row = 0; row < kBlock; ++row)
      for (std::int32_t chunk = 0; chunk < chunks; ++chunk) {
        std::uint32_t inside = 0, open = 0;
        for (std::size_t k = chunk * kChunk; k < std::min<std::size_t>(count, (chunk + 1) * kChunk); ++k) {
          const int t = saturated(saturated(square(wrapped(candidates.x[k] - points.x[row])) +
                                            square(wrapped(candidates.y[k] - points.y[row]))) +
                                  square(wrapped(candidates.z[k] - points.z[row])));
          const bool is_inside = t < limits.in(row, candidates.tag[k]);
          if (is_inside) inside |= 1u << (k % kChunk);
          if (!is_inside && t < limits.out(row, candidates.tag[k])) open |= 1u << (k % kChunk);
        }
        ASSERT_EQ(mask[static_cast<std::size_t>(row * stride + chunk)], inside) << row << ", " << chunk;
        if (open == 0) continue;
        ASSERT_LT(expected_left, left);
        const Unsettled& entry = unsettled[static_cast<std::size_t>(expected_left++)];
        ASSERT_EQ(entry.row, row);
        ASSERT_EQ(entry.chunk, chunk);
        ASSERT_EQ(entry.lanes, open);
      }
    ASSERT_EQ(left, expected_left);
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
      if (t >= limits.out(0, from.tag[k]) || (chosen && (valid[k / kChunk] >> (k % kChunk) & 1) == 0))
        continue;
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
        found = kernels().filter(box, limits.one_out, from.view(), chosen, size, target);
        break;
      case Limit::by_size:
        found = kernels().filter_by_size(box, limits.row[0], limits.band, from.view(), chosen, size, target);
        break;
      case Limit::by_type:
        found =
            kernels().filter_by_type(box, limits.type_out[limits.row[0]], from.view(), chosen, size, target);
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
    for (int axis = 0; axis < 3; ++axis) range.point_shift[axis] = coordinate(random, 32767);
  const std::vector<std::int32_t> range_end{2, 2, 6, 9};
  std::vector<std::int32_t> block(9);
  for (std::int32_t& b : block) b = static_cast<std::int32_t>(random.below(points.size()));
  CandidateArrays to(block.size() * kBlock, 1, random);
  kernels().gather(block.data(), range_end.data(), ranges.data(), 4, points.data(), ids.data(), tags.data(),
                   to.view());
  for (std::size_t n = 0; n < block.size(); ++n)
    for (std::size_t lane = 0; lane < kBlock; ++lane) {
      const BlockPoints& from = points[block[n]];
      const std::int16_t* shift = ranges[n < 2 ? 0 : n < 6 ? 2 : 3].point_shift;
      ASSERT_EQ(to.x[n * kBlock + lane], wrapped(from.x[lane] + shift[0]));
      ASSERT_EQ(to.y[n * kBlock + lane], wrapped(from.y[lane] + shift[1]));
      ASSERT_EQ(to.z[n * kBlock + lane], wrapped(from.z[lane] + shift[2]));
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

TEST_P(ListKernelsTest, CompressKeepsTheOrder) {
  scenes::Random random(2);
  for (int trial = 0; trial < 300; ++trial) {
    const std::size_t chunks = random.below(5);
    std::vector<std::uint32_t> mask(chunks);
    for (std::uint32_t& lanes : mask)
      lanes = static_cast<std::uint32_t>(random.below(std::size_t{1} << 32)) &
              (trial % 2 ? ~0u : static_cast<std::uint32_t>(random.below(std::size_t{1} << 32)));
    std::vector<std::int32_t> ids(chunks * kChunk), expected;
    for (std::size_t k = 0; k < ids.size(); ++k) {
      ids[k] = static_cast<std::int32_t>(random.below(1000000));
      if ((mask[k / kChunk] >> (k % kChunk) & 1) != 0) expected.push_back(ids[k]);
    }
    std::vector<std::int32_t> out(ids.size() + 16 + 1, -7);
    const std::int32_t written =
        kernels().compress(mask.data(), static_cast<std::int32_t>(chunks), ids.data(), out.data());
    ASSERT_EQ(written, static_cast<std::int32_t>(expected.size()));
    ASSERT_TRUE(std::equal(expected.begin(), expected.end(), out.begin()));
    ASSERT_EQ(out[expected.size() + 16], -7) << "writes farther than it says";
  }
}

TEST_P(ListKernelsTest, LeaveOutKeepsTheOrderOfTheOthers) {
  scenes::Random random(6);
  for (int trial = 0; trial < 300; ++trial) {
    const std::size_t count = random.below(70);
    std::vector<std::int32_t> row(count + 16), excluded(random.below(20));
    for (std::int32_t& id : row) id = static_cast<std::int32_t>(random.below(60));
    for (std::int32_t& id : excluded) id = static_cast<std::int32_t>(random.below(60));
    std::vector<std::int32_t> expected;
    for (std::size_t k = 0; k < count; ++k)
      if (std::find(excluded.begin(), excluded.end(), row[k]) == excluded.end()) expected.push_back(row[k]);
    const std::int32_t left =
        kernels().leave_out(row.data(), static_cast<std::int32_t>(count), excluded.data(),
                            static_cast<std::int32_t>(excluded.size()));
    row.resize(static_cast<std::size_t>(left));
    ASSERT_EQ(row, expected);
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

INSTANTIATE_TEST_SUITE_P(Sets, ListKernelsTest,
                         ::testing::Values(InstructionSet::portable, InstructionSet::sse42,
                                           InstructionSet::avx2, InstructionSet::avx512),
                         [](const auto& p) {
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
