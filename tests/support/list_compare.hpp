// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

#include <dch/lists/neighbor_list.hpp>

namespace dch {

/// The first row in which two lists differ, as a sentence; empty if the lists are the same, entry by entry.
inline std::string first_difference(const NeighborList& actual, const NeighborList& expected) {
  if (actual.kind != expected.kind) return "one list is half, the other full";
  if (actual.size() != expected.size()) {
    return std::to_string(actual.size()) + " rows instead of " + std::to_string(expected.size());
  }
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto a = actual.row(i), e = expected.row(i);
    if (std::equal(a.begin(), a.end(), e.begin(), e.end())) continue;
    std::vector<std::int32_t> got(a.begin(), a.end()), missing, extra;
    std::sort(got.begin(), got.end());
    std::set_difference(e.begin(), e.end(), got.begin(), got.end(), std::back_inserter(missing));
    std::set_difference(got.begin(), got.end(), e.begin(), e.end(), std::back_inserter(extra));
    const std::string row = "row " + std::to_string(i) + " ";
    if (!missing.empty()) return row + "lacks neighbor " + std::to_string(missing.front());
    if (!extra.empty()) return row + "has neighbor " + std::to_string(extra.front()) + " too many";
    return row + "has the right neighbors in the wrong order";
  }
  return {};
}

/// An unsorted list, of n particles, with rows by index and neighbors ascending.
inline NeighborList sorted_by_index(const NeighborList& list, std::size_t n) {
  std::vector<std::vector<std::int32_t>> rows(n);
  for (std::size_t r = 0; r < list.size(); ++r) {
    const std::int32_t i = list.particle[r];
    for (const std::int32_t j : list.row(r)) {
      const bool is_own = list.kind == ListKind::full || i < j;
      rows[is_own ? i : j].push_back(is_own ? j : i);
    }
  }
  NeighborList sorted;
  sorted.kind = list.kind;
  for (auto& row : rows) {
    std::sort(row.begin(), row.end());
    sorted.j.insert(sorted.j.end(), row.begin(), row.end());
    sorted.first.push_back(static_cast<std::int64_t>(sorted.j.size()));
  }
  return sorted;
}

/// What keeps this from being a well-formed list of n rows: offsets, ascending rows, indices in range, no
/// particle its own neighbor, half rows above the diagonal. Empty if nothing does.
inline std::string malformation(const NeighborList& list, std::size_t n) {
  if (list.first.size() != n + 1) {
    return std::to_string(list.first.size()) + " offsets for " + std::to_string(n) + " rows";
  }
  if (list.first.front() != 0 || !std::is_sorted(list.first.begin(), list.first.end()) ||
      list.first.back() != static_cast<std::int64_t>(list.j.size())) {
    return "the offsets do not ascend from 0 to the number of entries";
  }
  for (std::size_t i = 0; i < n; ++i) {
    std::int64_t previous = list.kind == ListKind::half ? static_cast<std::int64_t>(i) : -1;
    for (const std::int32_t j : list.row(i)) {
      const std::string entry = "entry " + std::to_string(j) + " of row " + std::to_string(i);
      if (j < 0 || static_cast<std::size_t>(j) >= n) return entry + " is out of range";
      if (static_cast<std::size_t>(j) == i) return entry + " is the particle itself";
      if (j <= previous) return entry + " is out of order or in the wrong half";
      previous = j;
    }
  }
  return {};
}

}  // namespace dch
