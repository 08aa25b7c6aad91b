// SPDX-License-Identifier: MIT
#include "contender.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "stopwatch.hpp"

namespace dch::bench {
namespace {

/// Widths of cells to try, relative to the list radius. The best one depends on the density: about 25
/// particles in a cell.
constexpr double kWidths[] = {0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.25, 1.4, 1.6, 1.8, 2.0, 2.3};
constexpr int kTrials = 5;
/// Dense cells beyond this many a particle only cost time and memory.
constexpr double kMostCells = 50;

double cells_in(const Scene& scene, double width) { return scene.box.volume() / (width * width * width); }

/// Least time over some trials; infinity if the grid cannot be used.
double trial(const Scene& scene, double radius, double width, SimdGrid::Cells cells, NeighborList& list) {
  if (cells == SimdGrid::Cells::dense &&
      cells_in(scene, width) > kMostCells * static_cast<double>(scene.positions.size()))
    return std::numeric_limits<double>::infinity();
  SimdGrid grid(radius, width, cells);
  double least = std::numeric_limits<double>::infinity();
  try {
    for (int k = 0; k < kTrials; ++k)
      least =
          std::min(least, seconds_of([&] { grid.list(scene.positions, scene.box, scene.exclusions, list); }));
  } catch (const std::invalid_argument&) {
    return std::numeric_limits<double>::infinity();  // the box is too narrow for such cells
  }
  return least;
}

}  // namespace

DchContender::DchContender(std::string name, const Scene& scene, MaintenancePolicy policy, Executor* executor)
    : name_(std::move(name)) {
  params_.radius = scene.list_radii.back();
  params_.policy = policy;
  params_.executor = executor;
  search_ = make_dch_search(params_);
}

void DchContender::make_lists(const Scene& scene, std::vector<NeighborList>& lists) {
  search_->update(scene.positions, scene.box);
  ListParams params;
  params.order = RowOrder::by_structure;
  params.exclusions = scene.exclusions.empty() ? nullptr : &scene.exclusions;
  for (std::size_t k = 0; k < scene.list_radii.size(); ++k) {
    params.cutoffs = TypeCutoffs(scene.list_radii[k]);
    search_->list(params, lists[k]);
  }
}

GridContender::GridContender(std::string name, const Scene& scene, SimdGrid::Cells cells)
    : name_(std::move(name)), cells_(cells), radii_(scene.list_radii) {
  NeighborList list;
  for (const double radius : radii_) {
    double best = 0, least = std::numeric_limits<double>::infinity();
    for (const double width : kWidths) {
      const double seconds = trial(scene, radius, width * radius, cells, list);
      if (seconds < least) {
        best = width;
        least = seconds;
      }
    }
    widths_.push_back(best);
  }
  GridContender::reset();
}

bool GridContender::can_make(const Scene& scene, SimdGrid::Cells cells) {
  if (!scene.radii.empty()) return false;
  NeighborList list;
  return std::all_of(scene.list_radii.begin(), scene.list_radii.end(), [&](double radius) {
    return std::any_of(std::begin(kWidths), std::end(kWidths), [&](double width) {
      return trial(scene, radius, width * radius, cells, list) < std::numeric_limits<double>::infinity();
    });
  });
}

void GridContender::make_lists(const Scene& scene, std::vector<NeighborList>& lists) {
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

std::vector<std::unique_ptr<Contender>> make_contenders(const Scene& scene, Executor* executor) {
  std::vector<std::unique_ptr<Contender>> all;
  if (DchContender::can_make(scene)) {
    const auto add = [&](std::string name, MaintenancePolicy policy, Executor* threads) {
      all.push_back(std::make_unique<DchContender>(std::move(name), scene, policy, threads));
    };
    add("dch", MaintenancePolicy::automatic, nullptr);
    add("dch, built anew", MaintenancePolicy::always_rebuild, nullptr);
    if (executor)
      add("dch, " + std::to_string(executor->threads()) + " threads", MaintenancePolicy::automatic, executor);
  }
  for (const auto& [name, cells] :
       {std::pair("dense grid", SimdGrid::Cells::dense), std::pair("hash grid", SimdGrid::Cells::hash)})
    if (GridContender::can_make(scene, cells))
      all.push_back(std::make_unique<GridContender>(name, scene, cells));
  return all;
}

}  // namespace dch::bench
