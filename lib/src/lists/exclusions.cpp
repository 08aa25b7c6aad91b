// SPDX-License-Identifier: MIT
#include <algorithm>
#include <numeric>
#include <string>

#include <dch/base/error.hpp>
#include <dch/lists/exclusions.hpp>

namespace dch {
namespace {

/// Neighbor rows of a graph on the particles 0..n-1, in one flat array.
struct Rows {
  std::vector<std::int64_t> first;
  std::vector<std::int32_t> entry;

  Span<const std::int32_t> row(std::size_t i) const {
    return {entry.data() + first[i], static_cast<std::size_t>(first[i + 1] - first[i])};
  }
};

bool is_index(std::int32_t i, std::size_t n) { return i >= 0 && static_cast<std::size_t>(i) < n; }

[[noreturn]] void refuse_pair(std::size_t n, IndexPair pair, const std::string& name_of_kind, std::size_t k) {
  const auto [i, j] = pair;
  const std::string name =
      name_of_kind + " " + std::to_string(k) + " (" + std::to_string(i) + ", " + std::to_string(j) + ")";
  for (const std::int32_t index : {i, j}) {
    if (is_index(index, n)) continue;
    throw InvalidParameter(name + " names particle " + std::to_string(index) +
                           ", but indices run from 0 to " + std::to_string(static_cast<std::int64_t>(n) - 1));
  }
  throw InvalidParameter(name + " names one particle twice; name two different ones");
}

/// Hosts hand in their pairs at every list, so no text is made for a good one.
void check_pairs(std::size_t n, Span<const IndexPair> pairs, const std::string& name_of_kind) {
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [i, j] = pairs[k];
    if (!is_index(i, n) || !is_index(j, n) || i == j) refuse_pair(n, pairs[k], name_of_kind, k);
  }
}

/// Both directions of every pair, in no order within a row: a counting sort by row.
Rows both_directions(std::size_t n, Span<const IndexPair> pairs) {
  Rows rows;
  rows.first.assign(n + 1, 0);
  for (const auto& [i, j] : pairs) {
    ++rows.first[static_cast<std::size_t>(i)];
    ++rows.first[static_cast<std::size_t>(j)];
  }
  std::partial_sum(rows.first.begin(), rows.first.end(), rows.first.begin());
  rows.entry.resize(2 * pairs.size());
  // Each row is filled from its end, which moves its end to its beginning.
  for (const auto& [i, j] : pairs) {
    rows.entry[static_cast<std::size_t>(--rows.first[static_cast<std::size_t>(i)])] = j;
    rows.entry[static_cast<std::size_t>(--rows.first[static_cast<std::size_t>(j)])] = i;
  }
  return rows;
}

/// Both directions of every pair, rows ascending and without repetition.
Rows symmetric_rows(std::size_t n, Span<const IndexPair> pairs) {
  Rows rows = both_directions(n, pairs);
  std::int64_t end = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = rows.entry.begin() + static_cast<std::ptrdiff_t>(rows.first[i]);
    const auto row_end = rows.entry.begin() + static_cast<std::ptrdiff_t>(rows.first[i + 1]);
    std::sort(row, row_end);
    rows.first[i] = end;
    for (auto k = row, different = std::unique(row, row_end); k != different; ++k)
      rows.entry[static_cast<std::size_t>(end++)] = *k;
  }
  rows.first[n] = end;
  rows.entry.resize(static_cast<std::size_t>(end));
  return rows;
}

/// Adds everything within `depth` bonds of `origin` to `reached`, in no order and perhaps repeatedly.
void collect_within(const Rows& bonds, std::int32_t origin, int depth, std::vector<std::int32_t>& reached) {
  reached.assign(1, origin);
  std::size_t begin = 0;
  for (int step = 0; step < depth; ++step) {
    const std::size_t end = reached.size();
    for (std::size_t k = begin; k < end; ++k) {
      const auto partners = bonds.row(static_cast<std::size_t>(reached[k]));
      reached.insert(reached.end(), partners.begin(), partners.end());
    }
    std::sort(reached.begin() + static_cast<std::ptrdiff_t>(end), reached.end());
    reached.erase(std::unique(reached.begin() + static_cast<std::ptrdiff_t>(end), reached.end()),
                  reached.end());
    begin = end;
  }
}

}  // namespace

Exclusions Exclusions::from_pairs(std::size_t n, Span<const IndexPair> pairs) {
  check_pairs(n, pairs, "excluded pair");
  Exclusions result;
  if (pairs.empty()) return result;
  Rows rows = symmetric_rows(n, pairs);
  result.first_ = std::move(rows.first);
  result.partner_ = std::move(rows.entry);
  return result;
}

Exclusions Exclusions::from_bonds(std::size_t n, Span<const IndexPair> bonds, int depth) {
  if (depth < 1 || depth > 3) {
    throw InvalidParameter("exclusion depth " + std::to_string(depth) +
                           " is not 1 (1-2 neighbors), 2 (also 1-3) or 3 (also 1-4)");
  }
  check_pairs(n, bonds, "bond");
  const Rows rows = symmetric_rows(n, bonds);
  std::vector<IndexPair> pairs;
  std::vector<std::int32_t> reached;
  for (std::size_t i = 0; i < n; ++i) {
    const auto origin = static_cast<std::int32_t>(i);
    collect_within(rows, origin, depth, reached);
    for (const std::int32_t j : reached) {
      if (j > origin) pairs.push_back({origin, j});
    }
  }
  return from_pairs(n, pairs);
}

bool Exclusions::excluded(std::int32_t i, std::int32_t j) const {
  const auto row = partners(i);
  return std::binary_search(row.begin(), row.end(), j);
}

}  // namespace dch
