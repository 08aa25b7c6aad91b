// SPDX-License-Identifier: MIT
//
// Every instruction set gives what the definitions in list_kernels.hpp say, saturation and wrapping included.
#include "simd/list_kernels.hpp"

#include <algorithm>
#include <array>
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

TEST_P(ListKernelsTest, TestTellsInsideFromOpenPairs) {
  scenes::Random random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const int most = trial % 3 == 0 ? 16383 : 4000;  // differences up to twice that
    const auto chunks = static_cast<std::int32_t>(1 + random.below(5)), stride = chunks + trial % 2;
    const std::size_t candidates = static_cast<std::size_t>(chunks) * kChunk;
    BlockPoints points;
    std::vector<std::int16_t> x(candidates), y(candidates), z(candidates);
    for (int lane = 0; lane < kBlock; ++lane)
      points.x[lane] = coordinate(random, most), points.y[lane] = coordinate(random, most),
      points.z[lane] = coordinate(random, most);
    for (std::size_t k = 0; k < candidates; ++k)
      x[k] = coordinate(random, most), y[k] = coordinate(random, most), z[k] = coordinate(random, most);
    std::vector<std::uint32_t> valid(static_cast<std::size_t>(chunks)),
        mask(static_cast<std::size_t>(kBlock * stride));
    for (std::uint32_t& lanes : valid) lanes = static_cast<std::uint32_t>(random.below(std::size_t{1} << 32));
    std::vector<Unsettled> unsettled(static_cast<std::size_t>(kBlock * chunks));
    const auto in = static_cast<std::int16_t>(random.below(trial % 2 ? 3000 : 32767));
    const auto out = static_cast<std::int16_t>(std::min<std::size_t>(32767, in + random.below(400)));
    const std::int32_t left = kernels().test(points, x.data(), y.data(), z.data(), valid.data(), chunks, in,
                                             out, mask.data(), stride, unsettled.data());
    std::int32_t expected_left = 0;
    for (int row = 0; row < kBlock; ++row)
      for (std::int32_t chunk = 0; chunk < chunks; ++chunk) {
        std::uint32_t inside = 0, open = 0;
        for (int lane = 0; lane < kChunk; ++lane) {
          const std::size_t k = static_cast<std::size_t>(chunk * kChunk + lane);
          const int t = saturated(
              saturated(square(wrapped(x[k] - points.x[row])) + square(wrapped(y[k] - points.y[row]))) +
              square(wrapped(z[k] - points.z[row])));
          if ((valid[static_cast<std::size_t>(chunk)] >> lane & 1) == 0) continue;
          if (t < in) inside |= 1u << lane;
          if (t >= in && t < out) open |= 1u << lane;
        }
        ASSERT_EQ(mask[static_cast<std::size_t>(row * stride + chunk)], inside)
            << "row " << row << " chunk " << chunk;
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

int gap2(const BlockBox& a, const BlockBox& b) {
  int sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int above = saturated(b.v[axis] + a.v[axis + 4]), below = saturated(b.v[axis + 4] + a.v[axis]);
    sum = saturated(sum + square(std::max({above, below, 0})));
  }
  return sum;
}

BlockBox random_box(scenes::Random& random, int most) {
  BlockBox box{};
  for (int axis = 0; axis < 3; ++axis) {
    const int a = coordinate(random, most), b = coordinate(random, most);
    box.v[axis] = static_cast<std::int16_t>(std::min(a, b));
    box.v[axis + 4] = static_cast<std::int16_t>(-std::max(a, b));
  }
  return box;
}

TEST_P(ListKernelsTest, CollectAndSelectFindTheBoxesThatAreNear) {
  scenes::Random random(3);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<BlockBox> boxes(1 + random.below(90));
    for (BlockBox& box : boxes) box = random_box(random, 8000);
    std::vector<BlockRange> ranges(1 + random.below(6));
    std::size_t total = 0;
    for (BlockRange& range : ranges) {
      range = {};
      range.first = static_cast<std::int32_t>(random.below(boxes.size()));
      range.count =
          static_cast<std::int32_t>(random.below(boxes.size() - static_cast<std::size_t>(range.first) + 1));
      total += static_cast<std::size_t>(range.count);
      for (int axis = 0; axis < 3; ++axis) {
        range.box_shift.v[axis] = coordinate(random, 20000);
        range.box_shift.v[axis + 4] = static_cast<std::int16_t>(-range.box_shift.v[axis]);
      }
    }
    const std::size_t room = (total + kChunk) / kChunk * kChunk;
    std::vector<std::int32_t> block(room), range(room), index(room);
    std::array<std::vector<std::int16_t>, 6> corners;
    BoxColumns columns;
    for (std::size_t c = 0; c < 6; ++c) {
      corners[c].resize(room);
      columns.corner[c] = corners[c].data();
    }
    const BlockBox around = random_box(random, 12000);
    const auto limit = static_cast<std::int16_t>(random.below(4000));
    const std::int32_t found =
        kernels().collect(around, limit, boxes.data(), ranges.data(),
                          static_cast<std::int32_t>(ranges.size()), block.data(), range.data(), columns);
    std::vector<BlockBox> collected;
    for (std::size_t r = 0; r < ranges.size(); ++r)
      for (std::int32_t b = ranges[r].first; b < ranges[r].first + ranges[r].count; ++b) {
        BlockBox shifted = boxes[static_cast<std::size_t>(b)];
        for (int k = 0; k < 8; ++k)
          shifted.v[k] = static_cast<std::int16_t>(saturated(shifted.v[k] + ranges[r].box_shift.v[k]));
        if (gap2(around, shifted) > limit) continue;
        ASSERT_LT(static_cast<std::int32_t>(collected.size()), found);
        ASSERT_EQ(block[collected.size()], b);
        ASSERT_EQ(range[collected.size()], static_cast<std::int32_t>(r));
        collected.push_back(shifted);
      }
    ASSERT_EQ(found, static_cast<std::int32_t>(collected.size()));

    const BlockBox one = random_box(random, 12000);
    const auto first = static_cast<std::int32_t>(random.below(collected.size() + 1));
    const std::int32_t selected = kernels().select(one, limit, columns, first, found, index.data());
    std::vector<std::int32_t> expected;
    for (std::int32_t k = first; k < found; ++k)
      if (gap2(one, collected[static_cast<std::size_t>(k)]) <= limit) expected.push_back(k);
    ASSERT_EQ(selected, static_cast<std::int32_t>(expected.size()));
    ASSERT_TRUE(std::equal(expected.begin(), expected.end(), index.begin()));
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
