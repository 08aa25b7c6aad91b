// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/forces/generalized_born.hpp>

#include "base/describe.hpp"
#include "cluster_tasks.hpp"
#include "simd/force_kernels.hpp"
#include "turns.hpp"

namespace dch {
namespace {

constexpr double kMaxRatio = 1000;  // of radii: artanh in single precision serves up to it

std::string of_particle(const char* what, std::size_t i, double value) {
  return std::string(what) + " of particle " + std::to_string(i) + " is " + detail::describe(value);
}

void check_particle(const BornParticle& p, std::size_t i) {
  if (!(std::isfinite(p.radius) && p.radius > 0))
    throw InvalidParameter(of_particle("the radius", i, p.radius) + "; it must be positive and finite");
  if (!std::isfinite(p.scaled))
    throw InvalidParameter(of_particle("the scaled radius", i, p.scaled) + "; it must be finite");
}

/// Rows of kinds x kinds numbers, or their columns, in single precision.
std::vector<float> table_of(const std::vector<double>& numbers, int kinds, bool transposed) {
  const auto side = static_cast<std::size_t>(kinds);
  std::vector<float> table(std::max(side * side, std::size_t{detail::kFewTypes * detail::kFewTypes}));
  for (std::size_t a = 0; a < side; ++a)
    for (std::size_t b = 0; b < side; ++b)
      table[a * side + b] = static_cast<float>(numbers[transposed ? b * side + a : a * side + b]);
  return table;
}

/// Calls act(particle, slot) for the particles of clusters.
template <class Act>
void for_each_particle(const ClusterPairs& pairs, std::size_t cluster, const Act& act) {
  for (std::size_t slot = 0; slot < ClusterPairs::kSlots; ++slot) {
    const std::int32_t i = pairs.particle[cluster * ClusterPairs::kSlots + slot];
    if (i >= 0) act(static_cast<std::size_t>(i), slot);
  }
}

/// Null where a pass has none.
template <class Slots>
const float* numbers_of(const Slots& slots) {
  return slots.empty() ? nullptr : slots.data()->slot;
}

/// What a cluster's own task and those before it have found for it; leaves both 0.
ClusterOfFour<float> taken(ClusterOfFour<float>& found, ClusterOfFour<float>& earlier, bool has_earlier) {
  ClusterOfFour<float> all = std::exchange(found, {});
  if (has_earlier) detail::add(std::exchange(earlier, {}), all);
  return all;
}

}  // namespace

BornSums::BornSums(double cutoff, Span<const BornParticle> particles, bool counts_inside)
    : cutoff_(cutoff), counts_inside_(counts_inside) {
  if (!(std::isfinite(cutoff) && cutoff > 0))
    throw InvalidParameter("the cutoff of a generalized Born sum is " + detail::describe(cutoff) +
                           "; it must be finite and positive");
  double least = cutoff;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    check_particle(particles[i], i);
    radii_.push_back(particles[i].radius);
    scaled_.push_back(particles[i].scaled);
    largest_radius_ = std::max(largest_radius_, particles[i].radius);
    largest_scaled_ = std::max(largest_scaled_, std::abs(particles[i].scaled));
    least = std::min(least, particles[i].radius);
  }
  fits_single_ = std::max(largest_radius_, 2 * largest_scaled_) < kMaxRatio * least;
}

void BornSums::set_necks(BornNecks necks) {
  const auto side = static_cast<std::size_t>(std::max(necks.kinds, 0));
  if (necks.kinds < 1 || necks.at.size() != side * side || necks.height.size() != side * side ||
      necks.kind.size() != radii_.size())
    throw InvalidParameter("necks of " + std::to_string(necks.kinds) + " kinds have tables of " +
                           std::to_string(necks.at.size()) + " and " + std::to_string(necks.height.size()) +
                           " numbers and kinds of " + std::to_string(necks.kind.size()) +
                           " particles; give kinds x kinds numbers and a kind for each particle");
  for (const std::int32_t kind : necks.kind)
    if (kind < 0 || kind >= necks.kinds)
      throw InvalidParameter("a particle has the kind " + std::to_string(kind) + " of " +
                             std::to_string(necks.kinds) + "; kinds are counted from 0");
  neck_tables_[0] = table_of(necks.at, necks.kinds, false);
  neck_tables_[1] = table_of(necks.height, necks.kinds, false);
  neck_tables_[2] = table_of(necks.at, necks.kinds, true);
  neck_tables_[3] = table_of(necks.height, necks.kinds, true);
  necks_ = std::move(necks);
}

void BornSums::check(const ClusterPairs& pairs, std::initializer_list<std::size_t> sizes) const {
  for (const std::size_t size : sizes)
    if (size != pairs.particles || radii_.size() != pairs.particles)
      throw InvalidParameter("a generalized Born sum of " + std::to_string(radii_.size()) +
                             " particles got " + std::to_string(size) + " numbers for pairs of " +
                             std::to_string(pairs.particles) + " particles; give one each");
  if (cutoff_ > pairs.list_radius)
    throw InvalidParameter("the cutoff " + detail::describe(cutoff_) + " exceeds the radius " +
                           detail::describe(pairs.list_radius) +
                           " of the pairs; make them with a larger one");
}

detail::BornConstants BornSums::constants() const {
  detail::BornConstants all;
  all.cutoff2 = static_cast<float>(cutoff_ * cutoff_);
  const double touch = largest_radius_ + largest_scaled_;
  all.far2 =
      static_cast<float>(std::max(touch * touch, largest_scaled_ * largest_scaled_ / detail::kBornFarRatio2));
  all.counts_inside = counts_inside_ ? 1 : 0;
  all.neck_scale = static_cast<float>(necks_.scale);
  all.neck_reach = static_cast<float>(necks_.reach);
  const double reach = std::max(2 * largest_radius_ + necks_.reach, 0.0);
  all.neck_far2 = static_cast<float>(reach * reach);
  return all;
}

void BornSums::sort(const ClusterPairs& pairs, Span<const double> numbers, Slots& slots, float padding) {
  slots.resize(static_cast<std::size_t>(pairs.clusters()));
  for (std::size_t c = 0; c < slots.size(); ++c) {
    for (float& number : slots[c].slot) number = padding;
    for_each_particle(pairs, c, [&](std::size_t i, std::size_t slot) {
      slots[c].slot[slot] = static_cast<float>(numbers[i]);
    });
  }
}

void BornSums::sort_kinds(const ClusterPairs& pairs) {
  if (necks_.kinds == 0) return;
  kind_slots_.assign(pairs.particle.size(), 0);
  for (std::size_t k = 0; k < kind_slots_.size(); ++k)
    if (pairs.particle[k] >= 0) kind_slots_[k] = necks_.kind[static_cast<std::size_t>(pairs.particle[k])];
}

void BornSums::prepare(const ClusterPairs& pairs) {
  sort(pairs, radii_, radius_slots_, 1);
  sort(pairs, scaled_, scaled_slots_, 0);
  sort_kinds(pairs);
}

/// What the passes read and write that is the same for all tasks.
detail::BornTask BornSums::task_of(const ClusterPairs& pairs, const detail::BornConstants& constants) const {
  detail::BornTask task{};
  task.entries = pairs.entries.data();
  task.at = pairs.at_in_units.data();
  task.shift = pairs.shift_in_units.data();
  task.unit = pairs.unit;
  task.radius = numbers_of(radius_slots_);
  task.scaled = numbers_of(scaled_slots_);
  task.charge = numbers_of(charge_slots_);
  task.born = numbers_of(born_slots_);
  task.half_over = numbers_of(half_slots_);
  task.slope = numbers_of(slope_slots_);
  task.kind = kind_slots_.data();
  task.kinds = necks_.kinds;
  task.neck_at = neck_tables_[0].data();
  task.neck_height = neck_tables_[1].data();
  task.neck_at_of_j = neck_tables_[2].data();
  task.neck_height_of_j = neck_tables_[3].data();
  task.constants = constants;
  return task;
}

/// All memory that a pass needs: from then on it cannot fail half done.
void BornSums::make_room(std::size_t workers, std::size_t clusters) {
  workers_.resize(std::max(workers_.size(), workers));
  for (Worker& worker : workers_) {
    worker.force.resize(clusters);
    worker.scalar.resize(clusters);
    worker.lanes.resize(clusters);
  }
  earlier_force_.resize(clusters);
  earlier_scalar_.resize(clusters);
}

/// Gives particles what has been found for the clusters of a task, which later tasks do not name.
void BornSums::hand_out(const ClusterPairs& pairs, ClusterPairs::Range own, Worker& found, Span<Vec3> forces,
                        Span<double> scalars) {
  for (auto c = static_cast<std::size_t>(own.first); c < static_cast<std::size_t>(own.last); ++c) {
    const bool has_earlier =
        pairs.has_earlier_contributions[static_cast<std::size_t>(pairs.origin_of[c])] != 0;
    const ClusterOfFour<float> force = taken(found.force[c], earlier_force_[c], has_earlier);
    const ClusterOfFour<float> scalar = taken(found.scalar[c], earlier_scalar_[c], has_earlier);
    for_each_particle(pairs, c, [&](std::size_t i, std::size_t slot) {
      if (!forces.empty())
        forces[i] = forces[i] +
                    pairs.unit * Vec3{double{force.x[slot]}, double{force.y[slot]}, double{force.z[slot]}};
      if (!scalars.empty()) scalars[i] += double{scalar.x[slot]};
    });
  }
}

template <class Kernel>
double BornSums::run(const ClusterPairs& pairs, const detail::BornConstants& constants, const Kernel& kernel,
                     Span<Vec3> forces, Span<double> scalars) {
  const auto tasks = static_cast<int>(pairs.tasks.size()) - 1;
  if (tasks < 1) return 0;
  const int workers = executor_ ? std::min(executor_->threads(), tasks) : 1;
  make_room(static_cast<std::size_t>(workers), static_cast<std::size_t>(pairs.clusters()));
  const detail::BornTask common = task_of(pairs, constants);
  double total = 0;
  detail::Turns turns(tasks);
  detail::run_parts(executor_, workers, [&](int worker) {
    Worker& found = workers_[static_cast<std::size_t>(worker)];
    for (int k = turns.take(); k >= 0; k = turns.take()) {
      const ClusterPairs::Task& own = pairs.tasks[static_cast<std::size_t>(k)];
      const ClusterPairs::Task& next = pairs.tasks[static_cast<std::size_t>(k) + 1];
      const std::size_t first_row = pairs.first_row(own);
      detail::BornTask task = common;
      task.rows = pairs.rows.data() + first_row;
      task.row_count = static_cast<std::int64_t>(pairs.first_row(next) - first_row);
      task.force = found.force.data();
      task.scalar = found.scalar.data();
      task.lanes = found.lanes.empty() ? nullptr : found.lanes.front().numbers;
      task.own = {own.first_cluster, next.first_cluster};
      task.later = {pairs.ranges.data() + own.first_range,
                    static_cast<std::size_t>(next.first_range - own.first_range)};
      const double energy = kernel(task);
      turns.in_turn(k, [&] {
        detail::add_for_later(task.later, found.force, earlier_force_);
        detail::add_for_later(task.later, found.scalar, earlier_scalar_);
        total += energy;
      });
      hand_out(pairs, task.own, found, forces, scalars);
    }
  });
  return total;
}

const detail::BornKernels& BornSums::kernels() { return detail::force_kernels(instruction_set()).born; }

void BornSums::add_integrals(const ClusterPairs& pairs, Span<double> integrals) {
  check(pairs, {integrals.size()});
  prepare(pairs);
  const auto function = kernels().integrals[necks_.kinds > 0 ? 1 : 0];
  const auto kernel = [&](const detail::BornTask& task) { return function(task), 0.0; };
  run(pairs, constants(), kernel, {}, integrals);
}

detail::BornConstants BornSums::constants_of(const BornEnergy& energy) const {
  detail::BornConstants all = constants();
  all.over_solute = static_cast<float>(energy.over_solute);
  all.over_solvent = static_cast<float>(energy.over_solvent);
  all.kappa = static_cast<float>(energy.kappa);
  all.shift = static_cast<float>(energy.shift);
  const double without_salt = energy.constant * (energy.over_solute - energy.over_solvent);
  all.factor = static_cast<float>(energy.kappa > 0 ? energy.constant : without_salt);
  return all;
}

double BornSums::add_energies(const ClusterPairs& pairs, const BornEnergy& energy, Span<const double> charges,
                              Span<const double> born_radii, Span<Vec3> forces, Span<double> slopes,
                              bool wants_energy) {
  check(pairs, {charges.size(), born_radii.size(), forces.size(), slopes.size()});
  half_over_.resize(born_radii.size());
  for (std::size_t i = 0; i < half_over_.size(); ++i) half_over_[i] = 0.5 / born_radii[i];
  sort(pairs, charges, charge_slots_, 0);
  sort(pairs, born_radii, born_slots_, 1);
  sort(pairs, half_over_, half_slots_, 0.5f);
  const auto function = kernels().energies[wants_energy ? 1 : 0][energy.kappa > 0 ? 1 : 0];
  const auto kernel = [&](const detail::BornTask& task) {
    double found = 0;
    function(task, found);
    return found;
  };
  scalars_.assign(slopes.size(), 0);
  const double total = run(pairs, constants_of(energy), kernel, forces, scalars_);
  for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] -= scalars_[i] / born_radii[i];
  return total;
}

void BornSums::add_chain(const ClusterPairs& pairs, Span<const double> slopes, Span<Vec3> forces) {
  check(pairs, {slopes.size(), forces.size()});
  prepare(pairs);
  sort(pairs, slopes, slope_slots_, 0);
  const auto function = kernels().chain[necks_.kinds > 0 ? 1 : 0];
  const auto kernel = [&](const detail::BornTask& task) { return function(task), 0.0; };
  run(pairs, constants(), kernel, forces, {});
}

}  // namespace dch
