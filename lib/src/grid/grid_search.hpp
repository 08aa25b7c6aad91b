// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <dch/engines/pair_search.hpp>

#include "base/key_table.hpp"
#include "engines/size_classes.hpp"
#include "geometry/position_check.hpp"
#include "grid/cell_bins.hpp"
#include "grid/cell_layer.hpp"
#include "grid/grid_rows.hpp"
#include "grid/plain_cells.hpp"
#include "lists/list_finder.hpp"

namespace dch::detail {

/// PairSearch on cells that are filled anew at every update: the twin of the hierarchy, which keeps nothing.
///
/// How wide cells should be, and whether particles of different sizes should have grids of their own, is
/// known when a list is asked for. So list() sorts the positions; that time counts as maintenance. update()
/// looks at each of them once, though: it checks and copies them and finds their places in cells for lists as
/// the last ones, which list() makes use of if they are.
class GridSearch final : public PairSearch {
 public:
  GridSearch(double radius, Executor* executor) : radius_(radius), executor_(executor) {}

  GridSearch(const GridSearch&) = delete;  // positions_ may be those of copy_
  GridSearch& operator=(const GridSearch&) = delete;

  void update(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys) override;
  void update_by_reference(Span<const Vec3> positions, const Box& box) override;
  void list(const ListParams& params, NeighborList& out) override { make_lists({&params, 1}, {&out}); }
  void lists(Span<const ListParams> requests, std::vector<NeighborList>& out) override;
  void list_in_pieces(const ListParams& params, const std::function<void(const NeighborList&)>& use) override;
  using PairSearch::list;
  using PairSearch::lists;
  UnlistedPair unlisted_pair(const UnlistedQuestion& question) override;
  const SearchStats& stats() const override;
  std::string name() const override { return "grid"; }

  /// Forgets all particles, and keeps no memory of them.
  void clear();
  /// Those of the last update.
  Span<const Vec3> positions() const { return positions_; }
  const Box& box() const { return box_; }
  /// Of the cells that lists for the requests are made with; of all grids, where there are several. None if
  /// no cells can be had for them, as for lists that reach half the box.
  std::optional<Occupancy> occupancy_for(Span<const ListParams> requests);

 private:
  /// The particles of one class of sizes.
  struct Group {
    std::vector<std::int32_t> particle;  ///< empty if there is one class, of all
    CellLayer layer;
    double reach = 0;    ///< that the cells were made for, 0 if they hold other positions [length]
    double started = 0;  ///< that cells were started for, which all points have been taken for; 0 for none
    struct {
      double reach = 0, own = 0;  ///< of the last cells; 0 if there were none [length]
      double density = 0;         ///< in the cell of a point [1/length^3]
      double spread = 1;
      bool fine = false;  ///< for a list with a shell
    } last;
  };

  template <class Take>
  void update_by(const Take& take);
  enum class Keep { copy, reference };
  void take(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys, Keep keep);
  struct Reach {
    double error;   ///< how far distances may be from pair distances [length]
    bool in_cells;  ///< whether pairs can be found in cells
  };
  Reach prepare(Span<const ListParams> requests);
  GridScene scene_of(double error);
  void make_lists(Span<const ListParams> requests, const std::vector<NeighborList*>& out);
  double take_and_check(Span<const Vec3> positions, const PositionCheck& check);
  std::optional<CellBins> start_cells(Group& group, Span<const Vec3> positions, double reach, double own);
  bool take_points(Group& group, double reach, double own);
  const std::vector<std::int32_t>* members_of(const Group& group) const {
    return groups_.size() > 1 ? &group.particle : nullptr;
  }
  void classify(Span<const ListParams> requests);
  bool sort_points(double error);
  void find_plainly(double error, const std::vector<const PairFilter*>& filters,
                    const std::vector<NeighborList*>& out);

  double radius_;
  Executor* executor_;
  Span<const Vec3> positions_;
  std::vector<Vec3> copy_;  ///< of the positions; empty if they are the caller's
  Box box_;
  double wrap_error_ = 0;
  KeyTable key_table_;  ///< finds keys that repeat
  SizeRecord sizes_;    ///< that classes_ are of
  SizeClasses classes_;
  bool fine_ = false;                ///< whether cells are for a list with a shell
  std::vector<double> exact_reach_;  ///< that of classes_ without rounding [length]
  std::vector<Group> groups_;
  PlainCells plain_{1};
  bool has_plain_ = false;  ///< whether plain_ holds the points
  GridRows rows_;
  ListFinder list_finder_;
  mutable SearchStats stats_;
};

}  // namespace dch::detail
