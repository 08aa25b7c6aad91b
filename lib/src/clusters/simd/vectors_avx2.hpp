// SPDX-License-Identifier: MIT
//
// Vectors of AVX2. See cluster_loops.hpp.
#pragma once

#include <immintrin.h>

#include "clusters/simd/cluster_loops.hpp"

namespace dch::detail {
namespace {

/// The slots of cluster J twice over, with slots 2 p and 2 p + 1 of cluster I.
struct Avx2Float {
  using Real = float;
  using V = __m256;
  using Where = __m256i;
  struct Cluster {
    Where x, y, z;
  };
  static constexpr int kLanes = 8, kRegisters = 2;

  static V zero() { return _mm256_setzero_ps(); }
  static V set1(float v) { return _mm256_set1_ps(v); }
  static V load(const float* p) { return _mm256_loadu_ps(p); }
  static void store(float* p, V a) { _mm256_storeu_ps(p, a); }
  static V add(V a, V b) { return _mm256_add_ps(a, b); }
  static V sub(V a, V b) { return _mm256_sub_ps(a, b); }
  static V mul(V a, V b) { return _mm256_mul_ps(a, b); }
  static V max(V a, V b) { return _mm256_max_ps(a, b); }
  static V madd(V a, V b, V c) { return _mm256_fmadd_ps(a, b, c); }
  static V msub(V a, V b, V c) { return _mm256_fmsub_ps(a, b, c); }
  static V inverse(V a) { return _mm256_div_ps(set1(1), a); }
  static V over_root(V, V s) { return _mm256_sqrt_ps(s); }
  /// 2^n of integers n in -126..127.
  static V power_of_two(V n) {
    return _mm256_castsi256_ps(_mm256_slli_epi32(_mm256_castps_si256(add(n, set1(0x1.8p23f + 127))), 23));
  }
  static std::uint32_t bits_at_most(V a, V b) {
    return static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_LE_OQ)));
  }
  static V less(V a, V b, std::uint32_t mask, int which) {
    const __m256i lane = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    const __m256i bits = _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(mask >> (8 * which))), lane);
    return _mm256_and_ps(_mm256_cmp_ps(a, b, _CMP_LT_OQ),
                         _mm256_castsi256_ps(_mm256_cmpeq_epi32(bits, lane)));
  }
  static std::uint32_t bits(V lanes) { return static_cast<std::uint32_t>(_mm256_movemask_ps(lanes)); }
  static V keep(V lanes, V a) { return _mm256_and_ps(lanes, a); }
  static V floor(V a) { return _mm256_floor_ps(a); }
  /// Numbers n and n + 1 of an array, n being an integer in each lane. By loads of both, as gathers of each
  /// take longer (Zen 3).
  static void gather_two(const float* from, V n, V& first, V& second) {
    alignas(32) std::int32_t at[8];
    _mm256_store_si256(reinterpret_cast<__m256i*>(at), _mm256_cvttps_epi32(n));
    const auto two = [&](int lane) {
      const __m128i low = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from + at[lane]));
      return _mm_loadh_pi(_mm_castsi128_ps(low), reinterpret_cast<const __m64*>(from + at[lane + 1]));
    };
    const V a = _mm256_set_m128(two(4), two(0)), b = _mm256_set_m128(two(6), two(2));
    first = _mm256_shuffle_ps(a, b, 0x88);
    second = _mm256_shuffle_ps(a, b, 0xDD);
  }
  static V spread(const float* four, int which) {
    return _mm256_set_m128(_mm_set1_ps(four[2 * which + 1]), _mm_set1_ps(four[2 * which]));
  }
  static V twice(__m128 four) { return _mm256_set_m128(four, four); }
  static V repeat(const float* four) { return twice(_mm_load_ps(four)); }
  static Where spread(const std::int32_t* four, int which) {
    return _mm256_set_m128i(_mm_set1_epi32(four[2 * which + 1]), _mm_set1_epi32(four[2 * which]));
  }
  static Where twice(const std::int32_t* four) {
    return _mm256_broadcastsi128_si256(_mm_load_si128(reinterpret_cast<const __m128i*>(four)));
  }
  static V difference(Where a, Where b) { return _mm256_cvtepi32_ps(_mm256_sub_epi32(a, b)); }
  static Cluster load_cluster(const ClusterUnits& at, const ClusterShift<float>& shift) {
    const auto moved = [&](const std::int32_t* four, int axis) {
      return _mm256_add_epi32(twice(four), _mm256_set1_epi32(shift.axis[axis]));
    };
    return {moved(at.x, 0), moved(at.y, 1), moved(at.z, 2)};
  }
  /// Of rows whose shift was taken from cluster I.
  static Cluster load_cluster(const ClusterUnits& at) { return {twice(at.x), twice(at.y), twice(at.z)}; }
  static Where less_shift(Where a, std::int32_t shift) {
    return _mm256_sub_epi32(a, _mm256_set1_epi32(shift));
  }
  using Columns = const std::int32_t*;
  static Columns columns(const std::int32_t* four) { return four; }
  static V lookup(const float* table, std::int32_t types, const std::int32_t* row, Columns column,
                  int which) {
    const __m128i columns = _mm_loadu_si128(reinterpret_cast<const __m128i*>(column));
    if (types <= kFewTypes)
      return _mm256_permutevar_ps(
          _mm256_set_m128(_mm_loadu_ps(table + row[2 * which + 1]), _mm_loadu_ps(table + row[2 * which])),
          _mm256_set_m128i(columns, columns));
    const __m128i first = _mm_add_epi32(columns, _mm_set1_epi32(row[2 * which]));
    const __m128i second = _mm_add_epi32(columns, _mm_set1_epi32(row[2 * which + 1]));
    return _mm256_i32gather_ps(table, _mm256_set_m128i(second, first), 4);
  }
  static __m128 over_i(const V* registers) {
    const V both = add(registers[0], registers[1]);
    return _mm_add_ps(_mm256_castps256_ps128(both), _mm256_extractf128_ps(both, 1));
  }
  static void add_over_i(const Coordinates<Avx2Float>& force, ClusterOfFour<float>& to) {
    _mm_store_ps(to.x, _mm_add_ps(_mm_load_ps(to.x), over_i(force.x)));
    _mm_store_ps(to.y, _mm_add_ps(_mm_load_ps(to.y), over_i(force.y)));
    _mm_store_ps(to.z, _mm_add_ps(_mm_load_ps(to.z), over_i(force.z)));
  }
  static __m128 over_j(const V* registers) {
    const V pairs = _mm256_hadd_ps(registers[0], registers[1]);  // slots 0 and 2 of I, then 1 and 3
    const V fours = _mm256_hadd_ps(pairs, pairs);
    return _mm_unpacklo_ps(_mm256_castps256_ps128(fours), _mm256_extractf128_ps(fours, 1));
  }
  static void subtract_over_j(const Coordinates<Avx2Float>& force, ClusterOfFour<float>& to) {
    _mm_store_ps(to.x, _mm_sub_ps(_mm_load_ps(to.x), over_j(force.x)));
    _mm_store_ps(to.y, _mm_sub_ps(_mm_load_ps(to.y), over_j(force.y)));
    _mm_store_ps(to.z, _mm_sub_ps(_mm_load_ps(to.z), over_j(force.z)));
  }
  /// Sums over slots of I, of registers summed up, are added in double.
  static void tally_over_i(V a, double* to) {
    add_in_double(_mm_add_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1)), to);
  }
  static void tally_over_j(const V* registers, double* to) { add_in_double(over_j(registers), to); }
  static void add_in_double(__m128 a, double* to) {
    _mm256_store_pd(to, _mm256_add_pd(_mm256_load_pd(to), _mm256_cvtps_pd(a)));
  }
  static double sum(V a) {
    const __m256d four = _mm256_add_pd(_mm256_cvtps_pd(_mm256_castps256_ps128(a)),
                                       _mm256_cvtps_pd(_mm256_extractf128_ps(a, 1)));
    const __m128d two = _mm_add_pd(_mm256_castpd256_pd128(four), _mm256_extractf128_pd(four, 1));
    return _mm_cvtsd_f64(_mm_add_sd(two, _mm_unpackhi_pd(two, two)));
  }
};

/// The slots of cluster J, with slot p of cluster I.
struct Avx2Double {
  using Real = double;
  using V = __m256d;
  using Where = V;
  struct Cluster {
    Where x, y, z;
  };
  static constexpr int kLanes = 4, kRegisters = 4;

  static V zero() { return _mm256_setzero_pd(); }
  static V load(const double* p) { return _mm256_loadu_pd(p); }
  static V set1(double v) { return _mm256_set1_pd(v); }
  static V add(V a, V b) { return _mm256_add_pd(a, b); }
  static V sub(V a, V b) { return _mm256_sub_pd(a, b); }
  static V mul(V a, V b) { return _mm256_mul_pd(a, b); }
  static V difference(V a, V b) { return sub(a, b); }
  static V madd(V a, V b, V c) { return _mm256_fmadd_pd(a, b, c); }
  static V msub(V a, V b, V c) { return _mm256_fmsub_pd(a, b, c); }
  static V max(V a, V b) { return _mm256_max_pd(a, b); }
  static V inverse(V a) { return _mm256_div_pd(set1(1), a); }
  static V over_root(V, V s) { return _mm256_sqrt_pd(s); }
  /// 2^n of integers n in -1022..1023.
  static V power_of_two(V n) {
    return _mm256_castsi256_pd(_mm256_slli_epi64(_mm256_castpd_si256(add(n, set1(0x1.8p52 + 1023))), 52));
  }
  static V less(V a, V b, std::uint32_t mask, int which) {
    const __m256i lane = _mm256_setr_epi64x(1, 2, 4, 8);
    const __m256i bits =
        _mm256_and_si256(_mm256_set1_epi64x(static_cast<long long>(mask >> (4 * which))), lane);
    return _mm256_and_pd(_mm256_cmp_pd(a, b, _CMP_LT_OQ),
                         _mm256_castsi256_pd(_mm256_cmpeq_epi64(bits, lane)));
  }
  static V keep(V lanes, V a) { return _mm256_and_pd(lanes, a); }
  static V floor(V a) { return _mm256_floor_pd(a); }
  /// As in single precision.
  static void gather_two(const double* from, V n, V& first, V& second) {
    alignas(16) std::int32_t at[4];
    _mm_store_si128(reinterpret_cast<__m128i*>(at), _mm256_cvttpd_epi32(n));
    const V a = _mm256_set_m128d(_mm_loadu_pd(from + at[2]), _mm_loadu_pd(from + at[0]));
    const V b = _mm256_set_m128d(_mm_loadu_pd(from + at[3]), _mm_loadu_pd(from + at[1]));
    first = _mm256_unpacklo_pd(a, b);
    second = _mm256_unpackhi_pd(a, b);
  }
  static V spread(const double* four, int which) { return _mm256_set1_pd(four[which]); }
  static V repeat(const double* four) { return _mm256_load_pd(four); }
  static Cluster load_cluster(const ClusterOfFour<double>& at, const ClusterShift<double>& shift) {
    return {add(_mm256_load_pd(at.x), _mm256_load_pd(shift.whole.x)),
            add(_mm256_load_pd(at.y), _mm256_load_pd(shift.whole.y)),
            add(_mm256_load_pd(at.z), _mm256_load_pd(shift.whole.z))};
  }
  using Columns = const std::int32_t*;
  static Columns columns(const std::int32_t* four) { return four; }
  static V lookup(const double* table, std::int32_t types, const std::int32_t* row, Columns column,
                  int which) {
    const __m128i columns = _mm_loadu_si128(reinterpret_cast<const __m128i*>(column));
    if (types <= kFewTypes) {
      // The two halves of number k are the numbers 2 k and 2 k + 1 of 32 bits.
      const __m256i k = _mm256_cvtepi32_epi64(columns), low = _mm256_add_epi64(k, k);
      const __m256i high = _mm256_add_epi64(low, _mm256_set1_epi64x(1));
      return _mm256_castps_pd(_mm256_permutevar8x32_ps(_mm256_castpd_ps(_mm256_loadu_pd(table + row[which])),
                                                       _mm256_or_si256(low, _mm256_slli_epi64(high, 32))));
    }
    return _mm256_i32gather_pd(table, _mm_add_epi32(columns, _mm_set1_epi32(row[which])), 8);
  }
  static V over_i(const V* registers) {
    return add(add(registers[0], registers[1]), add(registers[2], registers[3]));
  }
  static void add_over_i(const Coordinates<Avx2Double>& force, ClusterOfFour<double>& to) {
    _mm256_store_pd(to.x, add(_mm256_load_pd(to.x), over_i(force.x)));
    _mm256_store_pd(to.y, add(_mm256_load_pd(to.y), over_i(force.y)));
    _mm256_store_pd(to.z, add(_mm256_load_pd(to.z), over_i(force.z)));
  }
  static V over_j(const V* registers) {
    const V low = _mm256_hadd_pd(registers[0], registers[1]),
            high = _mm256_hadd_pd(registers[2], registers[3]);
    return add(_mm256_permute2f128_pd(low, high, 0x20), _mm256_permute2f128_pd(low, high, 0x31));
  }
  static void subtract_over_j(const Coordinates<Avx2Double>& force, ClusterOfFour<double>& to) {
    _mm256_store_pd(to.x, sub(_mm256_load_pd(to.x), over_j(force.x)));
    _mm256_store_pd(to.y, sub(_mm256_load_pd(to.y), over_j(force.y)));
    _mm256_store_pd(to.z, sub(_mm256_load_pd(to.z), over_j(force.z)));
  }
  static void tally_over_i(V a, double* to) { _mm256_store_pd(to, add(_mm256_load_pd(to), a)); }
  static void tally_over_j(const V* registers, double* to) { tally_over_i(over_j(registers), to); }
  static double sum(V a) {
    const __m128d two = _mm_add_pd(_mm256_castpd256_pd128(a), _mm256_extractf128_pd(a, 1));
    return _mm_cvtsd_f64(_mm_add_sd(two, _mm_unpackhi_pd(two, two)));
  }
  static std::uint32_t bits(V lanes) { return static_cast<std::uint32_t>(_mm256_movemask_pd(lanes)); }
  static void store(double* p, V a) { _mm256_store_pd(p, a); }
  static V gather(const double* from, const std::int32_t* at) {
    return _mm256_i32gather_pd(from, _mm_loadu_si128(reinterpret_cast<const __m128i*>(at)), 8);
  }
  /// By loads and shuffles, with which pairs one by one take two thirds of their time with gathers (Zen 3).
  static void gather_xyz(const double* from, const std::int32_t* at, V& x, V& y, V& z) {
    const __m256i three = _mm256_setr_epi64x(-1, -1, -1, 0);
    const auto point = [&](int lane) {
      return _mm256_maskload_pd(from + 3 * static_cast<std::ptrdiff_t>(at[lane]), three);
    };
    const V a = point(0), b = point(1), c = point(2), d = point(3);
    const V xz_of_ab = _mm256_unpacklo_pd(a, b), y_of_ab = _mm256_unpackhi_pd(a, b);
    const V xz_of_cd = _mm256_unpacklo_pd(c, d), y_of_cd = _mm256_unpackhi_pd(c, d);
    x = _mm256_permute2f128_pd(xz_of_ab, xz_of_cd, 0x20);
    y = _mm256_permute2f128_pd(y_of_ab, y_of_cd, 0x20);
    z = _mm256_permute2f128_pd(xz_of_ab, xz_of_cd, 0x31);
  }
};

}  // namespace
}  // namespace dch::detail
