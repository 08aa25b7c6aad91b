// SPDX-License-Identifier: MIT
//
// Knots of a table with two numbers each, of which every lane loads two that are next to each other.
#pragma once

#include "simd/forms/style.hpp"

namespace dch::detail {
namespace {

/// For instruction sets without faster ones.
template <class S>
struct TwoKnots {
  using V = typename S::V;

  /// Both numbers of knot n, then both of n + 1, n being an integer in each lane.
  static void load(const typename S::Real* table, V n, V (&numbers)[4]) {
    const V first = S::add(n, n);
    S::gather_two(table, first, numbers[0], numbers[1]);
    S::gather_two(table, S::add(first, S::set1(2)), numbers[2], numbers[3]);
  }
};

}  // namespace
}  // namespace dch::detail
