// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <dch/base/vec3.hpp>

/// What a fuzzer calls with each input (the interface of LLVM's libFuzzer); returns 0.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace dch::fuzz {

/// A property does not hold: the message goes to stderr and the process aborts, which a fuzzer takes for a
/// finding.
[[noreturn]] inline void fail(const std::string& what) {
  std::fprintf(stderr, "fuzz target: %s\n", what.c_str());
  std::abort();
}

/// Fails unless a check that returns the first fault it finds has found none.
inline void require_none(const std::string& fault, const std::string& where) {
  if (!fault.empty()) fail(where + ": " + fault);
}

/// Turns the bytes of an input into decisions, one after the other; zeros once they are used up. Few bytes
/// make a decision, so that changing a byte changes one decision.
class FuzzInput {
 public:
  FuzzInput(const std::uint8_t* data, std::size_t size) : next_(data), end_(data + size) {}

  bool empty() const { return next_ == end_; }
  std::uint8_t byte() { return empty() ? std::uint8_t{0} : *next_++; }
  bool coin() { return (byte() & 1) != 0; }

  /// In {0, ..., count - 1}; count from 1 to 65536.
  std::size_t below(std::size_t count) {
    const std::size_t value = count <= 256 ? byte() : static_cast<std::size_t>(byte()) << 8 | byte();
    return value % count;
  }

  /// In [0, 1), a multiple of 1/65536: distances tie often.
  double uniform() {
    const unsigned high = byte(), low = byte();
    return (256.0 * high + low) / 65536;
  }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// In the cube [-half_side, half_side)^3.
  Vec3 in_cube(double half_side) {
    const double x = uniform(-half_side, half_side), y = uniform(-half_side, half_side);
    return {x, y, uniform(-half_side, half_side)};
  }

  std::string rest() {
    std::string text(reinterpret_cast<const char*>(next_), static_cast<std::size_t>(end_ - next_));
    next_ = end_;
    return text;
  }

 private:
  const std::uint8_t* next_;
  const std::uint8_t* end_;
};

}  // namespace dch::fuzz
