// SPDX-License-Identifier: MIT
//
// Vectors of NEON, as every processor of AArch64 has it. See cluster_loops.hpp.
#pragma once

#include <arm_neon.h>

#include "clusters/simd/cluster_loops.hpp"

namespace dch::detail {
namespace {

/// The slots of cluster J, with slot p of cluster I.
struct NeonFloat {
  using Real = float;
  using V = float32x4_t;
  using Where = int32x4_t;
  using Lanes = uint32x4_t;
  struct Cluster {
    Where x, y, z;
  };
  static constexpr int kLanes = 4, kRegisters = 4;

  static V zero() { return vdupq_n_f32(0); }
  static V set1(float v) { return vdupq_n_f32(v); }
  static V load(const float* p) { return vld1q_f32(p); }
  static void store(float* p, V a) { vst1q_f32(p, a); }
  static V add(V a, V b) { return vaddq_f32(a, b); }
  static V sub(V a, V b) { return vsubq_f32(a, b); }
  static V mul(V a, V b) { return vmulq_f32(a, b); }
  /// The second one if the first is no number, as in the other sets.
  static V max(V a, V b) { return vbslq_f32(vcgtq_f32(a, b), a, b); }
  static V madd(V a, V b, V c) { return vfmaq_f32(c, a, b); }
  static V msub(V a, V b, V c) { return vfmaq_f32(vnegq_f32(c), a, b); }
  static V inverse(V a) { return vdivq_f32(set1(1), a); }
  static V over_root(V, V s) { return vsqrtq_f32(s); }
  /// 2^n of integers n in -126..127.
  static V power_of_two(V n) {
    return vreinterpretq_f32_s32(vshlq_n_s32(vreinterpretq_s32_f32(add(n, set1(0x1.8p23f + 127))), 23));
  }
  static Lanes each_bit() { return Lanes{1, 2, 4, 8}; }
  static std::uint32_t bits_at_most(V a, V b) { return vaddvq_u32(vandq_u32(vcleq_f32(a, b), each_bit())); }
  static Lanes less(V a, V b, std::uint32_t mask, int which) {
    return vandq_u32(vcltq_f32(a, b), vtstq_u32(vdupq_n_u32(mask >> (4 * which)), each_bit()));
  }
  static std::uint32_t bits(Lanes lanes) { return vaddvq_u32(vandq_u32(lanes, each_bit())); }
  static V keep(Lanes lanes, V a) {
    return vreinterpretq_f32_u32(vandq_u32(lanes, vreinterpretq_u32_f32(a)));
  }
  static V floor(V a) { return vrndmq_f32(a); }
  /// Numbers n and n + 1 of an array, n being an integer in each lane.
  static void gather_two(const float* from, V n, V& first, V& second) {
    std::int32_t at[4];
    vst1q_s32(at, vcvtq_s32_f32(n));
    const V a = vcombine_f32(vld1_f32(from + at[0]), vld1_f32(from + at[1]));
    const V b = vcombine_f32(vld1_f32(from + at[2]), vld1_f32(from + at[3]));
    first = vuzp1q_f32(a, b);
    second = vuzp2q_f32(a, b);
  }
  static V spread(const float* four, int which) { return vdupq_n_f32(four[which]); }
  static V repeat(const float* four) { return load(four); }
  static Where spread(const std::int32_t* four, int which) { return vdupq_n_s32(four[which]); }
  static V difference(Where a, Where b) { return vcvtq_f32_s32(vsubq_s32(a, b)); }
  static Cluster load_cluster(const ClusterUnits& at, const ClusterShift<float>& shift) {
    const auto moved = [&](const std::int32_t* four, int axis) {
      return vaddq_s32(vld1q_s32(four), vdupq_n_s32(shift.axis[axis]));
    };
    return {moved(at.x, 0), moved(at.y, 1), moved(at.z, 2)};
  }
  /// Of rows whose shift was taken from cluster I.
  static Cluster load_cluster(const ClusterUnits& at) {
    return {vld1q_s32(at.x), vld1q_s32(at.y), vld1q_s32(at.z)};
  }
  static Where less_shift(Where a, std::int32_t shift) { return vsubq_s32(a, vdupq_n_s32(shift)); }
  using Columns = const std::int32_t*;
  static Columns columns(const std::int32_t* four) { return four; }
  static V lookup(const float* table, std::int32_t, const std::int32_t* row, Columns column, int which) {
    const float* const from = table + row[which];
    return V{from[column[0]], from[column[1]], from[column[2]], from[column[3]]};
  }
  static V over_i(const V* registers) {
    return add(add(registers[0], registers[1]), add(registers[2], registers[3]));
  }
  static void add_over_i(const Coordinates<NeonFloat>& force, ClusterOfFour<float>& to) {
    store(to.x, add(load(to.x), over_i(force.x)));
    store(to.y, add(load(to.y), over_i(force.y)));
    store(to.z, add(load(to.z), over_i(force.z)));
  }
  static V over_j(const V* registers) {
    return vpaddq_f32(vpaddq_f32(registers[0], registers[1]), vpaddq_f32(registers[2], registers[3]));
  }
  static void subtract_over_j(const Coordinates<NeonFloat>& force, ClusterOfFour<float>& to) {
    store(to.x, sub(load(to.x), over_j(force.x)));
    store(to.y, sub(load(to.y), over_j(force.y)));
    store(to.z, sub(load(to.z), over_j(force.z)));
  }
  /// Sums over slots of I, of registers summed up, are added in double.
  static void tally_over_i(V a, double* to) {
    vst1q_f64(to, vaddq_f64(vld1q_f64(to), vcvt_f64_f32(vget_low_f32(a))));
    vst1q_f64(to + 2, vaddq_f64(vld1q_f64(to + 2), vcvt_high_f64_f32(a)));
  }
  static void tally_over_j(const V* registers, double* to) { tally_over_i(over_j(registers), to); }
  static double sum(V a) {
    return vaddvq_f64(vaddq_f64(vcvt_f64_f32(vget_low_f32(a)), vcvt_high_f64_f32(a)));
  }
};

/// The same in two registers.
struct NeonDouble {
  using Real = double;
  struct V {
    float64x2_t low, high;
  };
  struct Lanes {
    uint64x2_t low, high;
  };
  using Where = V;
  struct Cluster {
    Where x, y, z;
  };
  static constexpr int kLanes = 4, kRegisters = 4;

  static V zero() { return set1(0); }
  static V set1(double v) { return {vdupq_n_f64(v), vdupq_n_f64(v)}; }
  static V load(const double* p) { return {vld1q_f64(p), vld1q_f64(p + 2)}; }
  static void store(double* p, V a) {
    vst1q_f64(p, a.low);
    vst1q_f64(p + 2, a.high);
  }
  static V add(V a, V b) { return {vaddq_f64(a.low, b.low), vaddq_f64(a.high, b.high)}; }
  static V sub(V a, V b) { return {vsubq_f64(a.low, b.low), vsubq_f64(a.high, b.high)}; }
  static V mul(V a, V b) { return {vmulq_f64(a.low, b.low), vmulq_f64(a.high, b.high)}; }
  static V madd(V a, V b, V c) { return {vfmaq_f64(c.low, a.low, b.low), vfmaq_f64(c.high, a.high, b.high)}; }
  static V msub(V a, V b, V c) { return madd(a, b, {vnegq_f64(c.low), vnegq_f64(c.high)}); }
  /// The second one if the first is no number, as in the other sets.
  static V max(V a, V b) {
    return {vbslq_f64(vcgtq_f64(a.low, b.low), a.low, b.low),
            vbslq_f64(vcgtq_f64(a.high, b.high), a.high, b.high)};
  }
  static V inverse(V a) {
    const float64x2_t one = vdupq_n_f64(1);
    return {vdivq_f64(one, a.low), vdivq_f64(one, a.high)};
  }
  static V over_root(V, V s) { return {vsqrtq_f64(s.low), vsqrtq_f64(s.high)}; }
  /// 2^n of integers n in -1022..1023.
  static V power_of_two(V n) {
    const V shifted = add(n, set1(0x1.8p52 + 1023));
    return {vreinterpretq_f64_s64(vshlq_n_s64(vreinterpretq_s64_f64(shifted.low), 52)),
            vreinterpretq_f64_s64(vshlq_n_s64(vreinterpretq_s64_f64(shifted.high), 52))};
  }
  static Lanes less(V a, V b, std::uint32_t mask, int which) {
    const uint64x2_t bits = vdupq_n_u64(mask >> (4 * which)), first = {1, 2}, second = {4, 8};
    return {vandq_u64(vcltq_f64(a.low, b.low), vtstq_u64(bits, first)),
            vandq_u64(vcltq_f64(a.high, b.high), vtstq_u64(bits, second))};
  }
  static V keep(Lanes lanes, V a) {
    return {vreinterpretq_f64_u64(vandq_u64(lanes.low, vreinterpretq_u64_f64(a.low))),
            vreinterpretq_f64_u64(vandq_u64(lanes.high, vreinterpretq_u64_f64(a.high)))};
  }
  static V floor(V a) { return {vrndmq_f64(a.low), vrndmq_f64(a.high)}; }
  /// As in single precision.
  static void gather_two(const double* from, V n, V& first, V& second) {
    const int64x2_t low = vcvtq_s64_f64(n.low), high = vcvtq_s64_f64(n.high);
    const float64x2_t a = vld1q_f64(from + vgetq_lane_s64(low, 0)),
                      b = vld1q_f64(from + vgetq_lane_s64(low, 1));
    const float64x2_t c = vld1q_f64(from + vgetq_lane_s64(high, 0)),
                      d = vld1q_f64(from + vgetq_lane_s64(high, 1));
    first = {vzip1q_f64(a, b), vzip1q_f64(c, d)};
    second = {vzip2q_f64(a, b), vzip2q_f64(c, d)};
  }
  static V spread(const double* four, int which) { return set1(four[which]); }
  static V repeat(const double* four) { return load(four); }
  static V difference(V a, V b) { return sub(a, b); }
  static Cluster load_cluster(const ClusterOfFour<double>& at, const ClusterShift<double>& shift) {
    const ClusterOfFour<double>& by = shift.whole;
    return {add(load(at.x), load(by.x)), add(load(at.y), load(by.y)), add(load(at.z), load(by.z))};
  }
  static V of_four(double a, double b, double c, double d) { return {float64x2_t{a, b}, float64x2_t{c, d}}; }
  using Columns = const std::int32_t*;
  static Columns columns(const std::int32_t* four) { return four; }
  static V lookup(const double* table, std::int32_t, const std::int32_t* row, Columns column, int which) {
    return gather(table + row[which], column);
  }
  static V over_i(const V* registers) {
    return add(add(registers[0], registers[1]), add(registers[2], registers[3]));
  }
  static void add_over_i(const Coordinates<NeonDouble>& force, ClusterOfFour<double>& to) {
    store(to.x, add(load(to.x), over_i(force.x)));
    store(to.y, add(load(to.y), over_i(force.y)));
    store(to.z, add(load(to.z), over_i(force.z)));
  }
  static V over_j(const V* registers) {
    const auto lanes_sum = [](V a) { return vaddq_f64(a.low, a.high); };
    return {vpaddq_f64(lanes_sum(registers[0]), lanes_sum(registers[1])),
            vpaddq_f64(lanes_sum(registers[2]), lanes_sum(registers[3]))};
  }
  static void subtract_over_j(const Coordinates<NeonDouble>& force, ClusterOfFour<double>& to) {
    store(to.x, sub(load(to.x), over_j(force.x)));
    store(to.y, sub(load(to.y), over_j(force.y)));
    store(to.z, sub(load(to.z), over_j(force.z)));
  }
  static void tally_over_i(V a, double* to) { store(to, add(load(to), a)); }
  static void tally_over_j(const V* registers, double* to) { tally_over_i(over_j(registers), to); }
  static double sum(V a) { return vaddvq_f64(vaddq_f64(a.low, a.high)); }
  static std::uint32_t bits(Lanes lanes) {
    const uint64x2_t first = {1, 2}, second = {4, 8};
    const uint64x2_t all = vorrq_u64(vandq_u64(lanes.low, first), vandq_u64(lanes.high, second));
    return static_cast<std::uint32_t>(vaddvq_u64(all));
  }
  static V gather(const double* from, const std::int32_t* at) {
    return of_four(from[at[0]], from[at[1]], from[at[2]], from[at[3]]);
  }
  /// By loads of x and y at once.
  static void gather_xyz(const double* from, const std::int32_t* at, V& x, V& y, V& z) {
    const auto point = [&](int lane) { return from + 3 * static_cast<std::ptrdiff_t>(at[lane]); };
    const double *const a = point(0), *const b = point(1), *const c = point(2), *const d = point(3);
    const V of_ab{vld1q_f64(a), vld1q_f64(b)}, of_cd{vld1q_f64(c), vld1q_f64(d)};
    x = {vzip1q_f64(of_ab.low, of_ab.high), vzip1q_f64(of_cd.low, of_cd.high)};
    y = {vzip2q_f64(of_ab.low, of_ab.high), vzip2q_f64(of_cd.low, of_cd.high)};
    z = of_four(a[2], b[2], c[2], d[2]);
  }
};

}  // namespace
}  // namespace dch::detail
