// SPDX-License-Identifier: MIT
#include "grid/auto_search.hpp"

#include <algorithm>
#include <cstdio>

#include <dch/base/error.hpp>

namespace dch {
namespace detail {
namespace {

constexpr int kLookEvery = 32;     ///< updates
constexpr int kServed = 2;         ///< updates without cluster pairs after which nobody wants them any more
constexpr double kChanged = 1.25;  ///< a scene that changed by this factor is chosen for anew

// Work beside that of the pairs, which is the same for both, in ns for a particle, measured once in the
// scenes of benchmarks/engine. Only their ratios matter.
constexpr double kGridPoint = 20;    ///< of the grid: to sort a point
constexpr double kNearby = 0.38;     ///< of the grid: for a point in the same cell
constexpr double kDenseCell = 100;   ///< of the grid: for a cell, of an array of all cells
constexpr double kSparseCell = 430;  ///< of the grid: for a cell, where occupied ones have to be looked up
constexpr double kLeafPoint = 40;  ///< of the hierarchy: to measure a point and find the leaves near its own
constexpr double kDistance = 1.5;  ///< of the hierarchy: for a distance in repairs and builds

bool differs(double a, double b) { return a > kChanged * b || b > kChanged * a; }

double volume_of(const Box& box) { return box.rank() == 3 ? box.volume() : 0; }

std::string with_one_digit(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", v);
  return text;
}

}  // namespace

AutoSearch::AutoSearch(const HierarchyParams& params)
    : params_(params), hierarchy_(make_dch_search(params)), grid_(params.radius, params.executor) {}

void AutoSearch::update(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys) {
  update_by(positions, box, keys, [&] { grid_.update(positions, box, keys); });
}

void AutoSearch::update_by_reference(Span<const Vec3> positions, const Box& box) {
  update_by(positions, box, {}, [&] { grid_.update_by_reference(positions, box); });
}

template <class UpdateGrid>
void AutoSearch::update_by(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys,
                           const UpdateGrid& update_grid) {
  const bool changed =
      differs(static_cast<double>(positions.size()), static_cast<double>(chosen_by_.particles)) ||
      differs(volume_of(box), chosen_by_.volume);
  looks_ = !has_chosen_ || looks_ || changed || ++updates_since_look_ >= kLookEvery;
  if (++updates_since_pairs_ <= kServed) serve_pairs();
  grid_has_them_ = hierarchy_has_them_ = false;
  try {
    keys_.assign(keys.begin(), keys.end());
    if (by_grid_ || looks_) {
      update_grid();
      grid_has_them_ = true;
    }
    if (!by_grid_) {
      hierarchy_->update(positions, box, keys);
      hierarchy_has_them_ = true;
    }
  } catch (...) {
    grid_has_them_ = hierarchy_has_them_ = false;
    by_grid_ = true;  // which holds nothing
    has_chosen_ = false;
    choice_.clear();
    grid_.clear();
    keys_.clear();
    throw;
  }
  ++updates_;
}

/// Lists come from the hierarchy too, as long as it has to be kept up for cluster pairs.
void AutoSearch::serve_pairs() {
  choice_ = "dch: cluster pairs are asked for";
  has_chosen_ = looks_ = by_grid_ = false;
  grid_.clear();
}

/// At an update that asked for a look; later ones of the same particles change nothing.
void AutoSearch::choose(Span<const ListParams> requests) {
  if (requests.empty() || updates_ == 0) return;
  double radius = 0;
  for (const ListParams& request : requests) radius = std::max(radius, request.list_radius());
  if (has_chosen_ && differs(radius, chosen_by_.radius)) looks_ = true;
  if (!looks_ || !grid_has_them_) return;
  Scene scene{grid_.positions().size(), volume_of(grid_.box()), radius};
  const std::optional<Occupancy> cells = grid_.occupancy_for(requests);
  if (cells) {
    scene.cells = cells->mean;
    scene.spread = cells->spread();
    scene.sparse = cells->sparse;
  }
  scene.distances = distances_an_update();
  choose_by(scene, cells.has_value());
  looks_ = false;
  updates_since_look_ = 0;
  hierarchy_updates_ = hierarchy_->stats().updates;
  hierarchy_distances_ = hierarchy_->stats().distances;
}

double AutoSearch::distances_an_update() const {
  const SearchStats& stats = hierarchy_->stats();
  const std::int64_t updates = stats.updates - hierarchy_updates_;
  if (updates == 0 || grid_.positions().empty()) return chosen_by_.distances;
  return static_cast<double>(stats.distances - hierarchy_distances_) / static_cast<double>(updates) /
         static_cast<double>(grid_.positions().size());
}

void AutoSearch::choose_by(const Scene& scene, bool has_cells) {
  const Scene& last = chosen_by_;
  const bool is_the_same =
      has_chosen_ && !differs(static_cast<double>(scene.particles), static_cast<double>(last.particles)) &&
      !differs(scene.volume, last.volume) && !differs(scene.radius, last.radius) &&
      !differs(scene.cells, last.cells) && !differs(scene.spread, last.spread) &&
      !differs(1 + scene.distances, 1 + last.distances);
  if (is_the_same) return;
  const double grid =
      kGridPoint + kNearby * scene.cells * scene.spread +
      (scene.sparse * kSparseCell + (1 - scene.sparse) * kDenseCell) / std::max(scene.cells, 1.0);
  const double hierarchy = kLeafPoint + kDistance * scene.distances;
  const bool by_grid = has_cells && grid <= hierarchy;
  if (!by_grid) bring_up_hierarchy();
  const std::string counted =
      has_cells ? with_one_digit(scene.cells) + " points a cell, spread " + with_one_digit(scene.spread)
                : "no cells for lists that reach half the box, or for points that far apart";
  choice_ = (by_grid ? "grid: " : "dch: ") + counted;
  if (scene.distances > 0)
    choice_ += ", " + with_one_digit(scene.distances) + " distances of the hierarchy a particle";
  by_grid_ = by_grid;
  chosen_by_ = scene;
  has_chosen_ = true;
  if (by_grid_) return;
  grid_.clear();
  grid_has_them_ = false;
}

/// Takes the particles of the grid: none after an update that threw.
void AutoSearch::bring_up_hierarchy() {
  if (hierarchy_has_them_) return;
  hierarchy_->update(grid_.positions(), grid_.box(), keys_);
  hierarchy_has_them_ = true;
}

void AutoSearch::cluster_pairs(const ListParams& params, ClusterPairs& out) {
  bring_up_hierarchy();
  hierarchy_->cluster_pairs(params, out);
  updates_since_pairs_ = 0;
}

std::string AutoSearch::validate() { return hierarchy_has_them_ ? hierarchy_->validate() : std::string(); }

std::vector<LevelInfo> AutoSearch::levels() {
  return hierarchy_has_them_ ? hierarchy_->levels() : std::vector<LevelInfo>();
}

const SearchStats& AutoSearch::stats() const {
  const SearchStats &of_grid = grid_.stats(), &of_hierarchy = hierarchy_->stats();
  stats_ = of_hierarchy;
  stats_ += of_grid;
  stats_.updates = updates_;
  stats_.levels = of_hierarchy.levels;
  stats_.maintain_seconds = of_grid.maintain_seconds + of_hierarchy.maintain_seconds;
  stats_.list_seconds = of_grid.list_seconds + of_hierarchy.list_seconds;
  stats_.memory_bytes = of_grid.memory_bytes + of_hierarchy.memory_bytes;
  return stats_;
}

}  // namespace detail

std::unique_ptr<PairSearch> make_auto_search(const HierarchyParams& params) {
  return std::make_unique<detail::AutoSearch>(params);
}

std::unique_ptr<PairSearch> make_search(const std::string& name, const HierarchyParams& params) {
  if (name == "dch") return make_dch_search(params);
  if (name == "grid") return make_grid_search(params.radius, params.executor);
  if (name == "cell") return make_cell_search(params.radius);
  if (name == "auto") return make_auto_search(params);
  throw InvalidParameter("there is no engine '" + name + "'; take dch, grid, cell or auto");
}

}  // namespace dch
