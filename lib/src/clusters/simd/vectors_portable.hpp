// SPDX-License-Identifier: MIT
//
// Vectors of the compiler's own, for any processor. See cluster_loops.hpp.
#pragma once

#include <cstring>

#include "clusters/simd/cluster_loops.hpp"

namespace dch::detail {
namespace {

/// Four numbers in a vector. A template has to name the type that it returns: GCC 12 refuses braces alone.
template <class Number>
struct FourLanes;
template <>
struct FourLanes<float> {
  float lane __attribute__((vector_size(16)));
};
template <>
struct FourLanes<double> {
  double lane __attribute__((vector_size(32)));
};
template <>
struct FourLanes<std::int32_t> {
  std::int32_t lane __attribute__((vector_size(16)));
};
template <>
struct FourLanes<std::int64_t> {
  std::int64_t lane __attribute__((vector_size(32)));
};
template <>
struct FourLanes<std::uint32_t> {
  std::uint32_t lane __attribute__((vector_size(16)));  // which wrap
};

/// The bit of each lane in a mask.
template <class Integer>
constexpr FourLanes<Integer> kBits{{1, 2, 4, 8}};

/// Four lanes: the slots of cluster J, with slot p of cluster I.
template <class Real_>
struct PortableVector {
  using Real = Real_;
  using V = FourLanes<Real>;
  using Units = FourLanes<std::uint32_t>;
  using Integer = std::conditional_t<std::is_same_v<Real, float>, std::int32_t, std::int64_t>;
  using Lanes = FourLanes<Integer>;  // -1 where something acts
  using Where = std::conditional_t<std::is_same_v<Real, float>, Units, V>;
  struct Cluster {
    Where x, y, z;
  };
  static constexpr int kLanes = 4, kRegisters = 4;

  template <class F>
  static V each(const F& f) {
    return V{{f(0), f(1), f(2), f(3)}};
  }
  static V zero() { return V{}; }
  static V set1(Real v) { return V{{v, v, v, v}}; }
  static V load(const Real* p) { return V{{p[0], p[1], p[2], p[3]}}; }
  static V add(const V& a, const V& b) { return V{a.lane + b.lane}; }
  static V sub(const V& a, const V& b) { return V{a.lane - b.lane}; }
  static V mul(const V& a, const V& b) { return V{a.lane * b.lane}; }
  static V max(const V& a, const V& b) { return V{a.lane > b.lane ? a.lane : b.lane}; }
  static V madd(const V& a, const V& b, const V& c) { return V{a.lane * b.lane + c.lane}; }
  static V msub(const V& a, const V& b, const V& c) { return V{a.lane * b.lane - c.lane}; }
  static V inverse(const V& a) { return V{1 / a.lane}; }
  static float root(float a) { return __builtin_sqrtf(a); }
  static double root(double a) { return __builtin_sqrt(a); }
  static V over_root(const V&, const V& s) {
    return each([&](int k) { return root(s.lane[k]); });
  }
  static V power_of_two(const V& n) {
    return each([&](int k) { return static_cast<Real>(__builtin_ldexp(1, static_cast<int>(n.lane[k]))); });
  }
  static std::uint32_t bits_at_most(const V& a, const V& b) {
    std::uint32_t bits = 0;
    for (int k = 0; k < 4; ++k) bits |= static_cast<std::uint32_t>(a.lane[k] <= b.lane[k]) << k;
    return bits;
  }
  static Lanes less(const V& a, const V& b, std::uint32_t mask, int which) {
    const Integer of_register = static_cast<Integer>(mask >> (4 * which));
    return Lanes{(a.lane < b.lane) & ((kBits<Integer>.lane & of_register) != 0)};
  }
  static V keep(const Lanes& lanes, const V& a) { return V{lanes.lane ? a.lane : zero().lane}; }
  static float floor(float a) { return __builtin_floorf(a); }
  static double floor(double a) { return __builtin_floor(a); }
  static V floor(const V& a) {
    return each([&](int k) { return floor(a.lane[k]); });
  }
  /// Numbers n and n + 1 of an array, n being an integer in each lane.
  static void gather_two(const Real* from, const V& n, V& first, V& second) {
    first = each([&](int k) { return from[static_cast<std::int32_t>(n.lane[k])]; });
    second = each([&](int k) { return from[static_cast<std::int32_t>(n.lane[k]) + 1]; });
  }
  static V spread(const Real* four, int which) { return set1(four[which]); }
  static V repeat(const Real* four) { return load(four); }
  static Units spread(const std::int32_t* four, int which) {
    return Units{Units{}.lane + static_cast<std::uint32_t>(four[which])};
  }
  static Units load_units(const std::int32_t* four) {
    Units units;
    std::memcpy(&units, four, sizeof units);
    return units;
  }
  static V difference(const V& a, const V& b) { return sub(a, b); }
  static V difference(const Units& a, const Units& b) {
    const Units d{a.lane - b.lane};
    return each([&](int k) { return static_cast<Real>(static_cast<std::int32_t>(d.lane[k])); });
  }
  static Cluster load_cluster(const ClusterUnits& at, const ClusterShift<float>& shift) {
    const auto moved = [&](const std::int32_t* four, int axis) {
      return Units{load_units(four).lane + static_cast<std::uint32_t>(shift.axis[axis])};
    };
    return {moved(at.x, 0), moved(at.y, 1), moved(at.z, 2)};
  }
  /// Of rows whose shift was taken from cluster I.
  static Cluster load_cluster(const ClusterUnits& at) {
    return {load_units(at.x), load_units(at.y), load_units(at.z)};
  }
  static Units less_shift(const Units& a, std::int32_t shift) {
    return Units{a.lane - static_cast<std::uint32_t>(shift)};
  }
  static Cluster load_cluster(const ClusterOfFour<double>& at, const ClusterShift<double>& shift) {
    const ClusterOfFour<double>& by = shift.whole;
    return {add(load(at.x), load(by.x)), add(load(at.y), load(by.y)), add(load(at.z), load(by.z))};
  }
  using Columns = const std::int32_t*;
  static Columns columns(const std::int32_t* four) { return four; }
  static V lookup(const Real* table, std::int32_t, const std::int32_t* row, Columns column, int which) {
    return each([&](int k) { return table[row[which] + column[k]]; });
  }
  static void add_registers(const V* registers, Real* four) {
    for (int k = 0; k < 4; ++k)
      four[k] +=
          (registers[0].lane[k] + registers[1].lane[k]) + (registers[2].lane[k] + registers[3].lane[k]);
  }
  static void add_over_i(const Coordinates<PortableVector>& force, ClusterOfFour<Real>& to) {
    add_registers(force.x, to.x);
    add_registers(force.y, to.y);
    add_registers(force.z, to.z);
  }
  static Real lanes_sum(const V& a) { return (a.lane[0] + a.lane[1]) + (a.lane[2] + a.lane[3]); }
  static void subtract_over_j(const Coordinates<PortableVector>& force, ClusterOfFour<Real>& to) {
    for (int p = 0; p < 4; ++p) {
      to.x[p] -= lanes_sum(force.x[p]);
      to.y[p] -= lanes_sum(force.y[p]);
      to.z[p] -= lanes_sum(force.z[p]);
    }
  }
  /// Sums over slots of I, of registers summed up, are added in double.
  static void tally_over_i(const V& a, double* to) {
    for (int k = 0; k < 4; ++k) to[k] += double{a.lane[k]};
  }
  static void tally_over_j(const V* registers, double* to) {
    for (int p = 0; p < 4; ++p) to[p] += double{lanes_sum(registers[p])};
  }
  static double sum(const V& a) {
    return (double{a.lane[0]} + double{a.lane[1]}) + (double{a.lane[2]} + double{a.lane[3]});
  }
  static std::uint32_t bits(const Lanes& lanes) {
    std::uint32_t bits = 0;
    for (int k = 0; k < 4; ++k) bits |= static_cast<std::uint32_t>(lanes.lane[k] & 1) << k;
    return bits;
  }
  static void store(Real* p, const V& a) {
    for (int k = 0; k < 4; ++k) p[k] = a.lane[k];
  }
  static V gather(const Real* from, const std::int32_t* at) {
    return each([&](int k) { return from[at[k]]; });
  }
  static void gather_xyz(const Real* from, const std::int32_t* at, V& x, V& y, V& z) {
    x = each([&](int k) { return from[3 * at[k]]; });
    y = each([&](int k) { return from[3 * at[k] + 1]; });
    z = each([&](int k) { return from[3 * at[k] + 2]; });
  }
};

}  // namespace
}  // namespace dch::detail
