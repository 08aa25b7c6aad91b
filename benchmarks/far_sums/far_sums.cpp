// SPDX-License-Identifier: MIT
//
// Far sums beside direct ones: charges of both signs at random in a cube, 1/r in open space. Arguments: the
// number of charges, and minus the decimal logarithm of the tolerance. The direct sum is a loop in double to
// some of the points; its time is that for all. It comes in two forms (direct_sums.hpp).
#include <algorithm>
#include <benchmark/benchmark.h>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <dch/hierarchy/hierarchy.hpp>
#include <dch/proximity/far_sums.hpp>

#include "direct_sums.hpp"

namespace dch::bench {
namespace {

struct Charges {
  explicit Charges(std::int64_t n) : q(static_cast<std::size_t>(n)) {
    std::mt19937_64 engine(1);
    const auto uniform = [&] { return std::cbrt(n) * static_cast<double>(engine() >> 11) * 0x1p-53; };
    for (std::size_t k = 0; k < q.size(); ++k) {
      for (auto* axis : {&x, &y, &z}) axis->push_back(uniform());
      q[k] = k % 2 == 0 ? 1 : -1;
    }
  }
  PointTree tree() const {
    std::vector<Vec3> positions;
    for (std::size_t k = 0; k < q.size(); ++k) positions.push_back({x[k], y[k], z[k]});
    HierarchyParams params;
    params.radius = 1.5;
    Hierarchy hierarchy(params);
    hierarchy.build(positions, Box::none());
    return PointTree(hierarchy.view());
  }
  std::vector<double> x, y, z, q;
};

struct Sum {
  double potential = 0, of_absolute = 0;
};

Sum exact_potential(const Charges& charges, Vec3 at) {
  Sum sum;
  for (std::size_t k = 0; k < charges.q.size(); ++k) {
    const double r = std::sqrt(norm2(Vec3{charges.x[k], charges.y[k], charges.z[k]} - at));
    if (r == 0) continue;
    sum.potential += charges.q[k] / r;
    sum.of_absolute += std::abs(charges.q[k]) / r;
  }
  return sum;
}

constexpr std::size_t kPoints = 200;  ///< of which errors, and times of direct sums, are measured

template <class F>
void for_some(const Charges& charges, const F& f) {
  const std::size_t n = charges.q.size(), step = std::max<std::size_t>(1, n / kPoints);
  for (std::size_t k = 0; k < n; k += step) f(k, Vec3{charges.x[k], charges.y[k], charges.z[k]});
}

void far(benchmark::State& state) {
  const Charges charges(state.range(0));
  const PointTree tree = charges.tree();
  FarSumParams params;
  params.tolerance = std::pow(10, -static_cast<double>(state.range(1)));
  FarSums sums;
  for (auto _ : state) sums = far_sums(tree, charges.q, params);
  double error = 0;
  for_some(charges, [&](std::size_t k, Vec3 at) {
    const Sum exact = exact_potential(charges, at);
    error = std::max(error, std::abs(sums.potentials[k] - exact.potential) / exact.of_absolute);
  });
  if (!(error <= sums.error_bound + 1e-13 && sums.error_bound <= params.tolerance))
    state.SkipWithError("the error is above its bound");
  const auto n = static_cast<double>(state.range(0));
  state.counters["order"] = sums.order;
  state.counters["bound"] = sums.error_bound;
  state.counters["error"] = error;
  state.counters["far_pairs"] = static_cast<double>(sums.far_pairs) / n;
  state.counters["near_pairs"] = static_cast<double>(sums.near_pairs) / n;
}

template <double (*kPotential)(const DirectCharges&, double, double, double)>
void direct(benchmark::State& state) {
  const Charges charges(state.range(0));
  const DirectCharges all{charges.x.data(), charges.y.data(), charges.z.data(), charges.q.data(),
                          charges.q.size()};
  double sum = 0;
  std::int64_t points = 0;
  for (auto _ : state)
    for_some(charges, [&](std::size_t, Vec3 at) {
      sum += kPotential(all, at.x, at.y, at.z);
      ++points;
    });
  benchmark::DoNotOptimize(sum);
  using benchmark::Counter;
  state.counters["all_points"] = Counter(static_cast<double>(points) / static_cast<double>(state.range(0)),
                                         Counter::kIsRate | Counter::kInvert);
}

BENCHMARK(far)->ArgsProduct({{2000, 20000, 100000}, {1, 2, 3, 4, 6, 8}})->Unit(benchmark::kMillisecond);
BENCHMARK(direct<plain_potential>)->Arg(2000)->Arg(20000)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK(direct<vectorized_potential>)->Arg(2000)->Arg(20000)->Arg(100000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace dch::bench

BENCHMARK_MAIN();
