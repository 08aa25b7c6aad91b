// SPDX-License-Identifier: MIT
//
// Lists, the search of cluster pairs and forces of the Lennard-Jones melt on several threads, by wall clock,
// with what a step or an update has to do before. Arguments: cubic cells of four atoms along each axis of the
// start, and the number of threads. Answers are those of one thread, to the last bit, or nothing is timed.
#include <algorithm>
#include <benchmark/benchmark.h>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/forces/lennard_jones.hpp>

#include "melt.hpp"

namespace {

using melt::kCutoff, melt::kSkin, melt::Melt, melt::request;

Melt& melt_of(std::int64_t cells) {
  static std::map<std::int64_t, Melt> melts;
  const auto [it, is_new] = melts.try_emplace(cells, static_cast<int>(cells));
  if (is_new) it->second.search_for(dch::ForcePrecision::mixed);
  return it->second;
}

/// What is timed, and all that it writes.
class Work {
 public:
  Work(Melt& melt, dch::Executor* executor)
      : melt_(melt), executor_(executor), search_(dch::make_dch_search(params(executor))) {
    potential_.set_executor(executor);
    unsorted_.order = dch::RowOrder::unsorted;
  }
  void list() {
    search_->update(melt_.positions, melt_.box);
    search_->list(unsorted_, list_);
  }
  void search() {
    search_->update(melt_.positions, melt_.box);
    search_->cluster_pairs(request(), pairs_);
  }
  void forces() {
    melt_.pairs.refresh(melt_.positions, melt_.box, executor_);
    potential_.add_forces(melt_.pairs, dch::ForcePrecision::mixed, force_);
  }
  bool has_same_as(const Work& other) const {
    const auto is_same_entry = [](const dch::ClusterPairs::Entry& a, const dch::ClusterPairs::Entry& b) {
      return std::tie(a.cluster, a.mask, a.shift) == std::tie(b.cluster, b.mask, b.shift);
    };
    const auto entries = static_cast<std::ptrdiff_t>(list_.first.empty() ? 0 : list_.first.back());
    return list_.first == other.list_.first && list_.particle == other.list_.particle &&
           std::equal(list_.j.begin(), list_.j.begin() + entries, other.list_.j.begin()) &&
           std::equal(pairs_.entries.begin(), pairs_.entries.end(), other.pairs_.entries.begin(),
                      other.pairs_.entries.end(), is_same_entry) &&
           force_ == other.force_;
  }

 private:
  static dch::HierarchyParams params(dch::Executor* executor) {
    dch::HierarchyParams params;
    params.radius = kCutoff + kSkin;
    params.executor = executor;
    return params;
  }

  Melt& melt_;
  dch::Executor* executor_;
  std::unique_ptr<dch::PairSearch> search_;
  dch::LennardJones potential_{{1, 1, kCutoff}};
  dch::ListParams unsorted_ = request();
  dch::NeighborList list_;
  dch::ClusterPairs pairs_;
  std::vector<dch::Vec3> force_ = std::vector<dch::Vec3>(melt_.positions.size());
};

template <void (Work::*part)()>
void on_threads(benchmark::State& state) {
  Melt& melt = melt_of(state.range(0));
  const auto pool = dch::make_thread_pool(static_cast<int>(state.range(1)));
  Work work(melt, pool.get()), alone(melt, nullptr);
  (work.*part)();
  (alone.*part)();
  if (!work.has_same_as(alone)) {
    std::fprintf(stderr, "%d threads have another answer than one; nothing was timed\n", pool->threads());
    std::exit(1);
  }
  for (auto _ : state) {
    (work.*part)();
    benchmark::ClobberMemory();
  }
  state.counters["ns/atom"] = benchmark::Counter(
      1e-9 * melt.atoms(), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

#define DCH_ON_THREADS(part)            \
  BENCHMARK(on_threads<&Work::part>)    \
      ->Name(#part)                     \
      ->ArgsProduct({{20, 40}, {1, 2}}) \
      ->UseRealTime()                   \
      ->Unit(benchmark::kMillisecond)
DCH_ON_THREADS(list);
DCH_ON_THREADS(search);
DCH_ON_THREADS(forces);
#undef DCH_ON_THREADS

}  // namespace

BENCHMARK_MAIN();
