// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <dch/clusters/cluster_pair_maker.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/hierarchy/hierarchy.hpp>
#include <dch/lists/list_maker.hpp>

#include "base/key_table.hpp"
#include "hierarchy/structure_params.hpp"

namespace dch::detail {

/// PairSearch on a Hierarchy. With keys, particles are matched by name: those that left are removed, new ones
/// inserted and the rest renumbered; then all are moved at once.
class DchSearch final : public PairSearch {
 public:
  explicit DchSearch(const StructureParams& params) : hierarchy_(for_lists(params)) {}

  void update(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys) override;
  void list(const ListParams& params, NeighborList& out) override;
  void lists(Span<const ListParams> requests, std::vector<NeighborList>& out) override;
  using PairSearch::list;
  using PairSearch::lists;
  void cluster_pairs(const ListParams& params, ClusterPairs& out) override;
  bool has_cluster_pairs() const override { return true; }

  UnlistedPair unlisted_pair(const UnlistedQuestion& question) override;

  std::string validate() override { return dch::validate(hierarchy_.view()); }
  std::vector<LevelInfo> levels() override;
  const SearchStats& stats() const override;
  std::string name() const override { return "dch"; }
  Hierarchy& hierarchy() { return hierarchy_; }

 private:
  enum class State { empty, indexed, keyed };

  static StructureParams for_lists(StructureParams params) {
    params.keeps_block_positions = false;
    return params;
  }

  void by_index(Span<const Vec3> positions, const Box& box);
  void by_key(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys);
  bool match(Span<const Vec3> positions, Span<const std::uint64_t> keys);

  Hierarchy hierarchy_;
  ListMaker list_maker_;
  ClusterPairMaker pair_maker_;
  State state_ = State::empty;
  KeyTable keys_;  ///< of the last update
  std::int64_t updates_ = 0;
  double maintain_seconds_ = 0, list_seconds_ = 0;
  mutable SearchStats stats_;
};

}  // namespace dch::detail

namespace dch {

/// As the public one, with a choice of how the structure is made.
std::unique_ptr<PairSearch> make_dch_search(const detail::StructureParams& params);

}  // namespace dch
