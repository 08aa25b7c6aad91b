// SPDX-License-Identifier: MIT
//
// Lanes of 16 bits for any processor. See list_kernels_loops.hpp.
#pragma once

#include "simd/list_kernels.hpp"

namespace dch::detail {
namespace {

/// One lane at a time.
struct Portable {
  using V = std::int16_t;
  static constexpr int kLanes = 1;
  static constexpr std::uint32_t kAll = 1;

  static V saturated(int v) { return static_cast<V>(v > 32767 ? 32767 : v < -32768 ? -32768 : v); }
  static V load(const std::int16_t* p) { return *p; }
  static V set1(std::int16_t v) { return v; }
  static V sub(V a, V b) {
    return static_cast<V>(static_cast<std::uint16_t>(a) - static_cast<std::uint16_t>(b));
  }
  static V adds(V a, V b) { return saturated(a + b); }
  static V abs(V a) { return static_cast<V>(a < 0 ? -a : a); }
  // without signs, since the absolute value of -32768 is 32768
  static V above(V a, V b) {
    const auto high = static_cast<std::uint16_t>(a), low = static_cast<std::uint16_t>(b);
    return high > low ? static_cast<V>(high - low) : V{0};
  }
  // -32768 squared does not fit: it comes out as -32768, as in the vector instruction
  static V square(V d) { return static_cast<V>(static_cast<std::uint16_t>((d * d + 0x4000) >> 15)); }
  static std::uint32_t bits_greater(V a, V b) { return a > b; }
  static V least(V a, V b) { return bits_below(b, a) != 0 ? b : a; }
  static std::uint32_t bits_below(V a, V b) {
    return static_cast<std::uint16_t>(a) < static_cast<std::uint16_t>(b);
  }
  static bool any_below(V a, std::uint16_t b) { return static_cast<std::uint16_t>(a) < b; }

  static void copy_shifted(const std::int16_t* from, std::int16_t shift, std::int16_t* to) {
    for (int lane = 0; lane < kBlock; ++lane)
      to[lane] = static_cast<V>(static_cast<std::uint16_t>(from[lane]) + static_cast<std::uint16_t>(shift));
  }
  static void copy_saturated(const std::int16_t* from, const std::int16_t shift[2], std::int16_t* to) {
    for (int lane = 0; lane < kBlock; ++lane) to[lane] = adds(adds(from[lane], shift[0]), shift[1]);
  }
  static void copy_ids(const std::int32_t* from, std::int32_t* to) {
    for (int lane = 0; lane < kBlock; ++lane) to[lane] = from[lane];
  }
  using Table = const std::int16_t*;
  static Table table(const std::int16_t* limits) { return limits; }
  static V look_up(Table table, V k) { return table[k & (kKernelTypes - 1)]; }  // lanes beyond hold anything
  static void move_to_front(std::uint32_t, V tag, std::int16_t* to) { *to = tag; }
  static std::int32_t move_to_front(std::uint32_t lane, V px, V py, V pz, const std::int32_t* from,
                                    std::int16_t* x, std::int16_t* y, std::int16_t* z, std::int32_t* to) {
    *x = px;
    *y = py;
    *z = pz;
    *to = *from;
    return static_cast<std::int32_t>(lane);
  }
  using Id = std::int32_t;
  static Id set1_id(std::int32_t id) { return id; }
  static std::uint32_t lanes_of_either(const std::int32_t* ids, Id a, Id b) {
    std::uint32_t lanes = 0;
    for (int k = 0; k < kChunk; ++k)
      lanes |= static_cast<std::uint32_t>(static_cast<int>(ids[k] == a) | static_cast<int>(ids[k] == b)) << k;
    return lanes;
  }
  static constexpr int kIds = 1;
  static std::uint32_t equal_ids(const std::int32_t* ids, std::int32_t id) { return *ids == id; }
  static std::int32_t compress_ids(std::uint32_t mask, const std::int32_t* ids, std::int32_t* out) {
    *out = *ids;
    return static_cast<std::int32_t>(mask);
  }
  static std::int32_t compress_lanes(std::uint32_t mask, int, const std::int32_t* ids, std::int32_t* out) {
    return compress_chunk(mask, ids, out);
  }
  static std::int32_t compress_chunk(std::uint32_t mask, const std::int32_t* ids, std::int32_t* out) {
    std::int32_t written = 0;
    for (; mask != 0; mask &= mask - 1) out[written++] = ids[__builtin_ctz(mask)];
    return written;
  }
};

}  // namespace
}  // namespace dch::detail
