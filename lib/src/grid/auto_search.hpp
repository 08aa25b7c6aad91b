// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <dch/engines/pair_search.hpp>

#include "grid/grid_search.hpp"

namespace dch::detail {

/// The hierarchy or the grid, whichever takes less work by what has been counted; see make_auto_search().
class AutoSearch final : public PairSearch {
 public:
  explicit AutoSearch(const HierarchyParams& params);

  void update(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys) override;
  void update_by_reference(Span<const Vec3> positions, const Box& box) override;
  void list(const ListParams& params, NeighborList& out) override {
    choose({&params, 1});
    engine().list(params, out);
  }
  void lists(Span<const ListParams> requests, std::vector<NeighborList>& out) override {
    choose(requests);
    engine().lists(requests, out);
  }
  void list_in_pieces(const ListParams& params,
                      const std::function<void(const NeighborList&)>& use) override {
    choose({&params, 1});
    engine().list_in_pieces(params, use);
  }
  using PairSearch::list;
  using PairSearch::lists;
  void cluster_pairs(const ListParams& params, ClusterPairs& out) override;
  bool has_cluster_pairs() const override { return hierarchy_->has_cluster_pairs(); }

  UnlistedPair unlisted_pair(const UnlistedQuestion& question) override {
    return engine().unlisted_pair(question);
  }
  std::string validate() override;
  std::vector<LevelInfo> levels() override;
  const SearchStats& stats() const override;
  std::string name() const override { return "auto"; }
  std::string choice() const override { return choice_; }

 private:
  /// What a choice goes by.
  struct Scene {
    std::size_t particles = 0;
    double volume = 0;  ///< of the box, 0 if it is open [length^3]
    double radius = 0;  ///< largest list radius [length]
    double cells = 0;   ///< points in a cell on average
    double spread = 0;
    double sparse = 0;     ///< share of the particles in grids that look occupied cells up
    double distances = 0;  ///< that the hierarchy computed at an update, for each particle
  };
  PairSearch& engine() { return by_grid_ ? static_cast<PairSearch&>(grid_) : *hierarchy_; }
  template <class UpdateGrid>
  void update_by(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys,
                 const UpdateGrid& update_grid);
  void serve_pairs();
  void choose(Span<const ListParams> requests);
  void choose_by(const Scene& scene, bool has_cells);
  void bring_up_hierarchy();
  double distances_an_update() const;

  HierarchyParams params_;
  std::unique_ptr<PairSearch> hierarchy_;
  GridSearch grid_;
  std::vector<std::uint64_t> keys_;
  bool grid_has_them_ = false, hierarchy_has_them_ = false;  ///< the particles of the last update
  bool by_grid_ = true;
  bool has_chosen_ = false, looks_ = true;  ///< whether a choice has been made, and whether one is due
  int updates_since_look_ = 0;
  std::int64_t updates_since_pairs_ = std::int64_t{1} << 32;  ///< were asked for; they never were
  Scene chosen_by_;
  std::int64_t hierarchy_updates_ = 0, hierarchy_distances_ = 0;  ///< at the last look
  std::string choice_;
  std::int64_t updates_ = 0;
  mutable SearchStats stats_;
};

}  // namespace dch::detail
