// SPDX-License-Identifier: MIT
//
// Cost of keeping a neighbor list of a dense liquid: 37 neighbors an atom in a half list, as in the LJ melt
// of density 0.8442 with r_list = 2.8, atoms moving 0.05 a rebuild along each axis. Times are per atom and
// rebuild, structure and list together; `maintain` and `list` split them.
#include <benchmark/benchmark.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include <dch/engines/pair_search.hpp>
#include <dch/lists/all_pairs.hpp>

#include "simd_grid.hpp"

namespace {

constexpr double kDensity = 0.8442, kListRadius = 2.8, kStep = 0.05;

/// A simple cubic lattice, thoroughly shaken.
class Liquid {
 public:
  explicit Liquid(std::int64_t atoms) : engine_(1) {
    const auto side = static_cast<int>(std::lround(std::cbrt(static_cast<double>(atoms))));
    const double spacing = std::cbrt(1 / kDensity);
    for (int x = 0; x < side; ++x)
      for (int y = 0; y < side; ++y)
        for (int z = 0; z < side; ++z) positions.push_back({spacing * x, spacing * y, spacing * z});
    box = dch::Box::orthorhombic({spacing * side, spacing * side, spacing * side});
    for (dch::Vec3& p : positions) move(p, 0.3 * spacing);
  }
  void step() {
    for (dch::Vec3& p : positions) move(p, kStep);
  }

  std::vector<dch::Vec3> positions;
  dch::Box box;

 private:
  void move(dch::Vec3& p, double largest) {
    for (int axis = 0; axis < 3; ++axis)
      p[axis] += largest * (2 * static_cast<double>(engine_() >> 11) * 0x1p-53 - 1);
  }
  std::mt19937_64 engine_;
};

dch::ListParams list_params(dch::RowOrder order = dch::RowOrder::by_index) {
  dch::ListParams params;
  params.order = order;
  params.cutoffs = dch::TypeCutoffs(2.5);
  params.skin = kListRadius - 2.5;
  return params;
}

/// A benchmark of a wrong answer is void.
void check(dch::PairSearch& search) {
  Liquid liquid(4000);
  for (int rebuild = 0; rebuild < 3; ++rebuild) {
    liquid.step();
    search.update(liquid.positions, liquid.box);
    const dch::NeighborList expected = dch::all_pairs(liquid.positions, liquid.box, list_params());
    if (search.list(list_params()).j == expected.j) continue;
    std::fprintf(stderr, "%s: list differs from the oracle's; nothing was timed\n", search.name().c_str());
    std::exit(1);
  }
}

template <class MakeSearch>
void rebuilds(benchmark::State& state, MakeSearch make_search,
              dch::RowOrder order = dch::RowOrder::by_index) {
  check(*make_search());
  const auto search = make_search();
  Liquid liquid(state.range(0));
  dch::NeighborList list;
  search->update(liquid.positions, liquid.box);
  search->list(list_params(order), list);
  const double maintain_before = search->stats().maintain_seconds, list_before = search->stats().list_seconds;
  for (auto _ : state) {
    state.PauseTiming();
    liquid.step();
    state.ResumeTiming();
    search->update(liquid.positions, liquid.box);
    search->list(list_params(order), list);
    benchmark::DoNotOptimize(list.j.data());
  }
  const double atoms = static_cast<double>(liquid.positions.size());
  const double per_atom = 1e9 / (atoms * static_cast<double>(state.iterations()));
  const dch::SearchStats& stats = search->stats();
  state.counters["maintain_ns/atom"] = (stats.maintain_seconds - maintain_before) * per_atom;
  state.counters["list_ns/atom"] = (stats.list_seconds - list_before) * per_atom;
  state.counters["builds"] = static_cast<double>(stats.builds);
  state.counters["bytes/atom"] = static_cast<double>(stats.memory_bytes) / atoms;
  state.counters["pairs/atom"] = static_cast<double>(list.pairs()) / atoms;
}

dch::HierarchyParams hierarchy(dch::MaintenancePolicy policy) {
  dch::HierarchyParams params;
  params.radius = kListRadius;
  params.policy = policy;
  return params;
}

/// As hosts use it: repair when due, lists in the order of the structure.
void dch_lists(benchmark::State& state) {
  rebuilds(
      state, [] { return dch::make_dch_search(hierarchy(dch::MaintenancePolicy::automatic)); },
      dch::RowOrder::by_structure);
}
void dch_repair(benchmark::State& state) {
  rebuilds(state, [] { return dch::make_dch_search(hierarchy(dch::MaintenancePolicy::always_repair)); });
}
void dch_rebuild(benchmark::State& state) {
  rebuilds(state, [] { return dch::make_dch_search(hierarchy(dch::MaintenancePolicy::always_rebuild)); });
}
void cell_list(benchmark::State& state) {
  rebuilds(state, [] { return dch::make_cell_search(kListRadius); });
}
void cell_list_half_cells(benchmark::State& state) {
  rebuilds(state, [] { return dch::make_cell_search(kListRadius, 2); });
}

/// The baseline with the same kernels; range(1) is the cell width in tenths, to be swept for the least time.
template <dch::bench::SimdGrid::Cells cells>
void simd_grid(benchmark::State& state) {
  Liquid liquid(state.range(0));
  dch::bench::SimdGrid grid(kListRadius, 0.1 * static_cast<double>(state.range(1)), cells);
  dch::NeighborList list;
  grid.list(liquid.positions, liquid.box, {}, list);
  const auto cells_of_ours = dch::make_cell_search(kListRadius);
  cells_of_ours->update(liquid.positions, liquid.box);
  if (list.pairs() != cells_of_ours->list(list_params()).pairs()) {
    state.SkipWithError("the number of pairs is wrong");
    return;
  }
  for (auto _ : state) {
    state.PauseTiming();
    liquid.step();
    state.ResumeTiming();
    grid.list(liquid.positions, liquid.box, {}, list);
    benchmark::DoNotOptimize(list.j.data());
  }
}

BENCHMARK(dch_lists)->Arg(4000)->Arg(32000)->Arg(256000)->Unit(benchmark::kMillisecond);
BENCHMARK(simd_grid<dch::bench::SimdGrid::Cells::dense>)
    ->Name("simd_grid_dense")
    ->ArgsProduct({{32000}, {20, 25, 28, 31, 35}})
    ->Args({256000, 28})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(simd_grid<dch::bench::SimdGrid::Cells::hash>)
    ->Name("simd_grid_hash")
    ->Args({32000, 28})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(dch_repair)->Arg(4000)->Arg(32000)->Arg(256000)->Unit(benchmark::kMillisecond);
BENCHMARK(dch_rebuild)->Arg(4000)->Arg(32000)->Unit(benchmark::kMillisecond);
BENCHMARK(cell_list)->Arg(4000)->Arg(32000)->Arg(256000)->Unit(benchmark::kMillisecond);
BENCHMARK(cell_list_half_cells)->Arg(4000)->Arg(32000)->Arg(256000)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
