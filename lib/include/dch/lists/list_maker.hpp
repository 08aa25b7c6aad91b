// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/hierarchy/hierarchy_view.hpp>
#include <dch/lists/list_params.hpp>
#include <dch/lists/neighbor_list.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// What has been looked at for lists: the work, counted alike on every machine.
struct ListWork {
  std::int64_t nodes = 0;     ///< of other hierarchies, in descents to leaves near one of the rows
  std::int64_t boxes = 0;     ///< of blocks, beside that of a part of a leaf
  std::int64_t gathered = 0;  ///< points of blocks near the box of a part of a leaf
  std::int64_t tested = 0;    ///< pairs of a block's lanes and points near the block

  void operator+=(const ListWork& more) {
    nodes += more.nodes;
    boxes += more.boxes;
    gathered += more.gathered;
    tested += more.tested;
  }
};

/// Makes neighbor lists of the points of a hierarchy: its level-0 edges, enumerated among the children of
/// nodes of level 1 that an edge joins (Lemma 5.3.1(5)). Keeps its memory from list to list. Not thread-safe;
/// uses the threads of the hierarchy's executor.
class ListMaker {
 public:
  ListMaker();
  ~ListMaker();
  ListMaker(ListMaker&&) noexcept;
  ListMaker& operator=(ListMaker&&) noexcept;

  /// The list of all pairs params asks for; row k is the point with id k, rows of free ids are empty.
  /// @throws InvalidParameter if params.list_radius() exceeds the hierarchy's radius, or types or exclusions
  /// do not
  ///   fit. After any throw `out` is empty or as it was.
  void list(const HierarchyView& hierarchy, const ListParams& params, NeighborList& out);
  /// Several lists, out[k] being that of requests[k]: at little more than the cost of the one with the
  /// largest radius, if the cutoffs of all depend on the same types or radii, or on neither.
  void lists(const HierarchyView& hierarchy, Span<const ListParams> requests, std::vector<NeighborList>& out);

  /// Of all lists so far, with the present number of threads.
  ListWork work() const;
  std::size_t memory_bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dch
#pragma GCC visibility pop
