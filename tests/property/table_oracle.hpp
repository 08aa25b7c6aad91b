// SPDX-License-Identifier: MIT
//
// What a PairTable has between its knots, by the formulas of textbooks; the force is a number of its own.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <dch/forces/pair_potential.hpp>

#include "dual.hpp"

namespace dch::forms {

/// The interval of a table in which a distance is.
struct TableInterval {
  std::size_t k = 0;    ///< its first knot
  double apart = 0;     ///< its length in r^2
  double a = 0, b = 0;  ///< parts of the way to its second knot: that is left, and that is done

  TableInterval(const PairTable& table, double r) {
    const std::size_t n = table.energy.size();
    const double first = table.inner * table.inner;
    apart = (table.outer * table.outer - first) / static_cast<double>(n - 1);
    while (k + 2 < n && r * r > first + static_cast<double>(k + 1) * apart) ++k;
    a = (first + static_cast<double>(k + 1) * apart - r * r) / apart;
    b = 1 - a;
  }
  double line(const std::vector<double>& v) const { return a * v[k] + b * v[k + 1]; }
  double cubic(const std::vector<double>& v, const std::vector<double>& bend) const {
    return line(v) + ((a * a * a - a) * bend[k] + (b * b * b - b) * bend[k + 1]) * apart * apart / 6;
  }
};

inline Dual tabulated(const PairTable& table, Dual r) {
  const TableInterval at(table, r.value);
  return {at.line(table.energy), -at.line(table.force_over_r) * r.value};
}

inline Dual splined(const PairTable& table, Dual r) {
  const TableInterval at(table, r.value);
  return {at.cubic(table.energy, table.energy_bend),
          -at.cubic(table.force_over_r, table.force_bend) * r.value};
}

/// Gives a table second derivatives that bend it a good deal, and not as what it goes through.
inline void bend(PairTable& table) {
  const auto n = static_cast<double>(table.energy.size());
  const double apart = (table.outer * table.outer - table.inner * table.inner) / (n - 1);
  for (std::size_t k = 0; k < table.energy.size(); ++k) {
    const auto turn = static_cast<double>(k % 7);
    table.energy_bend.push_back((0.7 - 0.2 * turn) * table.energy[k] / (apart * apart));
    table.force_bend.push_back((0.3 * turn - 1.1) * table.force_over_r[k] / (apart * apart));
  }
}

}  // namespace dch::forms
