// SPDX-License-Identifier: MIT
#include "lists/list_assembly.hpp"

#include <algorithm>
#include <numeric>

namespace dch::detail {

/// Turns counts at [k + 1] into first positions: first[0] = 0, first[k + 1] = first[k] + count of k.
void ListAssembler::accumulate_counts(std::vector<std::int64_t>& first) {
  std::partial_sum(first.begin(), first.end(), first.begin());
}

void ListAssembler::fill_rows(std::size_t n, NeighborList& out) {
  out.j.resize(row_of_.size());
  next_.assign(out.first.begin(), out.first.end());
  for (std::size_t column = 0; column < n; ++column) {
    for (auto k = column_first_[column]; k < column_first_[column + 1]; ++k) {
      out.j[next_[row_of_[k]]++] = static_cast<std::int32_t>(column);
    }
  }
}

/// A full row is the lower neighbors, which arrive in order as the rows of the half list are read in order,
/// and then the half row itself.
void ListAssembler::assemble_full(std::size_t n, std::size_t rows, NeighborList& out) {
  out.kind = ListKind::full;
  out.first.assign(n + 1, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const auto lower = column_first_[i + 1] - column_first_[i];
    const auto upper = half_.first[i + 1] - half_.first[i];
    out.first[i + 1] = out.first[i] + (i < rows ? lower + upper : 0);
  }
  out.j.resize(static_cast<std::size_t>(out.first.back()));
  next_.assign(out.first.begin(), out.first.end());
  for (std::size_t i = 0; i < n; ++i) {
    for (const std::int32_t j : half_.row(i)) {
      if (static_cast<std::size_t>(j) < rows) out.j[next_[j]++] = static_cast<std::int32_t>(i);
    }
  }
  for (std::size_t i = 0; i < rows; ++i) {
    const auto row = half_.row(i);
    std::copy(row.begin(), row.end(), out.j.begin() + next_[i]);
  }
}

std::size_t ListAssembler::memory_bytes() const {
  return (column_first_.capacity() + next_.capacity() + half_.first.capacity()) * sizeof(std::int64_t) +
         (row_of_.capacity() + half_.j.capacity()) * sizeof(std::int32_t);
}

}  // namespace dch::detail
