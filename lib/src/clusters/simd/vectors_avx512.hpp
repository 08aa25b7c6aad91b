// SPDX-License-Identifier: MIT
//
// Vectors of AVX-512. See cluster_loops.hpp.
#pragma once

#include <immintrin.h>

#include "clusters/simd/cluster_loops.hpp"

namespace dch::detail {
namespace {

/// All 16 pairs in one register.
struct Avx512Float {
  using Real = float;
  using V = __m512;
  using Where = __m512i;
  struct Cluster {
    Where x, y, z;
  };
  static constexpr int kLanes = 16, kRegisters = 1;

  static V zero() { return _mm512_setzero_ps(); }
  static V set1(float v) { return _mm512_set1_ps(v); }
  static V load(const float* p) { return _mm512_loadu_ps(p); }
  static void store(float* p, V a) { _mm512_store_ps(p, a); }
  static V add(V a, V b) { return _mm512_add_ps(a, b); }
  static V sub(V a, V b) { return _mm512_sub_ps(a, b); }
  static V mul(V a, V b) { return _mm512_mul_ps(a, b); }
  static V max(V a, V b) { return _mm512_max_ps(a, b); }
  static V madd(V a, V b, V c) { return _mm512_fmadd_ps(a, b, c); }
  static V msub(V a, V b, V c) { return _mm512_fmsub_ps(a, b, c); }
  /// By an estimate of 14 bits and a Newton step, as division and root keep their unit busy for longer than
  /// all other operations of a pair take together. Good to a unit in the last place or two.
  static V inverse(V a) {
    const V estimate = _mm512_rcp14_ps(a);
    return madd(estimate, _mm512_fnmadd_ps(a, estimate, set1(1)), estimate);
  }
  static V over_root(V r2, V s) {
    const V estimate = _mm512_rsqrt14_ps(r2), half = set1(0.5f);
    const V rest = _mm512_fnmadd_ps(mul(r2, estimate), mul(half, estimate), half);
    return _mm512_maskz_fmadd_ps(_mm512_cmp_ps_mask(s, zero(), _CMP_NEQ_OQ), estimate, rest, estimate);
  }
  /// 2^n of integers n in -126..127.
  static V power_of_two(V n) {
    return _mm512_castsi512_ps(_mm512_slli_epi32(_mm512_castps_si512(add(n, set1(0x1.8p23f + 127))), 23));
  }
  static std::uint32_t bits_at_most(V a, V b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
  static __mmask16 less(V a, V b, std::uint32_t mask, int) {
    return _mm512_mask_cmp_ps_mask(static_cast<__mmask16>(mask), a, b, _CMP_LT_OQ);
  }
  static std::uint32_t bits(__mmask16 lanes) { return lanes; }
  static V keep(__mmask16 lanes, V a) { return _mm512_maskz_mov_ps(lanes, a); }
  static V floor(V a) { return _mm512_floor_ps(a); }
  /// Numbers n and n + 1 of an array, n being an integer in each lane; both are gathered at once.
  static void gather_two(const float* from, V n, V& first, V& second) {
    const __m512i at = _mm512_cvttps_epi32(n);
    const __m512 low = _mm512_castpd_ps(_mm512_i32gather_pd(_mm512_castsi512_si256(at), from, 4));
    const __m512 high = _mm512_castpd_ps(_mm512_i32gather_pd(_mm512_extracti64x4_epi64(at, 1), from, 4));
    const __m512i even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
    first = _mm512_permutex2var_ps(low, even, high);
    second = _mm512_permutex2var_ps(low, _mm512_add_epi32(even, _mm512_set1_epi32(1)), high);
  }
  static __m512i slots() { return _mm512_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3); }
  static V spread(const float* four, int) {
    return _mm512_permutexvar_ps(slots(), _mm512_broadcast_f32x4(_mm_load_ps(four)));
  }
  static Where repeat(const std::int32_t* four) {
    return _mm512_broadcast_i32x4(_mm_load_si128(reinterpret_cast<const __m128i*>(four)));
  }
  static Where spread(const std::int32_t* four, int) {
    return _mm512_permutexvar_epi32(slots(), repeat(four));
  }
  static V difference(Where a, Where b) { return _mm512_cvtepi32_ps(_mm512_sub_epi32(a, b)); }
  static V repeat(const float* four) { return _mm512_broadcast_f32x4(_mm_load_ps(four)); }
  static Cluster load_cluster(const ClusterUnits& at, const ClusterShift<float>& shift) {
    const auto moved = [&](const std::int32_t* four, int axis) {
      return _mm512_add_epi32(repeat(four), _mm512_set1_epi32(shift.axis[axis]));
    };
    return {moved(at.x, 0), moved(at.y, 1), moved(at.z, 2)};
  }
  /// Of the second four where bits are set, of the first elsewhere.
  static V repeat_either(const float* first, std::uint32_t of_second, const float* second) {
    return _mm512_mask_broadcast_f32x4(repeat(first), static_cast<__mmask16>(of_second), _mm_load_ps(second));
  }
  static Where repeat_either(const std::int32_t* first, std::uint32_t of_second, const std::int32_t* second) {
    return _mm512_mask_broadcast_i32x4(columns(first), static_cast<__mmask16>(of_second),
                                       _mm_loadu_si128(reinterpret_cast<const __m128i*>(second)));
  }
  /// Of rows whose shift was taken from cluster I.
  static Cluster load_cluster(const ClusterUnits& at) { return {repeat(at.x), repeat(at.y), repeat(at.z)}; }
  static Cluster load_clusters(const ClusterUnits& first, std::uint32_t of_second,
                               const ClusterUnits& second) {
    return {repeat_either(first.x, of_second, second.x), repeat_either(first.y, of_second, second.y),
            repeat_either(first.z, of_second, second.z)};
  }
  static Where less_shift(Where a, std::int32_t shift) {
    return _mm512_sub_epi32(a, _mm512_set1_epi32(shift));
  }
  /// Adds products to the second numbers where bits are set, to the first elsewhere.
  static void add_either(V a, V b, float* first, std::uint32_t of_second, float* second) {
    const auto bits = static_cast<__mmask16>(of_second);
    add_where(_knot_mask16(bits), a, b, first);
    add_where(bits, a, b, second);
  }
  /// All lanes are written: compilers would write a few alone, which takes longer.
  static void add_where(__mmask16 bits, V a, V b, float* to) {
    V sum = _mm512_mask3_fmadd_ps(a, b, _mm512_load_ps(to), bits);
    asm("" : "+v"(sum));
    _mm512_store_ps(to, sum);
  }
  using Columns = Where;
  static Columns columns(const std::int32_t* four) {
    return _mm512_broadcast_i32x4(_mm_loadu_si128(reinterpret_cast<const __m128i*>(four)));
  }
  static V lookup(const float* table, std::int32_t types, const std::int32_t* row, Columns columns, int) {
    const __m512i rows = _mm512_permutexvar_epi32(
        slots(), _mm512_broadcast_i32x4(_mm_loadu_si128(reinterpret_cast<const __m128i*>(row))));
    const __m512i at = _mm512_add_epi32(rows, columns);
    if (types <= kFewTypes) return _mm512_permutexvar_ps(at, _mm512_loadu_ps(table));
    return _mm512_i32gather_ps(at, table, 4);
  }
  /// The sums over the four 128-bit parts of x, y and z, as a cluster.
  static V fold(V x, V y, V z) {
    const V xy = add(_mm512_shuffle_f32x4(x, y, 0x44), _mm512_shuffle_f32x4(x, y, 0xEE));
    const V zz = add(z, _mm512_shuffle_f32x4(z, z, 0xEE));
    // The fourth part, that of ClusterOfFour::center, stays 0.
    return add(_mm512_shuffle_f32x4(xy, zz, 0x88), _mm512_maskz_shuffle_f32x4(0x0FFF, xy, zz, 0xDD));
  }
  static void add_over_i(const Coordinates<Avx512Float>& force, ClusterOfFour<float>& to) {
    _mm512_store_ps(&to, add(_mm512_load_ps(&to), fold(force.x[0], force.y[0], force.z[0])));
  }
  static __m128 over_j(V a) {
    const V pairs = add(a, _mm512_permute_ps(a, 0xB1));
    const V fours = add(pairs, _mm512_permute_ps(pairs, 0x4E));
    const __m512i first = _mm512_setr_epi32(0, 4, 8, 12, 0, 4, 8, 12, 0, 4, 8, 12, 0, 4, 8, 12);
    return _mm512_castps512_ps128(_mm512_permutexvar_ps(first, fours));
  }
  static void subtract_over_j(const Coordinates<Avx512Float>& force, ClusterOfFour<float>& to) {
    _mm_store_ps(to.x, _mm_sub_ps(_mm_load_ps(to.x), over_j(force.x[0])));
    _mm_store_ps(to.y, _mm_sub_ps(_mm_load_ps(to.y), over_j(force.y[0])));
    _mm_store_ps(to.z, _mm_sub_ps(_mm_load_ps(to.z), over_j(force.z[0])));
  }
  /// Sums over slots of I, of registers summed up, are added in double.
  static void tally_over_i(V a, double* to) {
    const __m256 two = _mm256_add_ps(_mm512_castps512_ps256(a), _mm512_extractf32x8_ps(a, 1));
    add_in_double(_mm_add_ps(_mm256_castps256_ps128(two), _mm256_extractf128_ps(two, 1)), to);
  }
  static void tally_either(V a, double* first, std::uint32_t of_second, double* second) {
    const auto bits = static_cast<__mmask16>(of_second);
    tally_over_i(keep(_knot_mask16(bits), a), first);
    tally_over_i(keep(bits, a), second);
  }
  static void tally_over_j(const V* registers, double* to) { add_in_double(over_j(registers[0]), to); }
  static void add_in_double(__m128 a, double* to) {
    _mm256_store_pd(to, _mm256_add_pd(_mm256_load_pd(to), _mm256_cvtps_pd(a)));
  }
  static double sum(V a) {
    return _mm512_reduce_add_pd(_mm512_add_pd(_mm512_cvtps_pd(_mm512_castps512_ps256(a)),
                                              _mm512_cvtps_pd(_mm512_extractf32x8_ps(a, 1))));
  }
};

/// The slots of cluster J twice over, with slots 2 p and 2 p + 1 of cluster I.
struct Avx512Double {
  using Real = double;
  using V = __m512d;
  using Where = V;
  struct Cluster {
    Where x, y, z;
  };
  static constexpr int kLanes = 8, kRegisters = 2;

  static V zero() { return _mm512_setzero_pd(); }
  static V load(const double* p) { return _mm512_loadu_pd(p); }
  static V set1(double v) { return _mm512_set1_pd(v); }
  static V add(V a, V b) { return _mm512_add_pd(a, b); }
  static V sub(V a, V b) { return _mm512_sub_pd(a, b); }
  static V mul(V a, V b) { return _mm512_mul_pd(a, b); }
  static V difference(V a, V b) { return sub(a, b); }
  static V madd(V a, V b, V c) { return _mm512_fmadd_pd(a, b, c); }
  static V msub(V a, V b, V c) { return _mm512_fmsub_pd(a, b, c); }
  static V max(V a, V b) { return _mm512_max_pd(a, b); }
  static V inverse(V a) { return _mm512_div_pd(set1(1), a); }
  static V over_root(V, V s) { return _mm512_sqrt_pd(s); }
  /// 2^n of integers n in -1022..1023.
  static V power_of_two(V n) {
    return _mm512_castsi512_pd(_mm512_slli_epi64(_mm512_castpd_si512(add(n, set1(0x1.8p52 + 1023))), 52));
  }
  static __mmask8 less(V a, V b, std::uint32_t mask, int which) {
    return _mm512_mask_cmp_pd_mask(static_cast<__mmask8>(mask >> (8 * which)), a, b, _CMP_LT_OQ);
  }
  static V keep(__mmask8 lanes, V a) { return _mm512_maskz_mov_pd(lanes, a); }
  static V floor(V a) { return _mm512_floor_pd(a); }
  /// As in single precision.
  static void gather_two(const double* from, V n, V& first, V& second) {
    const __m256i at = _mm512_cvttpd_epi32(n);
    first = _mm512_i32gather_pd(at, from, 8);
    second = _mm512_i32gather_pd(at, from + 1, 8);
  }
  static V spread(const double* four, int which) {
    const __m512i slot =
        which == 0 ? _mm512_setr_epi64(0, 0, 0, 0, 1, 1, 1, 1) : _mm512_setr_epi64(2, 2, 2, 2, 3, 3, 3, 3);
    return _mm512_permutexvar_pd(slot, _mm512_broadcast_f64x4(_mm256_load_pd(four)));
  }
  static V repeat(const double* four) { return _mm512_broadcast_f64x4(_mm256_load_pd(four)); }
  static V twice(const double* at, const double* shift) {
    return _mm512_broadcast_f64x4(_mm256_add_pd(_mm256_load_pd(at), _mm256_load_pd(shift)));
  }
  static Cluster load_cluster(const ClusterOfFour<double>& at, const ClusterShift<double>& shift) {
    return {twice(at.x, shift.whole.x), twice(at.y, shift.whole.y), twice(at.z, shift.whole.z)};
  }
  using Columns = const std::int32_t*;
  static Columns columns(const std::int32_t* four) { return four; }
  static V lookup(const double* table, std::int32_t types, const std::int32_t* row, Columns column,
                  int which) {
    const __m128i columns = _mm_loadu_si128(reinterpret_cast<const __m128i*>(column));
    const __m128i first = _mm_add_epi32(columns, _mm_set1_epi32(row[2 * which]));
    const __m128i second = _mm_add_epi32(columns, _mm_set1_epi32(row[2 * which + 1]));
    const __m256i at = _mm256_set_m128i(second, first);
    if (types <= kFewTypes)
      return _mm512_permutex2var_pd(_mm512_loadu_pd(table), _mm512_cvtepi32_epi64(at),
                                    _mm512_loadu_pd(table + 8));
    return _mm512_i32gather_pd(at, table, 8);
  }
  static __m256d over_i(const V* registers) {
    const V both = add(registers[0], registers[1]);
    return _mm256_add_pd(_mm512_castpd512_pd256(both), _mm512_extractf64x4_pd(both, 1));
  }
  static void add_over_i(const Coordinates<Avx512Double>& force, ClusterOfFour<double>& to) {
    _mm256_store_pd(to.x, _mm256_add_pd(_mm256_load_pd(to.x), over_i(force.x)));
    _mm256_store_pd(to.y, _mm256_add_pd(_mm256_load_pd(to.y), over_i(force.y)));
    _mm256_store_pd(to.z, _mm256_add_pd(_mm256_load_pd(to.z), over_i(force.z)));
  }
  static __m256d over_j(const V* registers) {
    const V even = _mm512_unpacklo_pd(registers[0], registers[1]),
            odd = _mm512_unpackhi_pd(registers[0], registers[1]);
    const V pairs = add(even, odd);  // two sums of slots 0 and 2 of I each, then of 1 and 3
    const __m512i first = _mm512_setr_epi64(0, 4, 1, 5, 0, 4, 1, 5);
    const __m512i second = _mm512_setr_epi64(2, 6, 3, 7, 2, 6, 3, 7);
    return _mm256_add_pd(_mm512_castpd512_pd256(_mm512_permutexvar_pd(first, pairs)),
                         _mm512_castpd512_pd256(_mm512_permutexvar_pd(second, pairs)));
  }
  static void subtract_over_j(const Coordinates<Avx512Double>& force, ClusterOfFour<double>& to) {
    _mm256_store_pd(to.x, _mm256_sub_pd(_mm256_load_pd(to.x), over_j(force.x)));
    _mm256_store_pd(to.y, _mm256_sub_pd(_mm256_load_pd(to.y), over_j(force.y)));
    _mm256_store_pd(to.z, _mm256_sub_pd(_mm256_load_pd(to.z), over_j(force.z)));
  }
  static void add_four(__m256d a, double* to) { _mm256_store_pd(to, _mm256_add_pd(_mm256_load_pd(to), a)); }
  static void tally_over_i(V a, double* to) {
    add_four(_mm256_add_pd(_mm512_castpd512_pd256(a), _mm512_extractf64x4_pd(a, 1)), to);
  }
  static void tally_over_j(const V* registers, double* to) { add_four(over_j(registers), to); }
  static double sum(V a) { return _mm512_reduce_add_pd(a); }
  static std::uint32_t bits(__mmask8 lanes) { return lanes; }
  static void store(double* p, V a) { _mm512_store_pd(p, a); }
  static V gather(const double* from, const std::int32_t* at) {
    return _mm512_i32gather_pd(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(at)), from, 8);
  }
  /// By loads and shuffles: in registers r, points 0 to 3 stand in the lower halves, 4 to 7 in the upper
  /// ones.
  static void gather_xyz(const double* from, const std::int32_t* at, V& x, V& y, V& z) {
    const auto point = [&](int lane) {
      return _mm256_maskz_loadu_pd(7, from + 3 * static_cast<std::ptrdiff_t>(at[lane]));
    };
    const auto two = [&](int lane) {
      return _mm512_insertf64x4(_mm512_castpd256_pd512(point(lane)), point(lane + 4), 1);
    };
    const V a = two(0), b = two(1), c = two(2), d = two(3);
    const V xz_of_ab = _mm512_unpacklo_pd(a, b), y_of_ab = _mm512_unpackhi_pd(a, b);
    const V xz_of_cd = _mm512_unpacklo_pd(c, d), y_of_cd = _mm512_unpackhi_pd(c, d);
    const __m512i first = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
    const __m512i second = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
    x = _mm512_permutex2var_pd(xz_of_ab, first, xz_of_cd);
    y = _mm512_permutex2var_pd(y_of_ab, first, y_of_cd);
    z = _mm512_permutex2var_pd(xz_of_ab, second, xz_of_cd);
  }
};

}  // namespace
}  // namespace dch::detail
