// SPDX-License-Identifier: MIT
#include "switches.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/engines/pair_search.hpp>

#include "engines/dch_search.hpp"
#include "stopwatch.hpp"
#include "trial.hpp"

namespace dch::bench {
namespace {

constexpr int kStepsApart = 10;
constexpr double kTimeStep = 0.005;

struct Switch {
  std::string what;
  detail::StructureParams structure;
  bool superset = false;
};

std::vector<Switch> switches(double radius) {
  detail::StructureParams params;
  params.radius = radius;
  std::vector<Switch> all = {{"exact list", params}, {"superset", params, true}};
  for (const double share : {0.5, 1.0, 2.0}) {
    params.base_radius = share * radius;
    all.push_back({fmt::format("R_0 = {:g} list radii", share), params});
  }
  params.base_radius = 0;
  params.edge_rule = detail::EdgeRule::thesis;
  for (const double c : {1.05, 1.5, 2.0, 3.0}) {
    params.c = c;
    all.push_back({fmt::format("thesis, c = {:g}", c), params});
  }
  return all;
}

ListParams request(double skin, bool superset) {
  ListParams params;
  params.cutoffs = TypeCutoffs(kMeltCutoff);
  params.skin = skin;
  params.order = RowOrder::unsorted;
  params.superset = superset;
  return params;
}

void check(const Switch& choice, const Melt& melt, const ListParams& params, const NeighborList& list) {
  const auto search = make_cell_search(params.list_radius());
  search->update(melt.positions, melt.box);
  ListParams exact = params;
  exact.superset = false;
  const NeighborList expected = search->list(exact);
  const std::int64_t missing = HeldPairs(list).missing_of(expected);
  if (missing > 0 || (!choice.superset && list.pairs() != expected.pairs()))
    throw Error(fmt::format("{}: the list has {} pairs, {} expected ones are missing of {}", choice.what,
                            list.pairs(), missing, expected.pairs()));
}

void check_all(const Switch& choice, const std::vector<Melt>& melts, const ListParams& params) {
  const auto search = make_dch_search(choice.structure);
  search->update(melts.front().positions, melts.front().box);
  NeighborList list;
  for (const Melt& melt : melts) {
    search->update(melt.positions, melt.box);
    search->list(params, list);
    if (&melt == &melts.front() || &melt == &melts.back()) check(choice, melt, params, list);
  }
}

void time_once(const Switch& choice, const std::vector<Melt>& melts, const ListParams& params,
               SwitchCost& cost) {
  const double per_atom = 1e9 / melts.front().atoms();
  const auto search = make_dch_search(choice.structure);
  NeighborList list;
  cost.first_ns = std::min(cost.first_ns, per_atom * seconds_of([&] {
                                            search->update(melts.front().positions, melts.front().box);
                                            search->list(params, list);
                                          }));
  double seconds = 0;
  for (std::size_t k = 1; k < melts.size(); ++k)
    seconds += seconds_of([&] {
      search->update(melts[k].positions, melts[k].box);
      search->list(params, list);
    });
  cost.ns.push_back(per_atom * seconds / static_cast<double>(melts.size() - 1));
  const double atoms = melts.front().atoms();
  cost.bytes = static_cast<double>(search->stats().memory_bytes) / atoms;
  const std::vector<LevelInfo> levels = search->levels();
  cost.levels = static_cast<int>(levels.size());
  cost.edges = 0;
  for (std::size_t level = 1; level < levels.size(); ++level)
    cost.edges += static_cast<double>(levels[level].edges) / atoms;
  cost.listed = static_cast<double>(list.pairs()) / atoms;
  cost.margin = list.margin;
}

}  // namespace

std::vector<SwitchCost> costs_of_switches(const Melt& start, double skin, int configurations,
                                          int repetitions) {
  std::vector<Melt> melts{start};
  for (int k = 0; k < configurations; ++k) melts.push_back(melted(melts.back(), kStepsApart, kTimeStep));
  const std::vector<Switch> choices = switches(kMeltCutoff + skin);
  std::vector<SwitchCost> costs;
  for (const Switch& choice : choices) {
    check_all(choice, melts, request(skin, choice.superset));
    SwitchCost cost;
    cost.what = choice.what;
    cost.first_ns = std::numeric_limits<double>::infinity();
    costs.push_back(std::move(cost));
  }
  for (int repetition = 0; repetition < repetitions; ++repetition)
    for (std::size_t k = 0; k < choices.size(); ++k)
      time_once(choices[k], melts, request(skin, choices[k].superset), costs[k]);
  return costs;
}

}  // namespace dch::bench
