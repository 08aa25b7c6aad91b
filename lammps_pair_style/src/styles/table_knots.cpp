// SPDX-License-Identifier: GPL-2.0-or-later
#include "table_knots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace dch::lammps {
namespace {

/// Squared distances, in intervals from knot to knot.
struct Squares {
  double first, apart;

  Squares(const PairTable& table, int knots)
      : first(table.inner * table.inner), apart((table.outer * table.outer - first) / (knots - 1)) {}
  double at(std::size_t knot, double part) const {
    return first + static_cast<double>(knot) * apart + part * apart;
  }
};

/// Whether the number in the middle is that between two knots next to each other, of so many.
bool is_linear(double first, double middle, double second, int knots) {
  const double off = std::abs(middle - 0.5 * (first + second));
  return off <= std::max(1e-9, 1e-15 * knots) * (std::abs(first) + std::abs(second));
}

/// Where an interval is asked, as parts of it: not at knots, whose numbers may come with the rounding of the
/// interval next to it. The first four make a cubic, on which the fifth has to be.
constexpr double kParts[] = {0.015625, 0.25, 0.75, 0.984375, 0.5};

/// What stands there.
using Asked = std::array<double, std::size(kParts)>;

/// The cubic through the first four, at another part.
double through_four(const Asked& at, double part) {
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    double weight = 1;
    for (std::size_t other = 0; other < 4; ++other)
      if (other != k) weight *= (part - kParts[other]) / (kParts[k] - kParts[other]);
    sum += weight * at[k];
  }
  return sum;
}

/// A cubic by its values at both ends and by the second derivatives there, divided by 6.
struct Cubic {
  double first, second, bend_of_first, bend_of_second;

  /// What a cubic is below the line from end to end, divided by b (1 - b), is linear in b.
  explicit Cubic(const Asked& at) : first(through_four(at, 0)), second(through_four(at, 1)) {
    const double below_1_4 = (0.75 * first + 0.25 * second - at[1]) / 0.1875;
    const double below_3_4 = (0.25 * first + 0.75 * second - at[2]) / 0.1875;
    bend_of_first = (3.5 * below_1_4 - 2.5 * below_3_4) / 3;
    bend_of_second = (3.5 * below_3_4 - 2.5 * below_1_4) / 3;
  }
};

/// One of the quantities of a table. Intervals come from the outer end inwards.
class SplineKnots {
 public:
  SplineKnots(std::vector<double>& values, std::vector<double>& bends, int knots)
      : values_(values), bends_(bends), last_(static_cast<std::size_t>(knots) - 1) {
    values_.assign(last_ + 1, 0);
    bends_.assign(last_ + 1, 0);
  }

  /// @param at  what is said of interval k
  /// @param rounding  of places, as a part of the interval
  /// @returns whether it may be a part of the spline
  bool take(std::size_t k, const Asked& at, double rounding) {
    const Cubic cubic(at);
    const double noise_outside = std::exchange(noise_, noise_of(at, rounding));
    if (!(std::abs(through_four(at, kParts[4]) - at[4]) <= kAllowed * noise_)) return false;
    if (k + 1 == last_) {
      values_[last_] = cubic.second;
      bends_[last_] = cubic.bend_of_second;
    }
    // What the outer interval has said stays, as it is less steep in most tables.
    const double noise = std::max(noise_, noise_outside);
    if (!(std::abs(cubic.second - values_[k + 1]) <= kAllowed * noise)) return false;
    if (!(std::abs(cubic.bend_of_second - bends_[k + 1]) <= kAllowedOfBends * noise)) return false;
    values_[k] = cubic.first;
    bends_[k] = cubic.bend_of_first;
    return true;
  }

  /// From a sixth of the second derivative by the part of an interval to the one by r^2.
  void finish(double apart) {
    for (double& bend : bends_) bend *= 6 / (apart * apart);
  }

 private:
  /// Ten times what was seen, and more: second derivatives are off by more than values are.
  static constexpr double kAllowed = 32, kAllowedOfBends = 256;

  /// Of a value that is computed anew: by its own rounding, and by that of its place.
  static double noise_of(const Asked& at, double rounding) {
    const auto [least, most] = std::minmax_element(at.begin(), at.end());
    return std::numeric_limits<double>::epsilon() * std::max(std::abs(*least), std::abs(*most)) +
           rounding * (*most - *least) + std::numeric_limits<double>::min();
  }

  std::vector<double>&values_, &bends_;
  std::size_t last_;
  double noise_ = 0;
};

}  // namespace

bool take_lines(const AskTable& ask, int knots, PairTable& table) {
  const Squares squares(table, knots);
  const auto n = static_cast<std::size_t>(knots);
  auto &energy = table.energy, &forces = table.force_over_r;
  energy.resize(n);
  forces.resize(n);
  for (std::size_t k = n - 1; k-- > 0;) {
    const TablePoint middle = ask(squares.at(k, 0.5)), knot = ask(squares.at(k, 0));
    energy[k] = knot.energy;
    forces[k] = knot.force_over_r;
    if (k == n - 2) {
      energy[k + 1] = 2 * middle.energy - energy[k];
      forces[k + 1] = 2 * middle.force_over_r - forces[k];
    } else if (!is_linear(energy[k], middle.energy, energy[k + 1], knots) ||
               !is_linear(forces[k], middle.force_over_r, forces[k + 1], knots)) {
      return false;
    }
  }
  return true;
}

bool take_splines(const AskTable& ask, int knots, PairTable& table) {
  const Squares squares(table, knots);
  SplineKnots energy(table.energy, table.energy_bend, knots);
  SplineKnots forces(table.force_over_r, table.force_bend, knots);
  for (auto k = static_cast<std::size_t>(knots) - 1; k-- > 0;) {
    Asked energies_at{}, forces_at{};
    for (const std::size_t which : {3, 2, 4, 1, 0}) {  // from the outside
      const TablePoint at = ask(squares.at(k, kParts[which]));
      energies_at[which] = at.energy;
      forces_at[which] = at.force_over_r;
    }
    const double rounding = std::numeric_limits<double>::epsilon() * squares.at(k, 1) / squares.apart;
    if (!energy.take(k, energies_at, rounding) || !forces.take(k, forces_at, rounding)) return false;
  }
  energy.finish(squares.apart);
  forces.finish(squares.apart);
  return true;
}

}  // namespace dch::lammps
