// SPDX-License-Identifier: MIT
//
// Transforms of many lines side by side equal the sum that defines them, in double, line by line.
#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <vector>

#include "fft_plan.hpp"
#include "scenes.hpp"
#include "simd/fft_loops.hpp"

namespace dch::detail {
namespace {

using Complex = std::complex<double>;

/// Complex numbers of so many lines, element by element.
struct Lines {
  std::size_t length, lanes;
  std::vector<float> re, im;
  Lines(int of_length, std::size_t lines)
      : length(static_cast<std::size_t>(of_length)), lanes(lines), re(length * lanes), im(length * lanes) {}
  ComplexArray array() { return {re.data(), im.data()}; }
};

Lines random_lines(int length, std::size_t lanes) {
  scenes::Random random(static_cast<std::uint64_t>(length));
  Lines lines(length, lanes);
  for (std::vector<float>* part : {&lines.re, &lines.im})
    for (float& number : *part) number = static_cast<float>(random.uniform(-1, 1));
  return lines;
}

/// Element m of the transform of a line: the sum over k of e^(sign 2 pi i m k / length) times element k.
Complex plain_sum(const Lines& lines, std::size_t lane, std::size_t m, double sign) {
  const double unit = sign * 2 * std::acos(-1.0) / static_cast<double>(lines.length);
  Complex sum = 0;
  for (std::size_t k = 0; k < lines.length; ++k) {
    const std::size_t at = k * lines.lanes + lane;
    sum += Complex(double{lines.re[at]}, double{lines.im[at]}) *
           std::polar(1.0, unit * static_cast<double>(m * k % lines.length));
  }
  return sum;
}

/// The largest error over the root of the length, as the elements themselves are that large.
double largest_error(int length, std::size_t lanes, float sign) {
  const Lines given = random_lines(length, lanes);
  Lines from = given, other(length, lanes);
  ComplexArray found = from.array(), spare = other.array();
  fft(FftPlan(length), lanes, sign, found, spare);
  double largest = 0;
  for (std::size_t m = 0; m < given.length; ++m)
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const std::size_t at = m * lanes + lane;
      const Complex error = Complex(double{found.re[at]}, double{found.im[at]}) -
                            plain_sum(given, lane, m, static_cast<double>(sign));
      largest = std::max(largest, std::abs(error));
    }
  return largest / std::sqrt(length);
}

TEST(FftTest, EqualsTheSumForEachRadixAndTheirProducts) {
  for (const int length : {1, 2, 3, 4, 5, 7, 8, 9, 16, 25, 49, 50, 60, 64, 72, 84, 210, 420})
    for (const std::size_t lanes : {std::size_t{1}, std::size_t{5}, std::size_t{16}})
      for (const float sign : {-1.0f, 1.0f})
        EXPECT_LT(largest_error(length, lanes, sign), 6e-7) << length << ' ' << lanes << ' ' << sign;
}

}  // namespace
}  // namespace dch::detail
