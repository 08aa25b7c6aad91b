// SPDX-License-Identifier: MIT
//
// LennardJones over cluster pairs, on one thread or several.
#include <algorithm>
#include <cmath>
#include <mutex>
#include <string>

#include <dch/base/error.hpp>
#include <dch/forces/lennard_jones.hpp>

#include "cluster_tasks.hpp"
#include "lj_sums.hpp"
#include "simd/force_kernels.hpp"
#include "turns.hpp"

namespace dch {
namespace {

template <class Real>
struct Kernels;

template <>
struct Kernels<double> {
  static const auto& functions(const detail::ForceKernels& kernels) { return kernels.full; }
  static const auto& at(const ClusterPairs& pairs) { return pairs.at; }
  static const auto& shift(const ClusterPairs& pairs) { return pairs.shift_vector; }
  static double unit(const ClusterPairs&) { return 1; }
};

template <>
struct Kernels<float> {
  static const auto& functions(const detail::ForceKernels& kernels) { return kernels.mixed; }
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

constexpr std::size_t kClustersAhead = 8;  ///< so far ahead that memory has answered when forces are added

/// Asks for the forces of a cluster's particles, which stand anywhere.
void fetch(const ClusterPairs& pairs, std::size_t cluster, Span<Vec3> forces) {
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
  const double unit = Kernels<Real>::unit(pairs);
  const auto last = static_cast<std::size_t>(own.last);
  for (auto c = static_cast<std::size_t>(own.first); c < last; ++c) {
    if (c + kClustersAhead < last) fetch(pairs, c + kClustersAhead, forces);
    ClusterOfFour<Real> force = found[c];
    found[c] = {};
    if (pairs.has_earlier_contributions[static_cast<std::size_t>(pairs.origin_of[c])] != 0) {
      detail::add(earlier[c], force);
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

}  // namespace

/// But for what a worker makes room for itself.
template <class Real>
void LennardJones::make_room(std::size_t clusters, std::size_t workers, Scratch<Real>& scratch) const {
  scratch.force.resize(workers);
  scratch.lanes.resize(workers);
  scratch.earlier.resize(clusters);
  if (has_charges_) scratch.charge.resize(clusters);
  if (has_dispersion_) scratch.dispersion.resize(clusters);
  if (mixes_) scratch.half_sigma.resize(clusters), scratch.root_epsilon.resize(clusters);
}

template <class Real>
void LennardJones::run(const ClusterPairs& pairs, Span<const double> charges, const Tables<Real>& tables,
                       Scratch<Real>& scratch, Span<Vec3> forces, LennardJonesSums* sums) const {
  using Of = Kernels<Real>;
  const auto& functions = Of::functions(detail::force_kernels(instruction_set()));
  const auto function = functions.choose(kind(), parameters(), sums != nullptr);
  const auto tasks = static_cast<int>(pairs.tasks.size()) - 1;
  const int workers = executor_ ? std::min(executor_->threads(), tasks) : 1;
  const auto clusters = static_cast<std::size_t>(pairs.clusters());
  make_room(clusters, static_cast<std::size_t>(workers), scratch);
  detail::run_parts(executor_, workers, [&](int worker) {
    const ClusterPairs::Range own = detail::share(pairs.clusters(), worker, workers);
    scratch.force[static_cast<std::size_t>(worker)].resize(clusters);
    if (functions.wants_lanes) scratch.lanes[static_cast<std::size_t>(worker)].resize(clusters);
    if (has_charges_) detail::sort_by_slot(pairs, charges, charge_unit_, own, scratch.charge);
    if (has_dispersion_) detail::sort_by_slot(pairs, dispersion_, dispersion_unit_, own, scratch.dispersion);
    if (mixes_) detail::sort_by_slot(pairs, half_sigma_, 1, own, scratch.half_sigma);
    if (mixes_) detail::sort_by_slot(pairs, root_epsilon_, 1, own, scratch.root_epsilon);
  });
  detail::Turns turns(tasks);
  Unresolved unresolved(unresolved_);
  detail::run_parts(executor_, workers, [&](int worker) {
    auto& force = scratch.force[static_cast<std::size_t>(worker)];
    auto& lanes = scratch.lanes[static_cast<std::size_t>(worker)];
    for (int task = turns.take(); task >= 0; task = turns.take()) {
      const ClusterPairs::Task& own = pairs.tasks[static_cast<std::size_t>(task)];
      const ClusterPairs::Task& next = pairs.tasks[static_cast<std::size_t>(task) + 1];
      const std::size_t first_row = pairs.first_row(own), last_row = pairs.first_row(next);
      const Span<const ClusterPairs::Range> ranges{
          pairs.ranges.data() + own.first_range,
          static_cast<std::size_t>(next.first_range - own.first_range)};
      const detail::LjTask<Real> kernel_task{pairs.rows.data() + first_row,
                                             static_cast<std::int64_t>(last_row - first_row),
                                             pairs.entries.data(),
                                             pairs.entry_order,
                                             pairs.parts.empty() ? nullptr : pairs.parts.data() + first_row,
                                             Of::at(pairs).data(),
                                             Of::shift(pairs).data(),
                                             Of::unit(pairs),
                                             pairs.type.data(),
                                             types_,
                                             detail::pointers_to(tables),
                                             mixes_ ? scratch.half_sigma.data()->slot : nullptr,
                                             mixes_ ? scratch.root_epsilon.data()->slot : nullptr,
                                             has_charges_ ? scratch.charge.data()->slot : nullptr,
                                             has_dispersion_ ? scratch.dispersion.data()->slot : nullptr,
                                             constants<Real>(),
                                             force.data(),
                                             functions.wants_lanes ? lanes.data()->numbers : nullptr,
                                             {own.first_cluster, next.first_cluster},
                                             ranges};
      detail::LjSums found;
      function(kernel_task, found);
      turns.in_turn(task, [&] {
        detail::add_for_later(ranges, force, scratch.earlier);
        if (sums) detail::give(found, *sums);
      });
      hand_out(pairs, {own.first_cluster, next.first_cluster}, force, scratch.earlier, unresolved, forces);
    }
  });
  unresolved.sort();
}

void LennardJones::add(const ClusterPairs& pairs, ForcePrecision precision, Span<Vec3> forces,
                       Span<const double> charges, LennardJonesSums* sums) {
  check(pairs, forces.size(), charges.size());
  if (precision == ForcePrecision::mixed && !fits_single_)
    throw InvalidParameter(
        "a series has a splitting times cutoff of 3.6 or more, or a coefficient or squared cutoff is "
        "outside 1.2e-38..3.4e38, the range of single precision; use other units or "
        "ForcePrecision::double_precision");
  if (unresolved_) unresolved_->clear();
  if (pairs.tasks.size() < 2) return;
  if (precision == ForcePrecision::mixed) {
    run(pairs, charges, mixed_, scratch_float_, forces, sums);
  } else {
    run(pairs, charges, full_, scratch_, forces, sums);
  }
}

ClusterPairs::EntryOrder LennardJones::wanted_order(ForcePrecision precision) {
  using Order = ClusterPairs::EntryOrder;
  const detail::ForceKernels& kernels = detail::force_kernels(instruction_set());
  const auto of = [](const auto& functions) {
    if (functions.wants_lanes) return Order::joined;
    return functions.leaves_out_halves ? Order::by_halves : Order::as_found;
  };
  return precision == ForcePrecision::mixed ? of(kernels.mixed) : of(kernels.full);
}

void LennardJones::add_forces(const ClusterPairs& pairs, ForcePrecision precision, Span<Vec3> forces,
                              Span<const double> charges) {
  add(pairs, precision, forces, charges, nullptr);
}

LennardJonesSums LennardJones::add_forces_and_sum(const ClusterPairs& pairs, ForcePrecision precision,
                                                  Span<Vec3> forces, Span<const double> charges) {
  LennardJonesSums sums;
  add(pairs, precision, forces, charges, &sums);
  return sums;
}

}  // namespace dch
