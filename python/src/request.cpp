// SPDX-License-Identifier: MIT
#include "request.hpp"

#include <string>
#include <utility>

#include <dch/base/error.hpp>

namespace dch::python {

Request::Request(const Doubles& cutoffs, std::optional<Ints> types, std::optional<Doubles> radii, bool half,
                 std::optional<Ints> exclusions)
    : types_(std::move(types)), radii_(std::move(radii)), half_(half), excluded_(std::move(exclusions)) {
  if (!radii_) cutoffs_ = cutoffs_of(cutoffs);
  if (excluded_) index_pairs_of(*excluded_);  // the shape is checked here
}

const Exclusions* Request::exclusions_of(std::size_t n) {
  if (!excluded_ || excluded_->size() == 0) return nullptr;
  if (!exclusions_ || exclusions_->size() != n)
    exclusions_ = Exclusions::from_pairs(n, index_pairs_of(*excluded_));
  return &*exclusions_;
}

void Request::check_types(std::size_t n) const {
  if (types_ && static_cast<std::size_t>(types_->size()) != n)
    throw InvalidParameter(std::to_string(types_->size()) + " particle types given for " + std::to_string(n) +
                           " particles; give one each");
}

void Request::check(std::size_t n) {
  check_types(n);
  exclusions_of(n);
}

NeighborPairsParams Request::pairs_of(std::size_t n, double skin) {
  check_types(n);
  NeighborPairsParams out;
  out.cutoffs = cutoffs_;
  out.types = numbers_of(types_);
  out.radii = numbers_of(radii_);
  out.kind = half_ ? ListKind::half : ListKind::full;
  out.skin = skin;
  out.exclusions = exclusions_of(n);
  return out;
}

ListParams Request::list_of(std::size_t n, ListKind kind) {
  ListParams out;
  out.cutoffs = cutoffs_;
  out.types = numbers_of(types_);
  out.radii = numbers_of(radii_);
  out.kind = kind;
  out.exclusions = exclusions_of(n);
  return out;
}

std::vector<char> Request::with_themselves(std::size_t n) const {
  const Span<const std::int32_t> types = numbers_of(types_);
  const Span<const double> radii = numbers_of(radii_);
  std::vector<char> out(n, 1);
  for (std::size_t i = 0; i < n; ++i) {
    if (!radii.empty()) out[i] = static_cast<char>(radii[i] > 0);
    if (!types.empty()) out[i] = static_cast<char>(cutoffs_(types[i], types[i]) > 0);
  }
  return out;
}

}  // namespace dch::python
