// SPDX-License-Identifier: MIT
#include "gromacs/xtc_stream.hpp"

#include <bit>
#include <utility>

#include "gromacs/xtc_bits.hpp"

namespace dch::trajectory {
namespace {

/// Sizes of small steps: three numbers below the k-th one fit into k bits.
constexpr std::array<std::uint32_t, kLastSmall + 1> kSmallSizes{
    0,       0,       0,       0,       0,        0,        0,        0,       0,       8,       10,
    12,      16,      20,      25,      32,       40,       50,       64,      80,      101,     128,
    161,     203,     256,     322,     406,      512,      645,      812,     1024,    1290,    1625,
    2048,    2580,    3250,    4096,    5060,     6501,     8192,     10321,   13003,   16384,   20642,
    26007,   32768,   41285,   52015,   65536,    82570,    104031,   131072,  165140,  208063,  262144,
    330280,  416127,  524287,  660561,  832255,   1048576,  1321122,  1664510, 2097152, 2642245, 3329021,
    4194304, 5284491, 6658042, 8388607, 10568983, 13316085, 16777216, 0};

template <std::size_t... K>
constexpr std::array<PackedTriple, sizeof...(K)> small_steps(std::index_sequence<K...>) {
  return {PackedTriple(static_cast<unsigned>(K), kSmallSizes[K], kSmallSizes[K])...};
}
constexpr auto kSmallSteps = small_steps(std::make_index_sequence<kSmallSizes.size()>());

using Numbers = PackedTriple::Numbers;

class StreamDecoder {
 public:
  StreamDecoder(const XtcStream& stream, Bytes data, std::span<Vec3> positions)
      : bits_(data),
        positions_(positions),
        inverse_(static_cast<float>(1 / static_cast<double>(stream.precision))),
        small_(stream.small),
        large_(large_triple(stream.size)) {
    constexpr std::uint32_t kMaxPacked = 0xffffff;
    packed_ = (stream.size[0] | stream.size[1] | stream.size[2]) <= kMaxPacked;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low_[axis] = static_cast<std::uint32_t>(stream.low[axis]);
      size_[axis] = stream.size[axis];
      widths_[axis] = static_cast<unsigned>(std::bit_width(stream.size[axis]));
    }
    large_bits_ = packed_ ? large_.bits() : widths_[0] + widths_[1] + widths_[2];
  }

  const char* run() {
    constexpr const char* kTooShort = "the compressed coordinates end early: they are broken";
    constexpr const char* kNoSuchStep =
        "the step size of the compressed coordinates leaves its table: they are broken";
    std::uint32_t steps = 0;
    while (done_ < positions_.size()) {
      if (!bits_.has(large_bits_ + 1)) return kTooShort;
      const Numbers full = read_full();
      const int code = bits_.read_code();
      if (code == -2) return kTooShort;
      std::int32_t change = 0;
      if (code >= 0) {
        steps = static_cast<std::uint32_t>(code) / 3;
        change = code % 3 - 1;
      }
      if (steps >= positions_.size() - done_) {
        return "the compressed coordinates hold more atoms than the frame has: they are broken";
      }
      const PackedTriple& step = kSmallSteps[static_cast<std::size_t>(small_)];
      if (steps > 0 && small_ == kLastSmall) return kNoSuchStep;
      if (!bits_.has(steps * step.bits())) return kTooShort;
      put_run(full, steps, step);
      small_ += change;
      if (small_ < kFirstSmall || small_ > kLastSmall) return kNoSuchStep;
    }
    return out_of_range_ != 0 ? "a compressed coordinate lies outside of the range that the header gives"
                              : nullptr;
  }

 private:
  static PackedTriple large_triple(const std::array<std::uint32_t, 3>& size) {
    Uint128 product = 1;
    for (const std::uint32_t n : size) product *= n;
    const auto high = static_cast<std::uint64_t>(product >> 64), low = static_cast<std::uint64_t>(product);
    const auto bits = high != 0 ? 64 + std::bit_width(high) : std::bit_width(low);
    return {static_cast<unsigned>(bits), size[1], size[2]};
  }

  Numbers read_full() {
    if (packed_) return large_.read(bits_);
    Numbers numbers;
    for (std::size_t axis = 0; axis < 3; ++axis) numbers[axis] = bits_.read(widths_[axis]);
    return numbers;
  }

  void put_run(const Numbers& full, std::uint32_t steps, const PackedTriple& step) {
    if (steps == 0) return put(full);
    const std::uint32_t middle = kSmallSizes[static_cast<std::size_t>(small_)] / 2;
    Numbers last = full;
    for (std::uint32_t k = 0; k < steps; ++k) {
      const Numbers from_last = step.read(bits_);
      for (std::size_t axis = 0; axis < 3; ++axis) last[axis] += from_last[axis] - middle;
      put(last);
      if (k == 0) put(full);
    }
  }

  /// The numbers are unsigned and wrap around, so one below the range is above it too.
  void put(const Numbers& numbers) {
    positions_[done_++] = {coordinate(numbers, 0), coordinate(numbers, 1), coordinate(numbers, 2)};
    out_of_range_ |= static_cast<unsigned>(numbers[0] >= size_[0]) |
                     static_cast<unsigned>(numbers[1] >= size_[1]) |
                     static_cast<unsigned>(numbers[2] >= size_[2]);
  }

  double coordinate(const Numbers& numbers, std::size_t axis) const {
    const auto number = static_cast<std::int32_t>(low_[axis] + numbers[axis]);
    return static_cast<double>(static_cast<float>(number) * inverse_);
  }

  BitReader bits_;
  std::span<Vec3> positions_;
  Numbers low_{}, size_{};  ///< of the range
  float inverse_;
  std::int32_t small_;
  PackedTriple large_;  ///< of atoms stored in full, if packed_
  bool packed_ = false;
  std::array<unsigned, 3> widths_{};  ///< bits of their coordinates otherwise
  std::size_t large_bits_ = 0;
  std::size_t done_ = 0;
  unsigned out_of_range_ = 0;
};

}  // namespace

const char* XtcStream::decode(Bytes data, std::span<Vec3> positions) const {
  return StreamDecoder(*this, data, positions).run();
}

}  // namespace dch::trajectory
