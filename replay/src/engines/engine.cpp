// SPDX-License-Identifier: MIT
#include "engines/engine.hpp"

#include <utility>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/lists/all_pairs.hpp>

#include "base/stopwatch.hpp"

namespace dch::cli {
namespace {

/// The oracle as an engine.
class AllPairsSearch final : public PairSearch {
 public:
  void update(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t>) override {
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
  std::string validate() override { return inner_->validate(); }
  std::vector<LevelInfo> levels() override { return inner_->levels(); }
  const SearchStats& stats() const override { return stats_; }
  std::string name() const override { return inner_->name(); }
  std::string choice() const override { return inner_->choice(); }

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

/// Forwards to an engine that stays, and names the atoms to it.
class BorrowedSearch final : public PairSearch {
 public:
  BorrowedSearch(PairSearch& engine, std::vector<std::uint64_t> keys)
      : engine_(engine), keys_(std::move(keys)) {}

  void update(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t>) override {
    engine_.update(positions, box, keys_);
  }
  using PairSearch::list;
  void list(const ListParams& params, NeighborList& out) override { engine_.list(params, out); }
  const SearchStats& stats() const override { return engine_.stats(); }
  std::string name() const override { return engine_.name(); }
  std::string choice() const override { return engine_.choice(); }

 private:
  PairSearch& engine_;
  std::vector<std::uint64_t> keys_;
};

}  // namespace

std::string to_string(EngineKind kind) {
  switch (kind) {
    case EngineKind::grid:
      return "grid";
    case EngineKind::automatic:
      return "auto";
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

Engine make_engine(const EngineOptions& options, double radius, std::unique_ptr<Executor> threads) {
  Engine engine;
  if (options.kind == EngineKind::allpairs) {
    engine.search = std::make_unique<AllPairsSearch>();
  } else {
    if (takes_threads(options.kind)) engine.threads = std::move(threads);
    HierarchyParams params;
    params.radius = radius;
    params.policy = options.policy;
    params.executor = engine.threads.get();
    engine.search = make_search(to_string(options.kind), params);
    engine.keeps_hierarchy = may_keep_hierarchy(options.kind);
  }
  engine.search = std::make_unique<TimedSearch>(std::move(engine.search));
  return engine;
}

std::unique_ptr<PairSearch> borrow(PairSearch& engine, std::vector<std::uint64_t> keys) {
  return std::make_unique<BorrowedSearch>(engine, std::move(keys));
}

}  // namespace dch::cli
