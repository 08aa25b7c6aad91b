// SPDX-License-Identifier: MIT
#include <cmath>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/lists/list_params.hpp>

#include "base/describe.hpp"

namespace dch {
namespace {

using detail::describe;

void check_cutoff(double cutoff, const std::string& what) {
  if (!(std::isfinite(cutoff) && cutoff >= 0)) {
    throw InvalidParameter(what + " is " + describe(cutoff) + "; a cutoff must be finite and not negative");
  }
}

}  // namespace

TypeCutoffs::TypeCutoffs(double cutoff) : TypeCutoffs(1, {cutoff}) {}

TypeCutoffs::TypeCutoffs(int types, std::vector<double> matrix) : types_(types), matrix_(std::move(matrix)) {
  if (types < 1 || matrix_.size() / static_cast<std::size_t>(types) != static_cast<std::size_t>(types) ||
      matrix_.size() % static_cast<std::size_t>(types) != 0) {
    throw InvalidParameter("a cutoff matrix of " + std::to_string(matrix_.size()) + " entries does not fit " +
                           std::to_string(types) + " types; give types x types entries, at least one");
  }
  for (int a = 0; a < types; ++a) {
    for (int b = 0; b < types; ++b) {
      const double cutoff = (*this)(a, b);
      const std::string what = types == 1
                                   ? std::string("the cutoff")
                                   : "the cutoff of types " + std::to_string(a) + " and " + std::to_string(b);
      check_cutoff(cutoff, what);
      if (cutoff != (*this)(b, a)) {
        throw InvalidParameter(what + " is " + describe(cutoff) + " one way and " + describe((*this)(b, a)) +
                               " the other way; the matrix must be symmetric");
      }
      if (cutoff > largest_) largest_ = cutoff;
    }
  }
  if (largest_ == 0) throw InvalidParameter("every cutoff is 0; at least one must be > 0");
}

}  // namespace dch
