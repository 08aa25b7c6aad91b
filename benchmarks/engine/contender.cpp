// SPDX-License-Identifier: MIT
#include "contender.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "stopwatch.hpp"

namespace dch::bench {
namespace {

/// Widths of cells to try, relative to the list radius. The best one depends on the density: about 25
/// particles in a cell.
constexpr double kWidths[] = {0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.25, 1.4, 1.6, 1.8, 2.0, 2.3};
/// Largest to smallest radius in one grid.
constexpr double kLevelRatios[] = {1.4, 1.7, 2.0, 2.5, 3.2, 4.5, 8.0};
/// What takes so much longer than the best at the first trial is not tried again.
constexpr double kHopeless = 1.5;
constexpr int kTrials = 5;
/// Dense cells beyond this many a particle only cost time and memory.
constexpr double kMaxCells = 50;

double cells_in(const Scene& scene, double width) { return scene.box.volume() / (width * width * width); }

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Least time over some trials, fewer if it is far from the best so far.
template <class Call>
double least_seconds(double best, const Call& call) {
  double least = kNever;
  for (int k = 0; k < kTrials && (k == 0 || least < kHopeless * best); ++k)
    least = std::min(least, seconds_of(call));
  return least;
}

/// The width of cells that is fastest, relative to the list radius; 0 if none can be used.
double best_width(const Scene& scene, double radius, SimdGrid::Cells cells) {
  const double most_cells = kMaxCells * static_cast<double>(scene.positions.size());
  NeighborList list;
  double best = kNever, best_so_far = 0;
  for (const double width : kWidths) {
    if (cells == SimdGrid::Cells::dense && cells_in(scene, width * radius) > most_cells) continue;
    SimdGrid grid(radius, width * radius, cells);
    try {
      const double least =
          least_seconds(best, [&] { grid.list(scene.positions, scene.box, scene.exclusions, list); });
      if (least >= best) continue;
      best = least;
      best_so_far = width;
    } catch (const std::invalid_argument&) {
      continue;  // the box is too narrow for such cells
    }
  }
  return best_so_far;
}

/// What the scene asks for, in the order that is fastest to make.
std::vector<ListParams> requests_of(const Scene& scene, bool superset) {
  std::vector<ListParams> requests;
  ListParams request;
  request.order = RowOrder::unsorted;
  request.superset = superset;
  request.exclusions = scene.exclusions.empty() ? nullptr : &scene.exclusions;
  for (const double radius : scene.list_radii) {
    request.cutoffs = TypeCutoffs(radius);
    requests.push_back(request);
  }
  if (!scene.radii.empty()) {
    request.radii = scene.radii;
    request.skin = scene.skin;
    requests.push_back(request);
  }
  return requests;
}

}  // namespace

DchContender::DchContender(std::string name, const Scene& scene, const Mode& mode)
    : name_(std::move(name)), superset_(mode.superset), requests_(requests_of(scene, mode.superset)) {
  params_.radius = requests_.back().list_radius();
  params_.size_classes = !scene.radii.empty();
  params_.policy = mode.policy;
  params_.executor = mode.executor;
  search_ = make_dch_search(params_);
}

std::string DchContender::validate() { return search_->validate(); }

CellListContender::CellListContender(const Scene& scene)
    : radius_(scene.list_radii.back()), requests_(requests_of(scene, false)) {
  CellListContender::reset();
}

EngineContender::EngineContender(std::string engine, const Scene& scene)
    : engine_(std::move(engine)), requests_(requests_of(scene, false)) {
  params_.radius = requests_.back().list_radius();
  params_.size_classes = !scene.radii.empty();
  EngineContender::reset();
}

GridContender::GridContender(std::string name, const Scene& scene, SimdGrid::Cells cells)
    : name_(std::move(name)), cells_(cells), radii_(scene.list_radii) {
  for (const double radius : radii_) widths_.push_back(best_width(scene, radius, cells));
  GridContender::reset();
}

bool GridContender::fits() const {
  return !widths_.empty() && std::find(widths_.begin(), widths_.end(), 0) == widths_.end();
}

void GridContender::list(const Scene& scene, std::vector<NeighborList>& lists) {
  for (std::size_t k = 0; k < grids_.size(); ++k)
    grids_[k].list(scene.positions, scene.box, scene.exclusions, lists[k]);
}

void GridContender::reset() {
  grids_.clear();
  for (std::size_t k = 0; k < widths_.size(); ++k)
    grids_.emplace_back(radii_[k], widths_[k] * radii_[k], cells_);
}

std::size_t GridContender::memory_bytes() const {
  std::size_t bytes = 0;
  for (const SimdGrid& grid : grids_) bytes = std::max(bytes, grid.memory_bytes());
  return bytes;
}

SizeGridContender::SizeGridContender(std::string name, const Scene& scene) : name_(std::move(name)) {
  NeighborList list;
  double best = kNever;
  std::size_t layers = 0;
  for (const double ratio : kLevelRatios)
    for (const double width : kWidths) {
      auto grid = std::make_unique<SizeGrid>(scene.radii, scene.skin, scene.box, ratio, width);
      if (width == kWidths[0] && std::exchange(layers, grid->layers()) == grid->layers()) break;  // as before
      const double least = least_seconds(best, [&] { grid->list(scene.positions, scene.box, list); });
      if (least >= best) continue;
      best = least;
      grid_ = std::move(grid);
    }
}

std::vector<std::unique_ptr<Contender>> make_contenders(const Scene& scene, Executor* executor,
                                                        const std::string& only) {
  std::vector<std::unique_ptr<Contender>> all;
  const auto is_wanted = [&](const std::string& name) { return only.empty() || name == only; };
  const auto add = [&](const std::string& name, const DchContender::Mode& mode) {
    if (is_wanted(name)) all.push_back(std::make_unique<DchContender>(name, scene, mode));
  };
  add("dch", {});
  add("dch, superset", {.superset = true});
  add("dch, built anew", {.policy = MaintenancePolicy::always_rebuild});
  if (executor) add("dch, " + std::to_string(executor->threads()) + " threads", {.executor = executor});
  if (CellListContender::can_make(scene) && is_wanted("cell list"))
    all.push_back(std::make_unique<CellListContender>(scene));
  for (const char* const engine : {"grid", "auto"})
    if (is_wanted(engine)) all.push_back(std::make_unique<EngineContender>(engine, scene));
  // Grids are tuned when they are made, which takes a while.
  const std::string by_size = "grids by size";
  if (SizeGridContender::can_make(scene) && is_wanted(by_size))
    all.push_back(std::make_unique<SizeGridContender>(by_size, scene));
  for (const auto& [name, cells] :
       {std::pair("dense grid", SimdGrid::Cells::dense), std::pair("hash grid", SimdGrid::Cells::hash)}) {
    if (!is_wanted(name) || !GridContender::can_make(scene)) continue;
    auto grid = std::make_unique<GridContender>(name, scene, cells);
    if (grid->fits()) all.push_back(std::move(grid));
  }
  return all;
}

}  // namespace dch::bench
