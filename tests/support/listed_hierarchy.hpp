// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <dch/clusters/cluster_pair_maker.hpp>
#include <dch/hierarchy/hierarchy.hpp>
#include <dch/lists/list_maker.hpp>

#include "engines/dch_search.hpp"
#include "hierarchy/structure_params.hpp"

namespace dch {

using detail::EdgeRule;
using detail::StructureParams;

/// A hierarchy with all that is made from views of it, as an engine has them.
class ListedHierarchy : public Hierarchy {
 public:
  using Hierarchy::Hierarchy;

  void list(const ListParams& params, NeighborList& out) { lists_.list(view(), params, out); }
  void lists(Span<const ListParams> requests, std::vector<NeighborList>& out) {
    lists_.lists(view(), requests, out);
  }
  void cluster_pairs(const ListParams& params, ClusterPairs& out) { pairs_.make(view(), params, out); }
  std::string validate() { return dch::validate(view()); }

  int levels() { return view().levels(); }
  LevelInfo level(int i) { return view().level(i); }
  int top_level(std::int32_t id) { return view().top_level(id); }
  std::int32_t parent(std::int32_t id, int i) { return view().parent(id, i); }
  std::vector<std::int32_t> neighbors(std::int32_t id, int i) { return view().neighbors(id, i); }
  Vec3 position(std::int32_t id) { return view().position(id); }

  ListMaker& list_maker() { return lists_; }
  ClusterPairMaker& pair_maker() { return pairs_; }

 private:
  ListMaker lists_;
  ClusterPairMaker pairs_;
};

inline ListedHierarchy hierarchy_of(const std::vector<Vec3>& points, const Box& box, double radius,
                                    double base_radius = 0, Executor* executor = nullptr) {
  StructureParams params;
  params.radius = radius;
  params.base_radius = base_radius;
  params.executor = executor;
  ListedHierarchy hierarchy(params);
  hierarchy.build(points, box);
  return hierarchy;
}

}  // namespace dch
