// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <dch/geometry/box.hpp>
#include <dch/hierarchy/hierarchy.hpp>

#include "base/key_table.hpp"
#include "engines/dch_search.hpp"
#include "engines/size_classes.hpp"
#include "leaves/leaf_source.hpp"
#include "lists/leaf_rows.hpp"
#include "lists/list_finder.hpp"

namespace dch::detail {

/// PairSearch for particles whose cutoffs differ much: a hierarchy for each class of sizes. The pairs of two
/// classes are found leaf by leaf of the larger one, by descending the hierarchy of the smaller one.
///
/// What the sizes are is known when a list is asked for, so update() only takes the positions and list()
/// brings the hierarchies up to date; that time counts as maintenance.
class SizedSearch final : public PairSearch {
 public:
  explicit SizedSearch(const StructureParams& params);

  void update(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys) override;
  void list(const ListParams& params, NeighborList& out) override { make_lists({&params, 1}, {&out}); }
  void lists(Span<const ListParams> requests, std::vector<NeighborList>& out) override;
  using PairSearch::list;
  using PairSearch::lists;
  UnlistedPair unlisted_pair(const UnlistedQuestion& question) override;
  std::string validate() override;

  const SearchStats& stats() const override;
  std::string name() const override { return "dch"; }

 private:
  /// The particles of one class.
  struct Group {
    std::unique_ptr<DchSearch> search;
    LeafSource source;
    std::vector<std::int32_t> particle;  ///< by id in the group's hierarchy
    std::vector<Vec3> positions;
    std::vector<std::uint64_t> keys;
    bool is_new = true;  ///< whether `particle` is not what the hierarchy was last brought up to date with
  };

  void clear();
  void make_lists(Span<const ListParams> requests, const std::vector<NeighborList*>& out);
  ListScene scene();
  void classify(Span<const ListParams> requests);
  void assign_particles();
  void take_positions(Group& group) const;
  void bring_up_to_date();
  void retire(const Group& group);

  StructureParams params_;
  Box box_;
  std::vector<Vec3> positions_;
  double largest_reach_ = 0;  ///< largest WrapError::reach of the positions [length]
  std::vector<std::uint64_t> keys_;
  KeyTable key_table_;  ///< finds keys that repeat
  bool stale_ = false;  ///< whether positions have come that the groups do not have
  SizeRecord sizes_;    ///< that the classes were made from
  double largest_radius_ = 0;
  double host_error_ = 0;          ///< largest ListParams::cutoff_error() of the requests [length]
  bool told_apart_ = false;        ///< whether there may be several classes
  std::uint64_t ids_version_ = 0;  ///< see ParticleIds
  SizeClasses classes_;
  std::vector<Group> groups_;
  LeafRows leaf_rows_;
  ListFinder list_finder_;
  std::vector<LeafSource*> sources_;  ///< of the groups
  std::int64_t updates_ = 0;
  double maintain_seconds_ = 0, list_seconds_ = 0;
  SearchStats retired_;  ///< of hierarchies that are no more
  mutable SearchStats stats_;
};

}  // namespace dch::detail
