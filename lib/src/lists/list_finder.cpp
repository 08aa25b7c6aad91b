// SPDX-License-Identifier: MIT
#include "lists/list_finder.hpp"

#include <algorithm>
#include <numeric>

#include "hierarchy/level.hpp"

namespace dch::detail {
namespace {

template <class T>
bool is_same(Span<T> a, Span<T> b) {
  return a.data() == b.data() && a.size() == b.size();
}

/// Whether the cutoffs of two requests depend on the same thing, and ghosts are the same.
bool are_alike(const ListParams& a, const ListParams& b) {
  return is_same(a.radii, b.radii) && is_same(a.types, b.types) && a.first_ghost == b.first_ghost &&
         a.cutoffs.types() == b.cutoffs.types();
}

/// The largest cutoff of a type and the skin [length]; 0 if it makes no pairs.
double reach_of_type(const ListParams& request, int type) {
  double largest = 0;
  for (int other = 0; other < request.cutoffs.types(); ++other)
    largest = std::max(largest, request.cutoffs(type, other));
  return largest > 0 ? largest + request.skin : 0;
}

/// Whether what is near enough for one request is so for another one, of the same particles: candidates are
/// those of the list that reaches farthest.
bool reaches_as_far(const ListParams& farthest, const ListParams& other) {
  if (!other.radii.empty() || other.types.empty()) return true;
  for (int type = 0; type < other.cutoffs.types(); ++type)
    if (reach_of_type(farthest, type) < reach_of_type(other, type)) return false;
  return true;
}

bool is_ready_as_found(const ListParams& request) {
  return request.order == RowOrder::unsorted && request.kind == ListKind::half && request.first_ghost < 0;
}

/// From rows that hold each pair once, in either row, rows of the same particles in the same order that hold
/// it in the rows of both (full) or of the one that is not a ghost. Near ones stay first.
void distribute_pairs(const NeighborList& found, std::size_t n, ListKind kind, std::int32_t first_ghost,
                      NeighborList& out) {
  const std::size_t rows = found.particle.size();
  const bool has_shell = !found.near_end.empty();
  const auto may_own = [&](std::int32_t particle) { return first_ghost < 0 || particle < first_ghost; };
  // A row of which all pairs stay is taken as it is.
  const auto take_row = [&](std::size_t r, std::int64_t first, std::int64_t last, const auto& one,
                            const auto& all) {
    const std::int32_t i = found.particle[r];
    if (kind == ListKind::half && may_own(i)) return all(r, first, last);
    for (std::int64_t k = first; k < last; ++k) {  // one(owner, other)
      const std::int32_t j = found.j[static_cast<std::size_t>(k)];
      if (may_own(i)) one(i, j);
      if (may_own(j)) one(j, i);
    }
  };
  std::vector<std::int32_t> row_of(n, kNone);
  for (std::size_t r = 0; r < rows; ++r) row_of[found.particle[r]] = static_cast<std::int32_t>(r);
  out.kind = kind;
  out.particle = found.particle;
  out.first.assign(rows + 1, 0);
  const auto count = [&](std::int32_t owner, std::int32_t) { ++out.first[row_of[owner] + 1]; };
  const auto count_row = [&](std::size_t r, std::int64_t first, std::int64_t last) {
    out.first[r + 1] += last - first;
  };
  for (std::size_t r = 0; r < rows; ++r) take_row(r, found.first[r], found.first[r + 1], count, count_row);
  for (std::size_t r = 0; r < rows; ++r) out.first[r + 1] += out.first[r];
  if (out.j.size() < static_cast<std::size_t>(out.first.back()))
    out.j.resize(static_cast<std::size_t>(out.first.back()));
  std::vector<std::int64_t> next(out.first.begin(), out.first.end());
  const auto put = [&](std::int32_t owner, std::int32_t other) { out.j[next[row_of[owner]]++] = other; };
  const auto put_row = [&](std::size_t r, std::int64_t first, std::int64_t last) {
    std::copy(found.j.begin() + first, found.j.begin() + last, out.j.begin() + next[r]);
    next[r] += last - first;
  };
  for (std::size_t r = 0; r < rows; ++r)
    take_row(r, found.first[r], has_shell ? found.near_end[r] : found.first[r + 1], put, put_row);
  out.near_end.clear();
  if (!has_shell) return;
  out.near_end.assign(next.begin(), next.end() - 1);
  for (std::size_t r = 0; r < rows; ++r) take_row(r, found.near_end[r], found.first[r + 1], put, put_row);
}

}  // namespace

void ListFinder::find(const ListTask& task, Span<const ListParams> requests, const FindRows& find_rows,
                      const std::vector<NeighborList*>& out) {
  const auto* const farthest = std::max_element(
      requests.begin(), requests.end(),
      [](const ListParams& a, const ListParams& b) { return a.list_radius() < b.list_radius(); });
  const bool alike = std::all_of(requests.begin(), requests.end(), [&](const ListParams& request) {
    return are_alike(request, *farthest) && reaches_as_far(*farthest, request);
  });
  std::vector<const ListParams*> together;
  for (std::size_t r = 0; r < requests.size(); ++r) {
    if (alike) {
      together.push_back(&requests[r]);
    } else {
      find_alike(task, {&requests[r]}, find_rows, {out[r]});
    }
  }
  if (alike && !together.empty()) find_alike(task, together, find_rows, out);
}

void ListFinder::find_alike(const ListTask& task, const std::vector<const ListParams*>& requests,
                            const FindRows& find_rows, const std::vector<NeighborList*>& out) {
  std::vector<std::size_t> by_radius(requests.size());  // the largest first
  std::iota(by_radius.begin(), by_radius.end(), std::size_t{0});
  std::stable_sort(by_radius.begin(), by_radius.end(), [&](std::size_t a, std::size_t b) {
    return requests[a]->list_radius() > requests[b]->list_radius();
  });
  std::vector<PairFilter> filters;
  filters.reserve(requests.size());
  std::vector<const PairFilter*> sorted_filters;
  std::vector<NeighborList*> rows;
  found_.resize(std::max(found_.size(), requests.size()));
  for (const std::size_t r : by_radius) {
    sorted_filters.push_back(&filters.emplace_back(task.positions, task.box, *requests[r], task.error));
    rows.push_back(is_ready_as_found(*requests[r]) ? out[r] : &found_[r]);
  }
  find_rows(sorted_filters, rows);
  for (NeighborList* list : rows) {
    for (const std::int32_t particle : task.singletons) {
      list->particle.push_back(particle);
      list->first.push_back(list->first.back());
      if (!list->near_end.empty()) list->near_end.push_back(list->first.back());
    }
  }
  for (std::size_t r = 0; r < requests.size(); ++r)
    if (!is_ready_as_found(*requests[r]))
      put_in_order(*requests[r], task.positions.size(), found_[r], *out[r]);
}

void ListFinder::put_in_order(const ListParams& request, std::size_t n, const NeighborList& found,
                              NeighborList& out) {
  if (request.order == RowOrder::unsorted) {
    distribute_pairs(found, n, request.kind, request.first_ghost, out);
    out.margin = found.margin;
    return;
  }
  const auto for_each_pair = [&](const auto& f) {
    for (std::size_t r = 0; r < found.particle.size(); ++r) {
      const std::int32_t i = found.particle[r];
      for (const std::int32_t j : found.row(r)) f(std::min(i, j), std::max(i, j));
    }
  };
  assembler_.assemble(n, request.kind, request.first_ghost, for_each_pair, out);
  out.margin = found.margin;
}

std::size_t ListFinder::memory_bytes() const {
  std::size_t bytes = assembler_.memory_bytes();
  for (const NeighborList& list : found_)
    bytes += (list.first.capacity() + list.near_end.capacity()) * sizeof(std::int64_t) +
             (list.particle.capacity() + list.j.capacity()) * sizeof(std::int32_t);
  return bytes;
}

}  // namespace dch::detail
