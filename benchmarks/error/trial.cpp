// SPDX-License-Identifier: MIT
#include "trial.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <dch/engines/pair_search.hpp>

#include "rebuild_rules.hpp"
#include "stopwatch.hpp"

namespace dch::bench {
namespace {

HierarchyParams hierarchy_params(double skin) {
  HierarchyParams params;
  params.radius = kMeltCutoff + skin;
  return params;
}

ListParams list_params(double skin) {
  ListParams params;
  params.cutoffs = TypeCutoffs(kMeltCutoff);
  params.skin = skin;
  params.order = RowOrder::unsorted;
  return params;
}

/// The melt on cluster pairs that are made anew when the rule says so.
class Dynamics {
 public:
  Dynamics(Melt start, const Trial& trial, double time_step)
      : melt(std::move(start)),
        trial_(trial),
        time_step_(time_step),
        rule_(make_rebuild_rule(trial.rule, kMeltCutoff, trial.skin)),
        search_(make_dch_search(hierarchy_params(trial.skin))),
        potential_(LennardJonesPair{1, 1, kMeltCutoff}, true),
        forces(melt.positions.size()) {
    search_->update(melt.positions, melt.box);
    search();
    find_forces();
  }

  /// Velocity Verlet. Says whether pairs were searched anew.
  bool step() {
    for (std::size_t i = 0; i < forces.size(); ++i) {
      melt.velocities[i] = melt.velocities[i] + (0.5 * time_step_) * forces[i];
      melt.positions[i] = melt.positions[i] + time_step_ * melt.velocities[i];
    }
    const bool due = rule_->is_due(melt.positions, melt.box);
    if (due) {
      search_->update(melt.positions, melt.box);
      search();
    } else {
      pairs.refresh(melt.positions, melt.box);
    }
    find_forces();
    for (std::size_t i = 0; i < forces.size(); ++i)
      melt.velocities[i] = melt.velocities[i] + (0.5 * time_step_) * forces[i];
    return due;
  }

  /// Pairs within cutoff + skin at the positions of the last search. To be called right after it.
  NeighborList list() {
    NeighborList list;
    search_->list(list_params(trial_.skin), list);
    return list;
  }

  Melt melt;

 private:
  void search() {
    search_->cluster_pairs(list_params(trial_.skin), pairs);
    rule_->remember(melt.positions, melt.box);
  }
  void find_forces() {
    std::fill(forces.begin(), forces.end(), Vec3{});
    potential_.add_forces(pairs, trial_.precision, forces);
  }

  Trial trial_;
  double time_step_;
  std::unique_ptr<RebuildRule> rule_;
  std::unique_ptr<PairSearch> search_;
  LennardJones potential_;

 public:
  ClusterPairs pairs;
  std::vector<Vec3> forces;
};

/// A straight line through points, by least squares.
struct Line {
  double slope = 0, noise = 0;
};

Line line_through(const std::vector<double>& x, const std::vector<double>& y) {
  const auto count = static_cast<double>(x.size());
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0, rest2 = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    mean_x += x[k] / count;
    mean_y += y[k] / count;
  }
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += (x[k] - mean_x) * (x[k] - mean_x);
    xy += (x[k] - mean_x) * (y[k] - mean_y);
  }
  const double slope = xx > 0 ? xy / xx : 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double rest = y[k] - mean_y - slope * (x[k] - mean_x);
    rest2 += rest * rest;
  }
  return {slope, std::sqrt(rest2 / count)};
}

}  // namespace

TrialErrors errors_of(const Melt& start, const Trial& trial, const TrialLength& length) {
  Dynamics dynamics(start, trial, length.time_step);
  TrialErrors errors;
  std::optional<HeldPairs> in_clusters(dynamics.pairs), in_list(dynamics.list());
  std::vector<double> times, energies;
  double error2 = 0;
  for (int step = 1; step <= length.steps; ++step) {
    if (dynamics.step()) {
      ++errors.rebuilds;
      in_clusters.emplace(dynamics.pairs);
      in_list.emplace(dynamics.list());
    }
    if (step % length.check_every != 0) continue;
    const Truth truth = truth_of(dynamics.melt);
    ++errors.checks;
    errors.pairs += truth.pairs.pairs();
    errors.missed += in_clusters->missing_of(truth.pairs);
    errors.missed_by_list += in_list->missing_of(truth.pairs);
    const double error = relative_error(dynamics.forces, truth.forces);
    error2 += error * error;
    errors.largest_force_error = std::max(errors.largest_force_error, error);
    times.push_back(step * length.time_step);
    energies.push_back((truth.potential + dynamics.melt.kinetic_energy()) / dynamics.melt.atoms());
  }
  if (errors.checks == 0) return errors;
  errors.force_error = std::sqrt(error2 / errors.checks);
  const Line line = line_through(times, energies);
  errors.energy_drift = line.slope;
  errors.energy_noise = line.noise;
  return errors;
}

double time_of(const Melt& start, const Trial& trial, const TrialLength& length) {
  Dynamics dynamics(start, trial, length.time_step);
  const double seconds = seconds_of([&] {
    for (int step = 0; step < length.steps; ++step) dynamics.step();
  });
  return 1e9 * seconds / (length.steps * start.atoms());
}

Melt melted(Melt crystal, int steps, double time_step) {
  Dynamics dynamics(std::move(crystal), {}, time_step);
  for (int step = 0; step < steps; ++step) dynamics.step();
  return std::move(dynamics.melt);
}

}  // namespace dch::bench
