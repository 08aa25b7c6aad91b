// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>
#include <dch/lists/list_params.hpp>
#include <dch/lists/neighbor_list.hpp>

#include "lists/leaf_rows.hpp"
#include "lists/list_assembly.hpp"

namespace dch::detail {

/// Makes the lists that are asked for: finds their rows and puts them into order. Owns the scratch memory.
class ListFinder {
 public:
  /// Several lists of the same points, at little more than the cost of the largest where their cutoffs depend
  /// on the same thing.
  /// @param positions of all particles as given, not wrapped
  void find(const ListScene& scene, Span<const Vec3> positions, Span<const ListParams> requests,
            const std::vector<NeighborList*>& out);
  ListWork work() const { return leaf_rows_.work(); }
  std::size_t memory_bytes() const;

 private:
  void find_alike(const ListScene& scene, Span<const Vec3> positions,
                  const std::vector<const ListParams*>& requests, const std::vector<NeighborList*>& out);
  void put_in_order(const ListParams& request, std::size_t n, const NeighborList& found, NeighborList& out);

  LeafRows leaf_rows_;
  std::vector<NeighborList> found_;  ///< rows as they were found, where another order is asked for
  ListAssembler assembler_;
};

}  // namespace dch::detail
