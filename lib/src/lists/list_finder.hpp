// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>
#include <dch/lists/list_params.hpp>
#include <dch/lists/neighbor_list.hpp>

#include "lists/list_assembly.hpp"
#include "lists/pair_filter.hpp"

namespace dch::detail {

/// What lists are made of, however their rows are found.
struct ListTask {
  Span<const Vec3> positions;  ///< of all particles as given, not wrapped
  const Box& box;
  double error;  ///< how far distances of wrapped positions may be from pair distances [length]
  Span<const std::int32_t> singletons{};  ///< particles that no row is found of, since they have no neighbors
};

/// Finds all pairs that each filter accepts, as unsorted half lists, ghosts having rows like all
/// others. The cutoffs of all filters go by the same thing, and the first one's list radius is the largest.
using FindRows =
    std::function<void(const std::vector<const PairFilter*>& filters, const std::vector<NeighborList*>& out)>;

/// Makes the lists that are asked for: has their rows found and puts them into order. Owns the scratch
/// memory.
class ListFinder {
 public:
  /// Several lists of the same points, at little more than the cost of the largest where their cutoffs depend
  /// on the same thing.
  void find(const ListTask& task, Span<const ListParams> requests, const FindRows& find_rows,
            const std::vector<NeighborList*>& out);
  std::size_t memory_bytes() const;

 private:
  void find_alike(const ListTask& task, const std::vector<const ListParams*>& requests,
                  const FindRows& find_rows, const std::vector<NeighborList*>& out);
  void put_in_order(const ListParams& request, std::size_t n, const NeighborList& found, NeighborList& out);

  std::vector<NeighborList> found_;  ///< rows as they were found, where another order is asked for
  ListAssembler assembler_;
};

}  // namespace dch::detail
