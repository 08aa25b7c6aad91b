// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "frames/frame_decoder.hpp"

namespace dch::trajectory {

__extension__ using Uint128 = unsigned __int128;  // GCC and Clang; -Wpedantic asks for the word in front

/// The quotient of 64-bit numbers by one and the same divisor, by a multiplication: several times as fast as
/// the division of most processors.
class Divider {
 public:
  constexpr explicit Divider(std::uint32_t divisor)
      : divisor_(divisor), inverse_(divisor == 0 ? 0 : ~std::uint64_t{0} / divisor) {}

  /// Divides; returns the quotient and leaves the remainder in `number`. With inverse = (2^64 - k) / divisor,
  /// 1 <= k <= divisor, the first guess is short by less than 1 + number / 2^64, hence by 0 or 1.
  std::uint64_t divide(std::uint64_t& number) const {
    auto quotient = static_cast<std::uint64_t>(Uint128{number} * inverse_ >> 64);
    std::uint64_t remainder = number - quotient * divisor_;
    const bool one_short = remainder >= divisor_;
    quotient += one_short ? 1 : 0;
    remainder -= one_short ? divisor_ : 0;
    number = remainder;
    return quotient;
  }

  constexpr std::uint32_t divisor() const { return divisor_; }

 private:
  std::uint32_t divisor_;
  std::uint64_t inverse_;
};

/// A stream of bits, the highest bit of each byte first. Reading behind the end gives zeros: ask has() first.
class BitReader {
 public:
  explicit BitReader(Bytes bytes) : bytes_(bytes), size_(8 * bytes.size()) {}

  bool has(std::size_t bits) const { return bits <= size_ - position_; }

  /// Reads a flag and, if it is set and the bits are there, five more; -1 without the flag, -2 if they are
  /// not there.
  int read_code() {
    const std::uint64_t next = window();
    if (next >> 63 == 0) {
      position_ += 1;
      return -1;
    }
    if (!has(6)) return -2;
    position_ += 6;
    return static_cast<int>(next >> 58 & 31);
  }

  /// The next 1 to 32 bits as a number, the first bit the highest.
  std::uint32_t read(unsigned bits) {
    const auto value = static_cast<std::uint32_t>(window() >> (64 - bits));
    position_ += bits;
    return value;
  }

  /// The next 1 to 64 bits as a number of whole bytes, the lowest first, the last of which may have fewer
  /// than eight bits: the order in which XTC stores numbers that are packed together.
  std::uint64_t read_bytes(unsigned bits) {
    const std::uint64_t bytes = byte_swapped(window());
    const unsigned whole = (bits - 1) / 8 * 8, rest = bits - whole;
    const std::uint64_t last = (bytes >> whole & 0xff) >> (8 - rest);
    position_ += bits;
    return (bytes & ((std::uint64_t{1} << whole) - 1)) | last << whole;
  }

 private:
  static std::uint64_t byte_swapped(std::uint64_t value) { return __builtin_bswap64(value); }

  /// The next 64 bits, the first the highest.
  std::uint64_t window() const {
    const std::size_t byte = position_ >> 3;
    const unsigned shift = position_ & 7;
    if (byte + 9 <= bytes_.size()) {
      return joined(bytes_.data() + byte, shift);
    }
    return window_at_end(byte, shift);
  }

  std::uint64_t window_at_end(std::size_t byte, unsigned shift) const {
    std::array<unsigned char, 9> last{};
    for (std::size_t k = 0; k < last.size() && byte + k < bytes_.size(); ++k) last[k] = bytes_[byte + k];
    return joined(last.data(), shift);
  }

  /// 64 bits of nine bytes, behind the first `shift`.
  static std::uint64_t joined(const unsigned char* bytes, unsigned shift) {
    return big_endian(bytes) << shift | static_cast<std::uint64_t>(bytes[8] >> (8 - shift));
  }

  /// One instruction, which the general decode() of byte_order.hpp does not become.
  static std::uint64_t big_endian(const unsigned char* bytes) {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes, sizeof value);
    return std::endian::native == std::endian::little ? byte_swapped(value) : value;
  }

  Bytes bytes_;
  std::size_t size_;          ///< [bits]
  std::size_t position_ = 0;  ///< [bits]
};

/// Three numbers below three sizes, stored as one: (x * size_y + y) * size_z + z.
class PackedTriple {
 public:
  using Numbers = std::array<std::uint32_t, 3>;

  /// @param bits of the stored number, 1 to 72
  constexpr PackedTriple(unsigned bits, std::uint32_t size_y, std::uint32_t size_z)
      : bits_(bits), y_(size_y), z_(size_z) {}

  unsigned bits() const { return bits_; }

  /// In a broken stream x may be anything; y and z are below their sizes.
  Numbers read(BitReader& bits) const {
    if (bits_ > 64) return read_long(bits);
    std::uint64_t rest = bits.read_bytes(bits_);
    std::uint64_t xy = z_.divide(rest);
    const auto z = static_cast<std::uint32_t>(rest);
    const auto x = static_cast<std::uint32_t>(y_.divide(xy));
    return {x, static_cast<std::uint32_t>(xy), z};
  }

 private:
  /// Kept apart, so that read() is small enough to stand where it is called.
  [[gnu::noinline]] Numbers read_long(BitReader& bits) const {
    const std::uint64_t low = bits.read_bytes(64);
    const Uint128 number = Uint128{bits.read_bytes(bits_ - 64)} << 64 | low;
    const Uint128 xy = number / z_.divisor();
    return {static_cast<std::uint32_t>(xy / y_.divisor()), static_cast<std::uint32_t>(xy % y_.divisor()),
            static_cast<std::uint32_t>(number % z_.divisor())};
  }

  unsigned bits_;
  Divider y_, z_;
};

}  // namespace dch::trajectory
