// SPDX-License-Identifier: MIT
//
// The tables of PairForm::table and of PairForm::spline, side by side as TableForm and SplineForm read them.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <dch/base/error.hpp>
#include <dch/forces/pair_potential.hpp>

#include "base/describe.hpp"

namespace dch {
namespace {

/// Places of knots are numbers of the kernel's precision, and those of what stands there integers of 32 bits.
constexpr std::size_t kMostInSingle = std::size_t{1} << 24, kMost = std::size_t{1} << 30;

[[noreturn]] void refuse_table(const std::string& what) {
  throw InvalidParameter("a table of a pair potential " + what);
}

void check_table(const PairTable& table, bool is_spline) {
  if (!(std::isfinite(table.outer) && table.inner >= 0 && table.inner < table.outer))
    refuse_table("begins at the distance " + detail::describe(table.inner) + " and ends at " +
                 detail::describe(table.outer) + "; it must begin at 0 or more, and end beyond");
  if (table.energy.size() < 2 || table.force_over_r.size() != table.energy.size())
    refuse_table("has " + std::to_string(table.force_over_r.size()) + " forces and " +
                 std::to_string(table.energy.size()) + " energies; give as many of each, two or more");
  const std::size_t bends = is_spline ? table.energy.size() : 0;
  if (table.force_bend.size() != bends || table.energy_bend.size() != bends)
    refuse_table("has " + std::to_string(table.force_bend.size()) + " second derivatives of forces and " +
                 std::to_string(table.energy_bend.size()) + " of energies; give " + std::to_string(bends) +
                 " of each, as many as knots for splines, else none");
  for (const auto* numbers : {&table.force_over_r, &table.energy, &table.force_bend, &table.energy_bend})
    for (const double number : *numbers)
      if (!std::isfinite(number))
        refuse_table("has the number " + detail::describe(number) + "; give finite ones");
}

/// A knot that is no number, all of a table, and some that go on after the last two. Beside each knot of a
/// spline stands its bend, as SplineForm wants it.
/// @param apart  squared distance from knot to knot [length^2]
void append(const std::vector<double>& values, const std::vector<double>& bends, double apart,
            std::size_t more, std::vector<double>& to) {
  const bool is_spline = !bends.empty();
  const auto bend_at = [&](std::size_t k) { return is_spline ? -apart * apart / 6 * bends[k] : 0; };
  const auto put = [&](double value, double bend) {
    to.push_back(value);
    if (!is_spline) return;
    to.push_back(bend);
    if (!std::isfinite(bend)) refuse_table("is so bent that its numbers overflow double precision");
  };
  put(std::numeric_limits<double>::quiet_NaN(), 0);
  const std::size_t n = values.size();
  for (std::size_t k = 0; k < n; ++k) put(values[k], bend_at(k));
  const double step = values[n - 1] - values[n - 2];
  for (std::size_t k = 1; k <= more; ++k) put(values[n - 1] + static_cast<double>(k) * step, 0);
}

/// Whether single precision holds all, tiny ones as 0.
bool to_single(const std::vector<double>& from, std::vector<float>& to) {
  bool fits = true;
  for (const double number : from) {
    fits = fits && !(std::abs(number) > double{std::numeric_limits<float>::max()});
    to.push_back(static_cast<float>(number));
  }
  return fits;
}

}  // namespace

void PairPotential::take_tables() {
  const bool is_spline = params_.form == PairForm::spline;
  const std::size_t numbers = is_spline ? 2 : 1;  // of a knot
  for (const PairTable& table : params_.tables) {
    check_table(table, is_spline);
    const double first2 = table.inner * table.inner, last2 = table.outer * table.outer;
    const double density = static_cast<double>(table.energy.size() - 1) / (last2 - first2);
    // Squared distances in single precision are off by less than a millionth of the largest one.
    const double more = 2 + 1e-6 * density * last2;
    if (!(more < 1e6))
      refuse_table("begins at the distance " + detail::describe(table.inner) + ", too near to its end at " +
                   detail::describe(table.outer) + " for as many numbers");
    given_of_table_.push_back({first2, density, static_cast<double>(knots_.force.size() / numbers), 0});
    append(table.force_over_r, table.force_bend, 1 / density, static_cast<std::size_t>(more), knots_.force);
    append(table.energy, table.energy_bend, 1 / density, static_cast<std::size_t>(more), knots_.energy);
    if (knots_.force.size() > kMost) refuse_table("has too many numbers; all may have 2^30");
  }
  // Pairs that do not act read the first ones.
  knots_.force.resize(std::max(knots_.force.size(), 3 * numbers));
  knots_.energy.resize(knots_.force.size());
  fits_single_ = to_single(knots_.force, knots_float_.force) &&
                 to_single(knots_.energy, knots_float_.energy) &&
                 knots_.force.size() <= numbers * kMostInSingle;
}

/// What its form is given of a pair.
std::array<double, 4> PairPotential::given_to_form(const FormPair& pair) const {
  if (!has_tables()) return pair.numbers;
  const double number = pair.numbers[0];
  if (!(number >= 0 && number < static_cast<double>(params_.tables.size()) && number == std::floor(number)))
    throw InvalidParameter("a pair potential has " + std::to_string(params_.tables.size()) +
                           " tables, and none is number " + detail::describe(number) + "; count from 0");
  const auto which = static_cast<std::size_t>(number);
  if (pair.cutoff > params_.tables[which].outer)
    throw InvalidParameter("the cutoff " + detail::describe(pair.cutoff) +
                           " of a pair is beyond the end of its table at " +
                           detail::describe(params_.tables[which].outer));
  return given_of_table_[which];
}

}  // namespace dch
