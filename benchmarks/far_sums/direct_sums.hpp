// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace dch::bench {

struct DirectCharges {
  const double *x, *y, *z, *q;
  std::size_t count;
};

/// The potential at a place by a loop as it is written: C++ fixes the order in which it adds up, so compilers
/// do not vectorize it.
double plain_potential(const DirectCharges& charges, double x, double y, double z);

/// The same compiled with -ffast-math for the processor that it runs on: whole registers at a time, with the
/// vector instructions for roots and divisions; a charge at the place itself counts next to nothing.
double vectorized_potential(const DirectCharges& charges, double x, double y, double z);

}  // namespace dch::bench
