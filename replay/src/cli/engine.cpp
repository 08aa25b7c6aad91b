// SPDX-License-Identifier: MIT
#include "engine.hpp"

#include <utility>
#include <vector>

#include <dch/all_pairs.hpp>
#include <dch/error.hpp>

#include "stopwatch.hpp"

namespace dch::cli {
namespace {

/// Frames of one trajectory name their atoms by index: nothing here needs keys.
void refuse_keys(Span<const std::uint64_t> keys) {
  if (!keys.empty()) throw InvalidParameter("a replay names its particles by index; give no keys");
}

/// A hierarchy as an engine that lets validate() and the levels be seen from outside.
class HierarchySearch final : public PairSearch {
 public:
  explicit HierarchySearch(const HierarchyParams& params) : hierarchy_(params) {}

  void update(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys) override {
    refuse_keys(keys);
    if (hierarchy_.capacity() == positions.size() && hierarchy_.stats().builds > 0) {
      hierarchy_.update(positions, box);
    } else {
      hierarchy_.build(positions, box);
    }
  }
  using PairSearch::list;
  void list(const ListParams& params, NeighborList& out) override { hierarchy_.list(params, out); }
  const SearchStats& stats() const override { return hierarchy_.stats(); }
  std::string name() const override { return "dch"; }
  const Hierarchy& hierarchy() const { return hierarchy_; }

 private:
  Hierarchy hierarchy_;
};

/// The oracle as an engine.
class AllPairsSearch final : public PairSearch {
 public:
  void update(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys) override {
    refuse_keys(keys);
    positions_.assign(positions.begin(), positions.end());
    box_ = box;
    ++stats_.updates;
    ++stats_.builds;
  }
  using PairSearch::list;
  void list(const ListParams& params, NeighborList& out) override {
    out = all_pairs(positions_, box_, params);
  }
  const SearchStats& stats() const override { return stats_; }
  std::string name() const override { return "allpairs"; }

 private:
  std::vector<Vec3> positions_;
  Box box_;
  SearchStats stats_;
};

/// Times another engine from outside, so that all engines are measured alike.
class TimedSearch final : public PairSearch {
 public:
  explicit TimedSearch(std::unique_ptr<PairSearch> inner) : inner_(std::move(inner)) {}

  void update(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys) override {
    const Stopwatch watch;
    inner_->update(positions, box, keys);
    maintain_seconds_ += watch.seconds();
    refresh();
  }
  using PairSearch::list;
  void list(const ListParams& params, NeighborList& out) override {
    const Stopwatch watch;
    inner_->list(params, out);
    list_seconds_ += watch.seconds();
    refresh();
  }
  const SearchStats& stats() const override { return stats_; }
  std::string name() const override { return inner_->name(); }

 private:
  void refresh() {
    stats_ = inner_->stats();
    stats_.maintain_seconds = maintain_seconds_;
    stats_.list_seconds = list_seconds_;
  }

  std::unique_ptr<PairSearch> inner_;
  double maintain_seconds_ = 0;
  double list_seconds_ = 0;
  SearchStats stats_;
};

}  // namespace

std::string to_string(EngineKind kind) {
  switch (kind) {
    case EngineKind::cell:
      return "cell";
    case EngineKind::allpairs:
      return "allpairs";
    case EngineKind::dch:
      break;
  }
  return "dch";
}

std::string to_string(MaintenancePolicy policy) {
  switch (policy) {
    case MaintenancePolicy::always_repair:
      return "repair";
    case MaintenancePolicy::always_rebuild:
      return "rebuild";
    case MaintenancePolicy::automatic:
      break;
  }
  return "auto";
}

Engine make_engine(const EngineOptions& options, double radius) {
  Engine engine;
  if (options.kind == EngineKind::cell) {
    engine.search = make_cell_search(radius);
  } else if (options.kind == EngineKind::allpairs) {
    engine.search = std::make_unique<AllPairsSearch>();
  } else {
    HierarchyParams params;
    params.radius = radius;
    params.c = options.c;
    params.policy = options.policy;
    auto search = std::make_unique<HierarchySearch>(params);
    engine.hierarchy = &search->hierarchy();
    engine.search = std::move(search);
  }
  engine.search = std::make_unique<TimedSearch>(std::move(engine.search));
  return engine;
}

}  // namespace dch::cli
