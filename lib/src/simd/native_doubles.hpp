// SPDX-License-Identifier: MIT
//
// Vectors of the width of the registers of the instruction set that a source is compiled for. GCC takes wider
// ones apart by way of memory, and their comparisons number by number, which is slower than no vectors at
// all.
#pragma once

#include <cstdint>

namespace dch::detail {
namespace {

#if defined(__AVX512F__)
inline constexpr int kWidth = 8;
#elif defined(__AVX__)
inline constexpr int kWidth = 4;
#else
inline constexpr int kWidth = 2;
#endif

using Doubles __attribute__((vector_size(kWidth * sizeof(double)))) = double;
using Words __attribute__((vector_size(kWidth * sizeof(double)))) = std::uint64_t;

// Vectors are handed on by reference: how they are returned depends on the set.
inline void load(const double* from, Doubles& to) { __builtin_memcpy(&to, from, sizeof to); }

inline void store(const Doubles& from, double* to) { __builtin_memcpy(to, &from, sizeof from); }

}  // namespace
}  // namespace dch::detail
