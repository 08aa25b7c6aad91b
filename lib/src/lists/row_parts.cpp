// SPDX-License-Identifier: MIT
#include "lists/row_parts.hpp"

#include <algorithm>

namespace dch::detail {

void start_rows(NeighborList& list) {
  list.kind = ListKind::half;
  list.first.assign(1, 0);
  list.particle.clear();
  list.near_end.clear();
  list.j.resize(list.j.capacity());
  list.margin = 0;
}

void append_pieces(Executor& executor, const std::vector<const NeighborList*>& pieces, NeighborList& out) {
  std::vector<std::size_t> first_row(pieces.size() + 1, out.particle.size());
  std::vector<std::size_t> first_entry(pieces.size() + 1, static_cast<std::size_t>(out.first.back()));
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const NeighborList& piece = *pieces[p];
    first_row[p + 1] = first_row[p] + piece.size();
    first_entry[p + 1] = first_entry[p] + static_cast<std::size_t>(piece.first.back());
  }
  out.first.resize(first_row.back() + 1);
  out.particle.resize(first_row.back());
  const bool has_shell = std::any_of(pieces.begin(), pieces.end(),
                                     [](const NeighborList* piece) { return !piece->near_end.empty(); });
  out.near_end.resize(has_shell ? first_row.back() : 0);
  if (out.j.size() < first_entry.back()) out.j.resize(first_entry.back());
  executor.run(static_cast<int>(pieces.size()), [&](int part) {
    const auto p = static_cast<std::size_t>(part);
    const NeighborList& piece = *pieces[p];
    std::copy(piece.particle.begin(), piece.particle.end(),
              out.particle.begin() + static_cast<std::ptrdiff_t>(first_row[p]));
    std::copy_n(piece.j.data(), piece.first.back(), out.j.data() + first_entry[p]);
    for (std::size_t r = 0; r < piece.near_end.size(); ++r)
      out.near_end[first_row[p] + r] = static_cast<std::int64_t>(first_entry[p]) + piece.near_end[r];
    for (std::size_t r = 0; r < piece.size(); ++r)
      out.first[first_row[p] + r + 1] = static_cast<std::int64_t>(first_entry[p]) + piece.first[r + 1];
  });
}

}  // namespace dch::detail
