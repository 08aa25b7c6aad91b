// SPDX-License-Identifier: MIT
//
// The tables of PairForm::table, side by side as TableForm reads them.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <dch/base/error.hpp>
#include <dch/forces/pair_potential.hpp>

#include "base/describe.hpp"

namespace dch {
namespace {

/// Places are numbers of the kernel's precision, and integers of 32 bits.
constexpr std::size_t kMostInSingle = std::size_t{1} << 24, kMost = std::size_t{1} << 30;

[[noreturn]] void refuse_table(const std::string& what) {
  throw InvalidParameter("a table of a pair potential " + what);
}

void check_table(const PairTable& table) {
  if (!(std::isfinite(table.outer) && table.inner >= 0 && table.inner < table.outer))
    refuse_table("begins at the distance " + detail::describe(table.inner) + " and ends at " +
                 detail::describe(table.outer) + "; it must begin at 0 or more, and end beyond");
  if (table.energy.size() < 2 || table.force_over_r.size() != table.energy.size())
    refuse_table("has " + std::to_string(table.force_over_r.size()) + " forces and " +
                 std::to_string(table.energy.size()) + " energies; give as many of each, two or more");
  for (const auto* numbers : {&table.force_over_r, &table.energy})
    for (const double number : *numbers)
      if (!std::isfinite(number))
        refuse_table("has the number " + detail::describe(number) + "; give finite ones");
}

/// One that is no number, all of a table, and some that go on after the last two.
void append(const std::vector<double>& values, std::size_t more, std::vector<double>& to) {
  to.push_back(std::numeric_limits<double>::quiet_NaN());
  to.insert(to.end(), values.begin(), values.end());
  const double last = values.back(), step = last - values[values.size() - 2];
  for (std::size_t k = 1; k <= more; ++k) to.push_back(last + static_cast<double>(k) * step);
}

/// Whether single precision holds all, tiny ones as 0.
bool to_single(const std::vector<double>& from, std::vector<float>& to) {
  bool fits = from.size() <= kMostInSingle;
  for (const double number : from) {
    fits = fits && !(std::abs(number) > double{std::numeric_limits<float>::max()});
    to.push_back(static_cast<float>(number));
  }
  return fits;
}

}  // namespace

void PairPotential::take_tables() {
  for (const PairTable& table : params_.tables) {
    check_table(table);
    const double first2 = table.inner * table.inner, last2 = table.outer * table.outer;
    const double density = static_cast<double>(table.energy.size() - 1) / (last2 - first2);
    // Squared distances in single precision are off by less than a millionth of the largest one.
    const double more = 2 + 1e-6 * density * last2;
    if (!(more < 1e6))
      refuse_table("begins at the distance " + detail::describe(table.inner) + ", too near to its end at " +
                   detail::describe(table.outer) + " for as many numbers");
    given_of_table_.push_back({first2, density, static_cast<double>(knots_.force.size()), 0});
    append(table.force_over_r, static_cast<std::size_t>(more), knots_.force);
    append(table.energy, static_cast<std::size_t>(more), knots_.energy);
    if (knots_.force.size() > kMost) refuse_table("has too many numbers; all may have 2^30");
  }
  // Pairs that do not act read the first ones.
  knots_.force.resize(std::max(knots_.force.size(), std::size_t{3}));
  knots_.energy.resize(knots_.force.size());
  fits_single_ = to_single(knots_.force, knots_float_.force) && to_single(knots_.energy, knots_float_.energy);
}

/// What its form is given of a pair.
std::array<double, 4> PairPotential::given_to_form(const FormPair& pair) const {
  if (params_.form != PairForm::table) return pair.numbers;
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
