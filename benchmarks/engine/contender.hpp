// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <dch/executor.hpp>
#include <dch/hierarchy.hpp>
#include <dch/neighbor_list.hpp>
#include <dch/pair_search.hpp>

#include "scene.hpp"
#include "simd_grid.hpp"
#include "size_grid.hpp"

namespace dch::bench {

/// Something that makes the lists of a scene, configuration after configuration.
class Contender {
 public:
  virtual ~Contender() = default;

  virtual std::string name() const = 0;
  /// The lists that the scene asks for at its present positions; this is what is timed.
  virtual void make_lists(const Scene& scene, std::vector<NeighborList>& lists) = 0;
  /// Forgets what it has seen, as if made anew.
  virtual void reset() = 0;
  /// Held now, lists left out.
  virtual std::size_t memory_bytes() const = 0;
  /// Whether its lists may hold pairs a little beyond the list radius; none within may be missing.
  virtual bool makes_supersets() const { return false; }
  /// Updates so far by what they took; null for one that keeps nothing.
  virtual const SearchStats* stats() const { return nullptr; }
  /// What is broken in the structure it keeps; empty if nothing is, or if it keeps none.
  virtual std::string validate() const { return {}; }
};

/// Lists by structure from a hierarchy that is kept up.
class DchContender : public Contender {
 public:
  struct Mode {
    MaintenancePolicy policy = MaintenancePolicy::automatic;
    bool superset = false;
    Executor* executor = nullptr;
  };
  DchContender(std::string name, const Scene& scene, const Mode& mode);

  std::string name() const override { return name_; }
  void make_lists(const Scene& scene, std::vector<NeighborList>& lists) override;
  void reset() override { search_ = make_dch_search(params_); }
  std::size_t memory_bytes() const override { return search_->stats().memory_bytes; }
  bool makes_supersets() const override { return superset_; }
  const SearchStats* stats() const override { return &search_->stats(); }
  std::string validate() const override;

 private:
  std::string name_;
  bool superset_;
  HierarchyParams params_;
  std::vector<ListParams> requests_;
  std::unique_ptr<PairSearch> search_;
};

/// A grid for each list, built anew each time.
class GridContender : public Contender {
 public:
  /// Takes the widths of cells that are fastest on the scene's present positions.
  GridContender(std::string name, const Scene& scene, SimdGrid::Cells cells);
  /// Whether there are cells for each list that can be held in memory and are not too wide for the box.
  bool fits() const;

  std::string name() const override { return name_; }
  void make_lists(const Scene& scene, std::vector<NeighborList>& lists) override;
  void reset() override;
  std::size_t memory_bytes() const override;

 private:
  std::string name_;
  SimdGrid::Cells cells_;
  std::vector<double> widths_;  ///< by list, relative to its radius
  std::vector<SimdGrid> grids_;
  std::vector<double> radii_;
};

/// Grids for several sizes of particles with radii, built anew each time.
class SizeGridContender : public Contender {
 public:
  /// Takes the sizes in one grid and the widths of cells that are fastest on the scene's present positions.
  SizeGridContender(std::string name, const Scene& scene);
  static bool can_make(const Scene& scene) { return !scene.radii.empty(); }

  std::string name() const override { return name_; }
  void make_lists(const Scene& scene, std::vector<NeighborList>& lists) override {
    grid_->list(scene.positions, scene.box, lists.front());
  }
  void reset() override {}
  std::size_t memory_bytes() const override { return grid_->memory_bytes(); }

 private:
  std::string name_;
  std::unique_ptr<SizeGrid> grid_;
};

/// All that can make the lists of the scene: hierarchies first, then grids.
/// @param executor of an additional hierarchy that uses several threads, or null
/// @param only the name of the one that is wanted; empty for all
std::vector<std::unique_ptr<Contender>> make_contenders(const Scene& scene, Executor* executor,
                                                        const std::string& only);

}  // namespace dch::bench
