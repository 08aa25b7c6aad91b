// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace dch::detail {

/// What reciprocal space holds of two unit charges at distances up to a cutoff, as a series in powers of
/// u = 2 (r / cutoff)^2 - 1: erf(splitting r) / r, and the force of that over r. Both are smooth in r^2, so a
/// few terms give them without a root, an exponential or a quotient.
struct EwaldSeries {
  std::vector<double> energy, force;  ///< by power
  double error = 0;                   ///< at most, relative to the largest value
};

/// Through the functions' values at Chebyshev's nodes, so the error is near the least that so many terms can
/// have. With x = splitting * cutoff it is below 2e-7 for 14 terms and x < 3.6, below 2e-9 for 26 and x
/// <= 6.
EwaldSeries make_ewald_series(double splitting, double cutoff, int terms);

/// The same of dispersion: what reciprocal space holds of two coefficients of 1 / splitting^3 each, but for
/// its sign, (1 - e^(-x^2) (1 + x^2 + x^4 / 2)) / x^6 with x = splitting r, less that at the cutoff, and the
/// force of that over r. Errors are below 5e-7 for 14 terms and x < 3.6, below 5e-9 for 26 and x <= 6.
EwaldSeries make_dispersion_series(double splitting, double cutoff, int terms);

}  // namespace dch::detail
