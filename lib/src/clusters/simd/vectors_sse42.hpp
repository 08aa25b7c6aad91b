// SPDX-License-Identifier: MIT
//
// Vectors of SSE4.2. See cluster_loops.hpp.
#pragma once

#include <immintrin.h>

#include "clusters/simd/cluster_loops.hpp"

namespace dch::detail {
namespace {

/// The slots of cluster J, with slot p of cluster I.
struct SseFloat {
  using Real = float;
  using V = __m128;
  using Where = __m128i;
  struct Cluster {
    Where x, y, z;
  };
  static constexpr int kLanes = 4, kRegisters = 4;

  static V zero() { return _mm_setzero_ps(); }
  static V set1(float v) { return _mm_set1_ps(v); }
  static V load(const float* p) { return _mm_loadu_ps(p); }
  static void store(float* p, V a) { _mm_storeu_ps(p, a); }
  static V add(V a, V b) { return _mm_add_ps(a, b); }
  static V sub(V a, V b) { return _mm_sub_ps(a, b); }
  static V mul(V a, V b) { return _mm_mul_ps(a, b); }
  static V max(V a, V b) { return _mm_max_ps(a, b); }
  static V madd(V a, V b, V c) { return add(mul(a, b), c); }
  static V msub(V a, V b, V c) { return sub(mul(a, b), c); }
  static V inverse(V a) { return _mm_div_ps(set1(1), a); }
  static V over_root(V, V s) { return _mm_sqrt_ps(s); }
  /// 2^n of integers n in -126..127.
  static V power_of_two(V n) {
    return _mm_castsi128_ps(_mm_slli_epi32(_mm_castps_si128(add(n, set1(0x1.8p23f + 127))), 23));
  }
  static std::uint32_t bits_at_most(V a, V b) {
    return static_cast<std::uint32_t>(_mm_movemask_ps(_mm_cmple_ps(a, b)));
  }
  static V less(V a, V b, std::uint32_t mask, int which) {
    const __m128i lane = _mm_setr_epi32(1, 2, 4, 8);
    const __m128i bits = _mm_and_si128(_mm_set1_epi32(static_cast<int>(mask >> (4 * which))), lane);
    return _mm_and_ps(_mm_cmplt_ps(a, b), _mm_castsi128_ps(_mm_cmpeq_epi32(bits, lane)));
  }
  static std::uint32_t bits(V lanes) { return static_cast<std::uint32_t>(_mm_movemask_ps(lanes)); }
  static V keep(V lanes, V a) { return _mm_and_ps(lanes, a); }
  static V floor(V a) { return _mm_floor_ps(a); }
  /// Numbers n and n + 1 of an array, n being an integer in each lane.
  static void gather_two(const float* from, V n, V& first, V& second) {
    alignas(16) std::int32_t at[4];
    _mm_store_si128(reinterpret_cast<__m128i*>(at), _mm_cvttps_epi32(n));
    const auto two = [&](int lane) {
      const __m128i low = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from + at[lane]));
      return _mm_loadh_pi(_mm_castsi128_ps(low), reinterpret_cast<const __m64*>(from + at[lane + 1]));
    };
    const V a = two(0), b = two(2);
    first = _mm_shuffle_ps(a, b, 0x88);
    second = _mm_shuffle_ps(a, b, 0xDD);
  }
  static V spread(const float* four, int which) { return _mm_set1_ps(four[which]); }
  static V repeat(const float* four) { return _mm_load_ps(four); }
  static Where spread(const std::int32_t* four, int which) { return _mm_set1_epi32(four[which]); }
  static Where load(const std::int32_t* four) {
    return _mm_load_si128(reinterpret_cast<const __m128i*>(four));
  }
  static V difference(Where a, Where b) { return _mm_cvtepi32_ps(_mm_sub_epi32(a, b)); }
  static Cluster load_cluster(const ClusterUnits& at, const ClusterShift<float>& shift) {
    const auto moved = [&](const std::int32_t* four, int axis) {
      return _mm_add_epi32(load(four), _mm_set1_epi32(shift.axis[axis]));
    };
    return {moved(at.x, 0), moved(at.y, 1), moved(at.z, 2)};
  }
  /// Of rows whose shift was taken from cluster I.
  static Cluster load_cluster(const ClusterUnits& at) { return {load(at.x), load(at.y), load(at.z)}; }
  static Where less_shift(Where a, std::int32_t shift) { return _mm_sub_epi32(a, _mm_set1_epi32(shift)); }
  using Columns = const std::int32_t*;
  static Columns columns(const std::int32_t* four) { return four; }
  static V lookup(const float* table, std::int32_t, const std::int32_t* row, Columns column, int which) {
    const float* const from = table + row[which];
    return _mm_setr_ps(from[column[0]], from[column[1]], from[column[2]], from[column[3]]);
  }
  static V over_i(const V* registers) {
    return add(add(registers[0], registers[1]), add(registers[2], registers[3]));
  }
  static void add_over_i(const Coordinates<SseFloat>& force, ClusterOfFour<float>& to) {
    _mm_store_ps(to.x, add(_mm_load_ps(to.x), over_i(force.x)));
    _mm_store_ps(to.y, add(_mm_load_ps(to.y), over_i(force.y)));
    _mm_store_ps(to.z, add(_mm_load_ps(to.z), over_i(force.z)));
  }
  static V over_j(const V* registers) {
    return _mm_hadd_ps(_mm_hadd_ps(registers[0], registers[1]), _mm_hadd_ps(registers[2], registers[3]));
  }
  static void subtract_over_j(const Coordinates<SseFloat>& force, ClusterOfFour<float>& to) {
    _mm_store_ps(to.x, sub(_mm_load_ps(to.x), over_j(force.x)));
    _mm_store_ps(to.y, sub(_mm_load_ps(to.y), over_j(force.y)));
    _mm_store_ps(to.z, sub(_mm_load_ps(to.z), over_j(force.z)));
  }
  /// Sums over slots of I, of registers summed up, are added in double.
  static void tally_over_i(V a, double* to) {
    _mm_store_pd(to, _mm_add_pd(_mm_load_pd(to), _mm_cvtps_pd(a)));
    _mm_store_pd(to + 2, _mm_add_pd(_mm_load_pd(to + 2), _mm_cvtps_pd(_mm_movehl_ps(a, a))));
  }
  static void tally_over_j(const V* registers, double* to) { tally_over_i(over_j(registers), to); }
  static double sum(V a) {
    const __m128d two = _mm_add_pd(_mm_cvtps_pd(a), _mm_cvtps_pd(_mm_movehl_ps(a, a)));
    return _mm_cvtsd_f64(_mm_add_sd(two, _mm_unpackhi_pd(two, two)));
  }
};

/// The same in two registers.
struct SseDouble {
  using Real = double;
  struct V {
    __m128d low, high;
  };
  using Where = V;
  struct Cluster {
    Where x, y, z;
  };
  static constexpr int kLanes = 4, kRegisters = 4;

  static V zero() { return {_mm_setzero_pd(), _mm_setzero_pd()}; }
  static V set1(double v) { return {_mm_set1_pd(v), _mm_set1_pd(v)}; }
  static V load(const double* p) { return {_mm_loadu_pd(p), _mm_loadu_pd(p + 2)}; }
  static void store(double* p, V a) {
    _mm_storeu_pd(p, a.low);
    _mm_storeu_pd(p + 2, a.high);
  }
  static V add(V a, V b) { return {_mm_add_pd(a.low, b.low), _mm_add_pd(a.high, b.high)}; }
  static V sub(V a, V b) { return {_mm_sub_pd(a.low, b.low), _mm_sub_pd(a.high, b.high)}; }
  static V difference(V a, V b) { return sub(a, b); }
  static V mul(V a, V b) { return {_mm_mul_pd(a.low, b.low), _mm_mul_pd(a.high, b.high)}; }
  static V madd(V a, V b, V c) { return add(mul(a, b), c); }
  static V msub(V a, V b, V c) { return sub(mul(a, b), c); }
  static V max(V a, V b) { return {_mm_max_pd(a.low, b.low), _mm_max_pd(a.high, b.high)}; }
  static V inverse(V a) {
    const __m128d one = _mm_set1_pd(1);
    return {_mm_div_pd(one, a.low), _mm_div_pd(one, a.high)};
  }
  static V over_root(V, V s) { return {_mm_sqrt_pd(s.low), _mm_sqrt_pd(s.high)}; }
  /// 2^n of integers n in -1022..1023.
  static V power_of_two(V n) {
    const V shifted = add(n, set1(0x1.8p52 + 1023));
    return {_mm_castsi128_pd(_mm_slli_epi64(_mm_castpd_si128(shifted.low), 52)),
            _mm_castsi128_pd(_mm_slli_epi64(_mm_castpd_si128(shifted.high), 52))};
  }
  static V less(V a, V b, std::uint32_t mask, int which) {
    const __m128i lane_low = _mm_set_epi64x(2, 1), lane_high = _mm_set_epi64x(8, 4);
    const __m128i bits = _mm_set1_epi64x(static_cast<long long>(mask >> (4 * which)));
    const __m128d in_low = _mm_castsi128_pd(_mm_cmpeq_epi64(_mm_and_si128(bits, lane_low), lane_low));
    const __m128d in_high = _mm_castsi128_pd(_mm_cmpeq_epi64(_mm_and_si128(bits, lane_high), lane_high));
    return {_mm_and_pd(_mm_cmplt_pd(a.low, b.low), in_low),
            _mm_and_pd(_mm_cmplt_pd(a.high, b.high), in_high)};
  }
  static V keep(V lanes, V a) { return {_mm_and_pd(lanes.low, a.low), _mm_and_pd(lanes.high, a.high)}; }
  static V floor(V a) { return {_mm_floor_pd(a.low), _mm_floor_pd(a.high)}; }
  /// As in single precision.
  static void gather_two(const double* from, V n, V& first, V& second) {
    alignas(16) std::int32_t at[4];
    _mm_store_si128(reinterpret_cast<__m128i*>(at),
                    _mm_unpacklo_epi64(_mm_cvttpd_epi32(n.low), _mm_cvttpd_epi32(n.high)));
    const auto two = [&](int lane) { return _mm_loadu_pd(from + at[lane]); };
    const __m128d a = two(0), b = two(1), c = two(2), d = two(3);
    first = {_mm_unpacklo_pd(a, b), _mm_unpacklo_pd(c, d)};
    second = {_mm_unpackhi_pd(a, b), _mm_unpackhi_pd(c, d)};
  }
  static V spread(const double* four, int which) { return set1(four[which]); }
  static V repeat(const double* four) { return load(four); }
  static Cluster load_cluster(const ClusterOfFour<double>& at, const ClusterShift<double>& shift) {
    const ClusterOfFour<double>& by = shift.whole;
    return {add(load(at.x), load(by.x)), add(load(at.y), load(by.y)), add(load(at.z), load(by.z))};
  }
  using Columns = const std::int32_t*;
  static Columns columns(const std::int32_t* four) { return four; }
  static V lookup(const double* table, std::int32_t, const std::int32_t* row, Columns column, int which) {
    const double* const from = table + row[which];
    return {_mm_setr_pd(from[column[0]], from[column[1]]), _mm_setr_pd(from[column[2]], from[column[3]])};
  }
  static V over_i(const V* registers) {
    return add(add(registers[0], registers[1]), add(registers[2], registers[3]));
  }
  static void add_over_i(const Coordinates<SseDouble>& force, ClusterOfFour<double>& to) {
    store(to.x, add(load(to.x), over_i(force.x)));
    store(to.y, add(load(to.y), over_i(force.y)));
    store(to.z, add(load(to.z), over_i(force.z)));
  }
  static V over_j(const V* registers) {
    const auto lanes_sum = [](V a) { return _mm_add_pd(a.low, a.high); };
    return {_mm_hadd_pd(lanes_sum(registers[0]), lanes_sum(registers[1])),
            _mm_hadd_pd(lanes_sum(registers[2]), lanes_sum(registers[3]))};
  }
  static void subtract_over_j(const Coordinates<SseDouble>& force, ClusterOfFour<double>& to) {
    store(to.x, sub(load(to.x), over_j(force.x)));
    store(to.y, sub(load(to.y), over_j(force.y)));
    store(to.z, sub(load(to.z), over_j(force.z)));
  }
  static void tally_over_i(V a, double* to) { store(to, add(load(to), a)); }
  static void tally_over_j(const V* registers, double* to) { tally_over_i(over_j(registers), to); }
  static double sum(V a) {
    const __m128d two = _mm_add_pd(a.low, a.high);
    return _mm_cvtsd_f64(_mm_add_sd(two, _mm_unpackhi_pd(two, two)));
  }
  static std::uint32_t bits(V lanes) {
    return static_cast<std::uint32_t>(_mm_movemask_pd(lanes.low) | _mm_movemask_pd(lanes.high) << 2);
  }
  static V gather(const double* from, const std::int32_t* at) {
    return {_mm_setr_pd(from[at[0]], from[at[1]]), _mm_setr_pd(from[at[2]], from[at[3]])};
  }
  static void gather_xyz(const double* from, const std::int32_t* at, V& x, V& y, V& z) {
    const double* const p[4] = {from + 3 * at[0], from + 3 * at[1], from + 3 * at[2], from + 3 * at[3]};
    x = {_mm_setr_pd(p[0][0], p[1][0]), _mm_setr_pd(p[2][0], p[3][0])};
    y = {_mm_setr_pd(p[0][1], p[1][1]), _mm_setr_pd(p[2][1], p[3][1])};
    z = {_mm_setr_pd(p[0][2], p[1][2]), _mm_setr_pd(p[2][2], p[3][2])};
  }
};

}  // namespace
}  // namespace dch::detail
