// SPDX-License-Identifier: MIT
//
// The loop of bin_points.hpp over vectors of `kWidth` doubles, as many as a register holds: included once for
// each instruction set. No function of a library is called, since one compiled for a wider set could then be
// linked into all.
#pragma once

#include "simd/bin_points.hpp"

namespace dch::detail {
namespace {

template <int kWidth>
struct BinLanes {
  using Doubles __attribute__((vector_size(kWidth * sizeof(double)))) = double;
  using Bits __attribute__((vector_size(kWidth * sizeof(std::int64_t)))) = std::int64_t;
  using Bins __attribute__((vector_size(kWidth * sizeof(std::int32_t)))) = std::int32_t;
  using Words __attribute__((vector_size(kWidth * sizeof(double)))) = std::int16_t;
};

// References and memcpy, since vectors are no arguments where another set might be in use.
template <class Vector, class T>
[[gnu::always_inline]] inline void load(Vector& to, const T* from) {
  __builtin_memcpy(&to, from, sizeof to);
}
template <class Vector, class T>
[[gnu::always_inline]] inline void store(const Vector& from, T* to) {
  __builtin_memcpy(to, &from, sizeof from);
}

/// The lowest 16 bits of each lane.
template <int kWidth>
[[gnu::always_inline]] inline void store_low_words(const typename BinLanes<kWidth>::Doubles& from,
                                                   std::int16_t* to) {
  typename BinLanes<kWidth>::Words words;
  store(from, &words);
  if constexpr (kWidth == 8) {
    store(__builtin_shufflevector(words, words, 0, 4, 8, 12, 16, 20, 24, 28), to);
  } else {
    for (int lane = 0; lane < kWidth; ++lane) to[lane] = words[4 * lane];
  }
}

/// The coordinates of kBlock points. Marks those that are not in the box.
template <int kWidth>
[[gnu::always_inline]] inline void bin_block(const BrickBins& bins, const double* positions,
                                             std::int32_t* bin, std::int16_t* rounded,
                                             typename BinLanes<kWidth>::Bits& outside) {
  using Doubles = typename BinLanes<kWidth>::Doubles;
  constexpr double kAbove = 1 << 30;   // above 0, to cut off is to round down
  constexpr double kWhole = 0x1.8p52;  // numbers about this one are integers, which stand in their low bits
  for (int k = 0; k < BrickBins::kNumbers; k += kWidth) {
    Doubles low, high, length, x, from, per, least, most;
    load(low, bins.low + k);
    load(high, bins.high + k);
    load(length, bins.length + k);
    load(x, positions + k);
    const Doubles above = x >= high ? x - length : x;
    x = x < low ? x + length : above;
    outside |= (x < low) | (x >= high);
    load(from, bins.origin + k);
    load(per, bins.per_bin + k);
    load(least, bins.least + k);
    load(most, bins.most + k);
    Doubles u = (x - from) * per;
    u = u < least ? least : u;
    u = u > most ? most : u;
    using Bins = typename BinLanes<kWidth>::Bins;
    store(__builtin_convertvector(u + kAbove, Bins) - (1 << 30), bin + k);
    load(from, bins.zero + k);
    load(per, bins.per_unit + k);
    const Doubles whole = (x - from) * per + kWhole;
    store_low_words<kWidth>(whole, rounded + k);
  }
}

template <int kWidth>
bool bin_points_loops(const BrickBins& bins, const double* positions, std::int32_t count, std::int32_t* bin,
                      std::int16_t* rounded) {
  typename BinLanes<kWidth>::Bits outside{};
  const std::int32_t whole = count / kBlock * kBlock, left = count - whole;
  for (std::int32_t k = 0; k < 3 * whole; k += BrickBins::kNumbers)
    bin_block<kWidth>(bins, positions + k, bin + k, rounded + k, outside);
  if (left > 0) {  // empty lanes repeat the first point
    double last[BrickBins::kNumbers];
    std::int32_t last_bin[BrickBins::kNumbers];
    std::int16_t last_rounded[BrickBins::kNumbers];
    for (int k = 0; k < BrickBins::kNumbers; ++k) last[k] = positions[3 * whole + (k < 3 * left ? k : k % 3)];
    bin_block<kWidth>(bins, last, last_bin, last_rounded, outside);
    for (int k = 0; k < 3 * left; ++k) {
      bin[3 * whole + k] = last_bin[k];
      rounded[3 * whole + k] = last_rounded[k];
    }
  }
  std::int64_t any_outside = 0;
  for (int lane = 0; lane < kWidth; ++lane) any_outside |= outside[lane];
  return any_outside == 0;
}

}  // namespace
}  // namespace dch::detail
