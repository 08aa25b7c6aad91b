// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/lists/list_params.hpp>
#include <dch/lists/neighbor_list.hpp>

#include "scene.hpp"
#include "simd_grid.hpp"
#include "size_grid.hpp"

namespace dch::bench {

/// Something that makes the lists of a scene, configuration after configuration.
class Contender {
 public:
  virtual ~Contender() = default;

  virtual std::string name() const = 0;
  /// Brings what it keeps, if anything, to the scene's present positions.
  virtual void update(const Scene&) {}
  /// The lists that the scene asks for at the positions of the last update().
  virtual void list(const Scene& scene, std::vector<NeighborList>& lists) = 0;
  /// Both.
  void make_lists(const Scene& scene, std::vector<NeighborList>& lists) {
    update(scene);
    list(scene, lists);
  }
  /// Forgets what it has seen, as if made anew.
  virtual void reset() = 0;
  /// Held now, lists left out.
  virtual std::size_t memory_bytes() const = 0;
  /// It takes part at every so many configurations. One that starts from nothing each time loses nothing by
  /// that, and is slow.
  virtual int every() const { return 1; }
  /// Whether its lists may hold pairs a little beyond the list radius; none within may be missing.
  virtual bool makes_supersets() const { return false; }
  /// Updates so far by what they took; null for one that keeps nothing.
  virtual const SearchStats* stats() const { return nullptr; }
  /// Which engine it took at last, and why; empty for one that has no choice.
  virtual std::string choice() const { return {}; }
  /// What is broken in the structure it keeps; empty if nothing is, or if it keeps none.
  virtual std::string validate() { return {}; }
};

/// Contender::every() of those that are slow.
inline constexpr int kSeldom = 5;

/// Unsorted lists from a hierarchy that is kept up.
class DchContender : public Contender {
 public:
  struct Mode {
    MaintenancePolicy policy = MaintenancePolicy::automatic;
    bool superset = false;
    Executor* executor = nullptr;
  };
  DchContender(std::string name, const Scene& scene, const Mode& mode);

  std::string name() const override { return name_; }
  void update(const Scene& scene) override { search_->update(scene.positions, scene.box); }
  void list(const Scene&, std::vector<NeighborList>& lists) override { search_->lists(requests_, lists); }
  void reset() override { search_ = make_dch_search(params_); }
  std::size_t memory_bytes() const override { return search_->stats().memory_bytes; }
  bool makes_supersets() const override { return superset_; }
  int every() const override { return params_.policy == MaintenancePolicy::always_rebuild ? kSeldom : 1; }
  const SearchStats* stats() const override { return &search_->stats(); }
  std::string validate() override;

 private:
  std::string name_;
  bool superset_;
  HierarchyParams params_;
  std::vector<ListParams> requests_;
  std::unique_ptr<PairSearch> search_;
};

/// The cell list of the library, built anew each time: in any box, without the kernels of the hierarchy.
class CellListContender : public Contender {
 public:
  explicit CellListContender(const Scene& scene);
  /// Cells as wide as the largest sphere, or for the largest of several radii, hold far too many particles.
  static bool can_make(const Scene& scene) { return scene.list_radii.size() == 1; }

  std::string name() const override { return "cell list"; }
  int every() const override { return kSeldom; }
  void update(const Scene& scene) override { search_->update(scene.positions, scene.box); }
  void list(const Scene&, std::vector<NeighborList>& lists) override { search_->lists(requests_, lists); }
  void reset() override { search_ = make_cell_search(radius_); }
  std::size_t memory_bytes() const override { return search_->stats().memory_bytes; }

 private:
  double radius_;
  std::vector<ListParams> requests_;
  std::unique_ptr<PairSearch> search_;
};

/// An engine of the library that decides for itself how lists are made: the grid, or the one that chooses.
class EngineContender : public Contender {
 public:
  /// @param engine see make_search
  EngineContender(std::string engine, const Scene& scene);

  std::string name() const override { return engine_; }
  void update(const Scene& scene) override { search_->update(scene.positions, scene.box); }
  void list(const Scene&, std::vector<NeighborList>& lists) override { search_->lists(requests_, lists); }
  void reset() override { search_ = make_search(engine_, params_); }
  std::size_t memory_bytes() const override { return search_->stats().memory_bytes; }
  std::string choice() const override { return search_->choice(); }
  std::string validate() override { return search_->validate(); }

 private:
  std::string engine_;
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
  /// Grids are of boxes with right angles.
  static bool can_make(const Scene& scene) { return scene.box.kind() != Box::Kind::triclinic; }

  std::string name() const override { return name_; }
  void list(const Scene& scene, std::vector<NeighborList>& lists) override;
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
  void list(const Scene& scene, std::vector<NeighborList>& lists) override {
    grid_->list(scene.positions, scene.box, lists.front());
  }
  void reset() override {}
  std::size_t memory_bytes() const override { return grid_->memory_bytes(); }

 private:
  std::string name_;
  std::unique_ptr<SizeGrid> grid_;
};

/// All that can make the lists of the scene: hierarchies first, then what keeps nothing.
/// @param executor of an additional hierarchy that uses several threads, or null
/// @param only the name of the one that is wanted; empty for all
std::vector<std::unique_ptr<Contender>> make_contenders(const Scene& scene, Executor* executor,
                                                        const std::string& only);

}  // namespace dch::bench
