// SPDX-License-Identifier: MIT
//
// Forces on cluster pairs by a kernel, on one thread or several.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

#include <dch/forces/cluster_scratch.hpp>

#include "cluster_tasks.hpp"
#include "lj_sums.hpp"
#include "simd/lj_task.hpp"
#include "turns.hpp"

namespace dch::detail {

template <class Real>
struct PlacesOf;

template <>
struct PlacesOf<double> {
  static const auto& at(const ClusterPairs& pairs) { return pairs.at; }
  static const auto& shift(const ClusterPairs& pairs) { return pairs.shift_vector; }
  static double unit(const ClusterPairs&) { return 1; }
};

template <>
struct PlacesOf<float> {
  static const auto& at(const ClusterPairs& pairs) { return pairs.at_in_units; }
  static const auto& shift(const ClusterPairs& pairs) { return pairs.shift_in_units; }
  static double unit(const ClusterPairs& pairs) { return pairs.unit; }
};

/// The particles whose forces are not finite, from any thread.
class Unresolved {
 public:
  /// @param particles  null if nobody asks
  explicit Unresolved(std::vector<std::int32_t>* particles) : particles_(particles) {}
  template <class Real>
  bool may_be_in(const ClusterOfFour<Real>& force) const {
    if (!particles_) return false;
    Real zero[ClusterPairs::kSlots];
    for (int slot = 0; slot < ClusterPairs::kSlots; ++slot)
      zero[slot] = 0 * (force.x[slot] + force.y[slot] + force.z[slot]);
    return (zero[0] + zero[1]) + (zero[2] + zero[3]) != 0;
  }
  /// Whether a particle is one of them.
  bool takes(std::int32_t particle, const Vec3& force) {
    if (std::isfinite(force.x) && std::isfinite(force.y) && std::isfinite(force.z)) return false;
    const std::lock_guard lock(mutex_);
    particles_->push_back(particle);
    return true;
  }
  void sort() {
    if (particles_) std::sort(particles_->begin(), particles_->end());
  }

 private:
  std::vector<std::int32_t>* particles_;
  std::mutex mutex_;
};

inline constexpr std::size_t kClustersAhead =
    8;  ///< so far ahead that memory has answered when forces are added

/// Asks for the forces of a cluster's particles, which stand anywhere.
inline void fetch(const ClusterPairs& pairs, std::size_t cluster, Span<Vec3> forces) {
  for (std::size_t slot = 0; slot < ClusterPairs::kSlots; ++slot) {
    const std::int32_t i = pairs.particle[cluster * ClusterPairs::kSlots + slot];
    if (i < 0) continue;
    const Vec3& force = forces[static_cast<std::size_t>(i)];
    __builtin_prefetch(&force.x, 1);
    __builtin_prefetch(&force.z, 1);
  }
}

/// Gives particles the forces on their clusters: what their task has found and what earlier ones have. A
/// particle stands in one slot at most.
template <class Real>
void hand_out(const ClusterPairs& pairs, ClusterPairs::Range own, std::vector<ClusterOfFour<Real>>& found,
              std::vector<ClusterOfFour<Real>>& earlier, Unresolved& unresolved, Span<Vec3> forces) {
  const double unit = PlacesOf<Real>::unit(pairs);
  const auto last = static_cast<std::size_t>(own.last);
  for (auto c = static_cast<std::size_t>(own.first); c < last; ++c) {
    if (c + kClustersAhead < last) fetch(pairs, c + kClustersAhead, forces);
    ClusterOfFour<Real> force = found[c];
    found[c] = {};
    if (pairs.has_earlier_contributions[static_cast<std::size_t>(pairs.origin_of[c])] != 0) {
      add(earlier[c], force);
      earlier[c] = {};
    }
    const bool looks = unresolved.may_be_in(force);
    for (std::size_t slot = 0; slot < ClusterPairs::kSlots; ++slot) {
      const std::int32_t i = pairs.particle[c * ClusterPairs::kSlots + slot];
      if (i < 0) continue;
      const Vec3 more = unit * Vec3{double{force.x[slot]}, double{force.y[slot]}, double{force.z[slot]}};
      if (looks && unresolved.takes(i, more)) continue;
      Vec3& to = forces[static_cast<std::size_t>(i)];
      to = to + more;
    }
  }
}

/// Gives particles half of what their clusters' slots have tallied, in the same way.
inline void hand_out(const ClusterPairs& pairs, ClusterPairs::Range own, double unit,
                     std::vector<ClusterTallies>& found, std::vector<ClusterTallies>& earlier,
                     Span<LennardJonesSums> halves) {
  for (auto c = static_cast<std::size_t>(own.first); c < static_cast<std::size_t>(own.last); ++c) {
    ClusterTallies sum = found[c];
    found[c] = {};
    if (pairs.has_earlier_contributions[static_cast<std::size_t>(pairs.origin_of[c])] != 0) {
      add(earlier[c], sum);
      earlier[c] = {};
    }
    for (std::size_t slot = 0; slot < ClusterPairs::kSlots; ++slot) {
      const std::int32_t i = pairs.particle[c * ClusterPairs::kSlots + slot];
      if (i < 0) continue;
      LennardJonesSums& to = halves[static_cast<std::size_t>(i)];
      to.energy += 0.5 * sum.number[0][slot];
      to.coulomb_energy += 0.5 * sum.number[kTallyOfCharges][slot];
      for (std::size_t k = 0; k < 6; ++k) to.virial[k] += 0.5 * unit * sum.number[kTallyOfVirial + k][slot];
    }
  }
}

/// Numbers of particles that a kernel wants by slot; none if there are none.
struct SlotNumbers {
  Span<const double> charges, dispersion, half_sigma, root_epsilon;
  Span<const double> half_sigma_of_type, root_epsilon_of_type;  ///< in the place of the latter two
  double charge_unit = 1, dispersion_unit = 1;                  ///< what they are multiplied by
};

/// A kernel, and what it wants to be told of all tasks: coefficients, types and constants.
template <class Real>
struct ClusterKernel {
  typename LjFunctions<LjTask<Real>>::Function function;
  bool wants_lanes;
  std::int32_t types;
  LjCoefficients<Real> coefficients;
  LjConstants<Real> constants;
};

/// Forces of a kernel on cluster pairs, on one thread or several.
template <class Real>
class ClusterRun {
 public:
  using Of = PlacesOf<Real>;
  ClusterRun(const ClusterPairs& pairs, const ClusterKernel<Real>& kernel, const SlotNumbers& numbers,
             Executor* executor, std::vector<std::int32_t>* unresolved, ClusterScratch<Real>& scratch)
      : pairs_(pairs),
        kernel_(kernel),
        numbers_(numbers),
        executor_(executor),
        tasks_(static_cast<int>(pairs.tasks.size()) - 1),
        workers_(executor ? std::min(executor->threads(), tasks_) : 1),
        unresolved_(unresolved),
        scratch_(scratch) {}

  /// Adds forces, and sums and tallies if there is room for them.
  void add(Span<Vec3> forces, LennardJonesSums* sums, Span<LennardJonesSums> halves = {}) {
    make_room(!halves.empty());
    run_parts(executor_, workers_, [&](int worker) { prepare(worker, !halves.empty()); });
    Turns turns(tasks_);
    run_parts(executor_, workers_, [&](int worker) {
      for (int task = turns.take(); task >= 0; task = turns.take())
        run(worker, task, turns, forces, sums, halves);
    });
    unresolved_.sort();
  }

 private:
  std::size_t clusters() const { return static_cast<std::size_t>(pairs_.clusters()); }

  /// But for what a worker makes room for itself.
  void make_room(bool tallies) {
    scratch_.force.resize(static_cast<std::size_t>(workers_));
    scratch_.lanes.resize(static_cast<std::size_t>(workers_));
    scratch_.earlier.resize(clusters());
    if (tallies) {
      scratch_.tallies.resize(static_cast<std::size_t>(workers_));
      scratch_.earlier_tallies.resize(clusters());
    }
    for (const auto& [numbers, slots] : by_slot())
      if (!numbers.empty()) slots->resize(clusters());
    for (const auto& [numbers, slots] : by_type())
      if (!numbers.empty()) slots->resize(clusters());
  }

  void prepare(int worker, bool tallies) {
    const ClusterPairs::Range own = share(pairs_.clusters(), worker, workers_);
    scratch_.force[static_cast<std::size_t>(worker)].resize(clusters());
    if (tallies) scratch_.tallies[static_cast<std::size_t>(worker)].resize(clusters());
    if (kernel_.wants_lanes) scratch_.lanes[static_cast<std::size_t>(worker)].resize(clusters());
    const double units[] = {numbers_.charge_unit, numbers_.dispersion_unit, 1, 1};
    const double* unit = units;
    for (const auto& [numbers, slots] : by_slot()) {
      if (!numbers.empty()) sort_by_slot(pairs_, numbers, *unit, own, *slots);
      ++unit;
    }
    for (const auto& [numbers, slots] : by_type())
      if (!numbers.empty()) sort_by_type(numbers, own, *slots);
  }

  void sort_by_type(Span<const double> numbers, ClusterPairs::Range clusters,
                    std::vector<FourNumbers<Real>>& slots) const {
    for (auto c = static_cast<std::size_t>(clusters.first); c < static_cast<std::size_t>(clusters.last); ++c)
      for (std::size_t k = 0; k < ClusterPairs::kSlots; ++k)
        slots[c].slot[k] =
            static_cast<Real>(numbers[static_cast<std::size_t>(pairs_.type[c * ClusterPairs::kSlots + k])]);
  }

  using Slots = std::vector<FourNumbers<Real>>;
  std::array<std::pair<Span<const double>, Slots*>, 4> by_slot() {
    return {{{numbers_.charges, &scratch_.charge},
             {numbers_.dispersion, &scratch_.dispersion},
             {numbers_.half_sigma, &scratch_.half_sigma},
             {numbers_.root_epsilon, &scratch_.root_epsilon}}};
  }

  std::array<std::pair<Span<const double>, Slots*>, 2> by_type() {
    return {{{numbers_.half_sigma_of_type, &scratch_.half_sigma},
             {numbers_.root_epsilon_of_type, &scratch_.root_epsilon}}};
  }

  static const Real* first_of(const Slots& slots) { return slots.empty() ? nullptr : slots.data()->slot; }

  void run(int worker, int task, Turns& turns, Span<Vec3> forces, LennardJonesSums* sums,
           Span<LennardJonesSums> halves) {
    auto* const tallies = halves.empty() ? nullptr : &scratch_.tallies[static_cast<std::size_t>(worker)];
    auto& force = scratch_.force[static_cast<std::size_t>(worker)];
    auto& lanes = scratch_.lanes[static_cast<std::size_t>(worker)];
    const ClusterPairs::Task& own = pairs_.tasks[static_cast<std::size_t>(task)];
    const ClusterPairs::Task& next = pairs_.tasks[static_cast<std::size_t>(task) + 1];
    const std::size_t first_row = pairs_.first_row(own), last_row = pairs_.first_row(next);
    const Span<const ClusterPairs::Range> ranges{
        pairs_.ranges.data() + own.first_range, static_cast<std::size_t>(next.first_range - own.first_range)};
    const LjTask<Real> kernel_task{pairs_.rows.data() + first_row,
                                   static_cast<std::int64_t>(last_row - first_row),
                                   pairs_.entries.data(),
                                   pairs_.entry_order,
                                   pairs_.parts.empty() ? nullptr : pairs_.parts.data() + first_row,
                                   Of::at(pairs_).data(),
                                   Of::shift(pairs_).data(),
                                   Of::unit(pairs_),
                                   pairs_.type.data(),
                                   kernel_.types,
                                   kernel_.coefficients,
                                   first_of(scratch_.half_sigma),
                                   first_of(scratch_.root_epsilon),
                                   first_of(scratch_.charge),
                                   first_of(scratch_.dispersion),
                                   kernel_.constants,
                                   force.data(),
                                   kernel_.wants_lanes ? lanes.data()->numbers : nullptr,
                                   {own.first_cluster, next.first_cluster},
                                   ranges,
                                   tallies ? tallies->data()->number[0] : nullptr};
    LjSums found;
    kernel_.function(kernel_task, found);
    turns.in_turn(task, [&] {
      add_for_later(ranges, force, scratch_.earlier);
      if (tallies) add_for_later(ranges, *tallies, scratch_.earlier_tallies);
      if (sums) give(found, *sums);
    });
    hand_out(pairs_, {own.first_cluster, next.first_cluster}, force, scratch_.earlier, unresolved_, forces);
    if (tallies)
      hand_out(pairs_, {own.first_cluster, next.first_cluster}, Of::unit(pairs_), *tallies,
               scratch_.earlier_tallies, halves);
  }

  const ClusterPairs& pairs_;
  const ClusterKernel<Real>& kernel_;
  const SlotNumbers& numbers_;
  Executor* executor_;
  int tasks_, workers_;
  Unresolved unresolved_;
  ClusterScratch<Real>& scratch_;
};

}  // namespace dch::detail
