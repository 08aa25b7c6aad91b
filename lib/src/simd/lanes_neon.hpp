// SPDX-License-Identifier: MIT
//
// Lanes of 16 bits in registers of NEON, as every processor of AArch64 has it. See list_kernels_loops.hpp.
#pragma once

#include <arm_neon.h>

#include "simd/list_kernels.hpp"
#include "simd/pack_bytes.hpp"

namespace dch::detail {
namespace {

constexpr PackBytes<8, 2> kPack16;
constexpr PackBytes<4, 4> kPack32;

struct Neon {
  using V = int16x8_t;
  static constexpr int kLanes = 8;
  static constexpr std::uint32_t kAll = 0xFF;

  static uint16x8_t no_sign(V v) { return vreinterpretq_u16_s16(v); }
  static V with_sign(uint16x8_t v) { return vreinterpretq_s16_u16(v); }
  static V packed16(V lanes, const unsigned char* order) {
    return vreinterpretq_s16_u8(vqtbl1q_u8(vreinterpretq_u8_s16(lanes), vld1q_u8(order)));
  }

  static V load(const std::int16_t* p) { return vld1q_s16(p); }
  static V set1(std::int16_t v) { return vdupq_n_s16(v); }
  static V sub(V a, V b) { return vsubq_s16(a, b); }
  static V adds(V a, V b) { return vqaddq_s16(a, b); }
  static V abs(V a) { return vabsq_s16(a); }
  static V above(V a, V b) { return with_sign(vqsubq_u16(no_sign(a), no_sign(b))); }
  // -32768 squared saturates to 32767, where the other sets have -32768: no difference of a test is that
  static V square(V d) { return vqrdmulhq_s16(d, d); }
  static std::uint32_t bits_of(uint16x8_t lanes) {
    const uint16x8_t bit = {1, 2, 4, 8, 16, 32, 64, 128};
    return vaddvq_u16(vandq_u16(lanes, bit));
  }
  static std::uint32_t bits_greater(V a, V b) { return bits_of(vcgtq_s16(a, b)); }
  static V least(V a, V b) { return with_sign(vminq_u16(no_sign(a), no_sign(b))); }
  static std::uint32_t bits_below(V a, V b) { return bits_of(vcltq_u16(no_sign(a), no_sign(b))); }
  static bool any_below(V a, std::uint16_t b) { return vminvq_u16(no_sign(a)) < b; }

  static void copy_shifted(const std::int16_t* from, std::int16_t shift, std::int16_t* to) {
    vst1q_s16(to, vaddq_s16(load(from), set1(shift)));
  }
  static void copy_saturated(const std::int16_t* from, const std::int16_t shift[2], std::int16_t* to) {
    vst1q_s16(to, adds(adds(load(from), set1(shift[0])), set1(shift[1])));
  }
  static void copy_ids(const std::int32_t* from, std::int32_t* to) {
    const int32x4_t low = vld1q_s32(from), high = vld1q_s32(from + 4);
    vst1q_s32(to, low);
    vst1q_s32(to + 4, high);
  }
  /// The limits byte by byte.
  using Table = uint8x16x2_t;
  static Table table(const std::int16_t* limits) {
    return {{vreinterpretq_u8_s16(load(limits)), vreinterpretq_u8_s16(load(limits + 8))}};
  }
  /// Number k is bytes 2 k and 2 k + 1.
  static V look_up(const Table& table, V k) {
    const uint16x8_t bytes = vmlaq_n_u16(vdupq_n_u16(0x0100), no_sign(k), 0x0202);
    return vreinterpretq_s16_u8(vqtbl2q_u8(table, vreinterpretq_u8_u16(bytes)));
  }
  static void move_to_front(std::uint32_t lanes, V tags, std::int16_t* to) {
    vst1q_s16(to, packed16(tags, kPack16.bytes[lanes]));
  }
  static std::int32_t move_to_front(std::uint32_t lanes, V px, V py, V pz, const std::int32_t* from,
                                    std::int16_t* x, std::int16_t* y, std::int16_t* z, std::int32_t* to) {
    vst1q_s16(x, packed16(px, kPack16.bytes[lanes]));
    vst1q_s16(y, packed16(py, kPack16.bytes[lanes]));
    vst1q_s16(z, packed16(pz, kPack16.bytes[lanes]));
    return compress_lanes(lanes, kLanes, from, to);
  }
  static std::int32_t compress_chunk(std::uint32_t mask, const std::int32_t* ids, std::int32_t* out) {
    return compress_lanes(mask, kChunk, ids, out);
  }
  using Id = int32x4_t;
  static Id set1_id(std::int32_t id) { return vdupq_n_s32(id); }
  /// Eight at a time, of which a half comes from each register.
  static std::uint32_t bits_of_halves(uint32x4_t low, uint32x4_t high) {
    return bits_of(vuzp1q_u16(vreinterpretq_u16_u32(low), vreinterpretq_u16_u32(high)));
  }
  static std::uint32_t lanes_of_either(const std::int32_t* ids, Id a, Id b) {
    const auto equal = [&](const std::int32_t* four) {
      const Id here = vld1q_s32(four);
      return vorrq_u32(vceqq_s32(here, a), vceqq_s32(here, b));
    };
    std::uint32_t lanes = 0;
    for (int k = 0; k < kChunk; k += 8) lanes |= bits_of_halves(equal(ids + k), equal(ids + k + 4)) << k;
    return lanes;
  }
  static constexpr int kIds = 8;
  static std::uint32_t equal_ids(const std::int32_t* ids, std::int32_t id) {
    const Id all = set1_id(id);
    return bits_of_halves(vceqq_s32(vld1q_s32(ids), all), vceqq_s32(vld1q_s32(ids + 4), all));
  }
  static std::int32_t compress_ids(std::uint32_t mask, const std::int32_t* ids, std::int32_t* out) {
    return compress_lanes(mask, kIds, ids, out);
  }
  static std::int32_t compress_lanes(std::uint32_t mask, int count, const std::int32_t* ids,
                                     std::int32_t* out) {
    std::int32_t written = 0;
    for (int k = 0; k < count; k += 4, mask >>= 4) {
      const std::uint32_t four = mask & 15;
      const uint8x16_t from = vreinterpretq_u8_s32(vld1q_s32(ids + k));
      const uint8x16_t front = vqtbl1q_u8(from, vld1q_u8(kPack32.bytes[four]));
      vst1q_s32(out + written, vreinterpretq_s32_u8(front));
      written += __builtin_popcount(four);
    }
    return written;
  }
};

}  // namespace
}  // namespace dch::detail
