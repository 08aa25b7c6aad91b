// SPDX-License-Identifier: MIT
#include "ewald_series.hpp"

#include <algorithm>
#include <cmath>

namespace dch::detail {
namespace {

const double kPi = std::acos(-1.0);

/// erf(x) / x
double energy_factor(double x) { return x == 0 ? 2 / std::sqrt(kPi) : std::erf(x) / x; }

/// (erf(x) - 2 x e^(-x^2) / sqrt(pi)) / x^3, near 0 by its Taylor series: 4 / sqrt(pi) times the sum of
/// (-x^2)^j / (j! (2 j + 3)).
double force_factor(double x) {
  if (x > 0.5) return (std::erf(x) - 2 * x / std::sqrt(kPi) * std::exp(-x * x)) / (x * x * x);
  double power = 1, sum = 0;
  for (int j = 0; j < 14; ++j) {
    sum += power / (2 * j + 3);
    power *= -x * x / (j + 1);
  }
  return 4 / std::sqrt(kPi) * sum;
}

/// (1 - e^-y (1 + y + y^2 / 2! + ...)) / y^n with n terms in brackets; near 0 from the terms left out, which
/// are all positive.
double rest_of_exponential(int n, double y) {
  double power = 1, sum = 0;
  if (y > n + 3) {
    for (int k = 0; k < n; ++k) {
      sum += power;
      power *= y / (k + 1);
    }
    return (1 - std::exp(-y) * sum) / std::pow(y, n);
  }
  for (int k = 1; k <= n; ++k) power /= k;
  for (int k = 0; k < 40; ++k) {
    sum += power;
    power *= y / (n + k + 1);
  }
  return std::exp(-y) * sum;
}

/// Coefficients of powers of u of the sum of c_k T_k(u), by T_(k+1) = 2 u T_k - T_(k-1).
std::vector<double> powers_of(const std::vector<double>& chebyshev) {
  const std::size_t n = chebyshev.size();
  std::vector<double> powers(n), now(n), before(n);
  now[0] = 1;
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t m = 0; m < n; ++m) powers[m] += chebyshev[k] * now[m];
    std::vector<double> next(n);
    for (std::size_t m = 0; m < n; ++m)
      next[m] = (m > 0 ? (k == 0 ? 1 : 2) * now[m - 1] : 0) - (k == 0 ? 0 : before[m]);
    before = now;
    now = next;
  }
  return powers;
}

double value_of(const std::vector<double>& powers, double u) {
  double sum = 0;
  for (std::size_t m = powers.size(); m-- > 0;) sum = sum * u + powers[m];
  return sum;
}

/// A series for f(u), and how far it is off, relative to f(-1), the largest value.
template <class F>
std::vector<double> fit(const F& f, int terms, double& error) {
  std::vector<double> values, chebyshev;
  for (int j = 0; j < terms; ++j) values.push_back(f(std::cos(kPi * (j + 0.5) / terms)));
  for (int k = 0; k < terms; ++k) {
    double sum = 0;
    for (int j = 0; j < terms; ++j)
      sum += values[static_cast<std::size_t>(j)] * std::cos(kPi * k * (j + 0.5) / terms);
    chebyshev.push_back((k == 0 ? 1.0 : 2.0) / terms * sum);
  }
  std::vector<double> powers = powers_of(chebyshev);
  constexpr int kSamples = 200;
  for (int k = 0; k <= kSamples; ++k) {
    const double u = 2.0 * k / kSamples - 1;
    error = std::max(error, std::abs(value_of(powers, u) - f(u)) / f(-1));
  }
  return powers;
}

}  // namespace

EwaldSeries make_ewald_series(double splitting, double cutoff, int terms) {
  const auto x = [&](double u) { return splitting * cutoff * std::sqrt(std::max(0.0, (u + 1) / 2)); };
  const double scale3 = splitting * splitting * splitting;
  EwaldSeries series;
  series.energy = fit([&](double u) { return splitting * energy_factor(x(u)); }, terms, series.error);
  series.force = fit([&](double u) { return scale3 * force_factor(x(u)); }, terms, series.error);
  return series;
}

EwaldSeries make_dispersion_series(double splitting, double cutoff, int terms) {
  const double scale2 = splitting * splitting, most = scale2 * cutoff * cutoff;
  const auto y = [&](double u) { return most * std::max(0.0, (u + 1) / 2); };
  EwaldSeries series;
  series.energy = fit([&](double u) { return rest_of_exponential(3, y(u)); }, terms, series.error);
  series.force =
      fit([&](double u) { return 6 * scale2 * rest_of_exponential(4, y(u)); }, terms, series.error);
  series.energy[0] -= rest_of_exponential(3, most);
  return series;
}

}  // namespace dch::detail
