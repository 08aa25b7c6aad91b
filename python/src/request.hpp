// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <dch/engines/neighbor_pairs.hpp>
#include <dch/lists/list_params.hpp>

#include "arrays.hpp"

namespace dch::python {

/// Which pairs are asked for; the arrays are kept.
class Request {
 public:
  /// @param exclusions pairs of particles (m, 2) that are left out
  /// @throws InvalidParameter for cutoffs as TypeCutoffs, for exclusions of another shape
  Request(const Doubles& cutoffs, std::optional<Ints> types, std::optional<Doubles> radii, bool half,
          std::optional<Ints> exclusions);

  /// @throws InvalidParameter if pairs_of() does
  void check(std::size_t n);
  /// For n particles; holds until the next call for another number of them.
  /// @throws InvalidParameter for another number of types, for exclusions as Exclusions::from_pairs
  NeighborPairsParams pairs_of(std::size_t n, double skin);
  /// The same without a skin.
  ListParams list_of(std::size_t n, ListKind kind);

  /// Which of n particles are within a cutoff of themselves: all whose cutoff is not 0.
  std::vector<char> with_themselves(std::size_t n) const;

  const TypeCutoffs& cutoffs() const { return cutoffs_; }
  bool has_types() const { return types_.has_value(); }

 private:
  void check_types(std::size_t n) const;
  const Exclusions* exclusions_of(std::size_t n);

  TypeCutoffs cutoffs_{1.0};
  std::optional<Ints> types_;
  std::optional<Doubles> radii_;
  bool half_;
  std::optional<Ints> excluded_;
  std::optional<Exclusions> exclusions_;  ///< for as many particles as were asked about last
};

}  // namespace dch::python
