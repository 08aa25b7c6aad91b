// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace dch::trajectory::test {

/// Builds TRR files of GROMACS (numbers of type Real: float or double) byte by byte.
template <class Real>
class TrrFile {
 public:
  struct Parts {
    bool box = true;
    bool positions = true;
    bool velocities = false;
  };

  /// A frame whose vectors are filled from `first` on by steps of 1/8; the box has the edge 4.
  void append_frame(std::int32_t atoms, std::int32_t step, const Parts& parts, double first = 0) {
    const auto real = static_cast<std::int32_t>(sizeof(Real));
    bytes_ +=
        encode(std::int32_t{1993}) + encode(std::int32_t{13}) + encode(std::int32_t{12}) + "GMX_trn_file";
    const std::int32_t matrix = 9 * real, vectors = 3 * atoms * real;
    for (const std::int32_t size : {0, 0, parts.box ? matrix : 0, 0, 0, 0, 0, parts.positions ? vectors : 0,
                                    parts.velocities ? vectors : 0, 0, atoms, step, 0}) {
      bytes_ += encode(size);
    }
    bytes_ += encode(static_cast<Real>(step)) + encode(Real{0});
    if (parts.box) append_vectors({4, 0, 0, 0, 4, 0, 0, 0, 4});
    std::vector<double> values;
    for (std::int32_t k = 0; k < 3 * atoms; ++k) values.push_back(first + k / 8.0);
    if (parts.positions) append_vectors(values);
    if (parts.velocities) append_vectors(values);
  }

  void append_vectors(const std::vector<double>& values) {
    for (const double value : values) bytes_ += encode(static_cast<Real>(value));
  }

  const std::string& bytes() const { return bytes_; }

 private:
  template <class T>
  static std::string encode(T value) {
    const auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    static_assert(std::endian::native == std::endian::little);
    return std::string(raw.rbegin(), raw.rend());
  }

  std::string bytes_;
};

}  // namespace dch::trajectory::test
