// SPDX-License-Identifier: MIT
#include "engines/list_statistics.hpp"

#include <algorithm>

namespace dch::cli {
namespace {

constexpr std::uint64_t kFnvPrime = 1099511628211ull;

void mix(std::uint64_t& hash, std::uint64_t value) {
  hash ^= value;
  hash *= kFnvPrime;
}

}  // namespace

void ListStatistics::add(const NeighborList& list, bool is_new) {
  if (is_new || degrees_.size() != list.size()) count_degrees(list);
  if (last_histogram_.size() > histogram_.size()) histogram_.resize(last_histogram_.size());
  for (std::size_t k = 0; k < last_histogram_.size(); ++k) histogram_[k] += last_histogram_[k];
  for (const std::int64_t begin : list.first) mix(hash_, static_cast<std::uint64_t>(begin));
  for (const std::int32_t j : list.j) mix(hash_, static_cast<std::uint64_t>(j));
}

void ListStatistics::count_degrees(const NeighborList& list) {
  degrees_.assign(list.size(), 0);
  for (std::size_t i = 0; i < list.size(); ++i) {
    degrees_[i] += list.first[i + 1] - list.first[i];
    if (list.kind == ListKind::full) continue;
    for (const std::int32_t j : list.row(i)) ++degrees_[static_cast<std::size_t>(j)];
  }
  last_histogram_.clear();
  for (const std::int64_t degree : degrees_) {
    const auto k = static_cast<std::size_t>(degree);
    if (last_histogram_.size() <= k) last_histogram_.resize(k + 1);
    ++last_histogram_[k];
  }
}

}  // namespace dch::cli
