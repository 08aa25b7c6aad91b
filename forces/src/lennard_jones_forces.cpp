// SPDX-License-Identifier: MIT
//
// LennardJones at work: its kernels over cluster pairs, on one thread or several, and over pairs one by one.
#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <string>
#include <type_traits>

#include <dch/base/error.hpp>
#include <dch/forces/lennard_jones.hpp>

#include "base/describe.hpp"
#include "simd/force_kernels.hpp"

namespace dch {
namespace {

template <class Real>
detail::LjCoefficients<Real> pointers_to(const std::array<std::vector<Real>, 7>& tables) {
  return {tables[0].data(), tables[1].data(), tables[2].data(), tables[3].data(),
          tables[4].data(), tables[5].data(), tables[6].data()};
}

template <class Real>
struct Kernels;

template <>
struct Kernels<double> {
  static const auto& functions(const detail::ForceKernels& kernels) { return kernels.full; }
  static const auto& at(const ClusterPairs& pairs) { return pairs.at; }
  static const auto& shift(const ClusterPairs& pairs) { return pairs.shift_vector; }
};

template <>
struct Kernels<float> {
  static const auto& functions(const detail::ForceKernels& kernels) { return kernels.mixed; }
  static const auto& at(const ClusterPairs& pairs) { return pairs.at_float; }
  static const auto& shift(const ClusterPairs& pairs) { return pairs.shift_vector_float; }
};

/// Clusters that worker `worker` of `workers` prepares.
ClusterPairs::Range share(std::int32_t clusters, int worker, int workers) {
  return {share_begin(clusters, worker, workers), share_begin(clusters, worker + 1, workers)};
}

template <class Real>
void add(const ClusterOfFour<Real>& force, ClusterOfFour<Real>& to) {
  for (int slot = 0; slot < ClusterPairs::kSlots; ++slot) {
    to.x[slot] += force.x[slot];
    to.y[slot] += force.y[slot];
    to.z[slot] += force.z[slot];
  }
}

/// Adds what a part has found for clusters of later parts to what earlier ones have.
template <class Real>
void add_for_later(Span<const ClusterPairs::Range> ranges, std::vector<ClusterOfFour<Real>>& found,
                   std::vector<ClusterOfFour<Real>>& later) {
  for (const ClusterPairs::Range& range : ranges) {
    for (auto c = static_cast<std::size_t>(range.first); c < static_cast<std::size_t>(range.last); ++c) {
      add(found[c], later[c]);
      found[c] = {};
    }
  }
}

/// Gives particles the forces on their clusters: what their part has found and what earlier ones have. A
/// particle stands in one slot at most.
template <class Real>
void hand_out(const ClusterPairs& pairs, ClusterPairs::Range own, std::vector<ClusterOfFour<Real>>& found,
              std::vector<ClusterOfFour<Real>>& earlier, Span<Vec3> forces) {
  for (auto c = static_cast<std::size_t>(own.first); c < static_cast<std::size_t>(own.last); ++c) {
    ClusterOfFour<Real> force = found[c];
    found[c] = {};
    if (pairs.is_named_before[static_cast<std::size_t>(pairs.origin_of[c])] != 0) {
      add(earlier[c], force);
      earlier[c] = {};
    }
    for (std::size_t slot = 0; slot < ClusterPairs::kSlots; ++slot) {
      const std::int32_t i = pairs.particle[c * ClusterPairs::kSlots + slot];
      if (i < 0) continue;
      Vec3& to = forces[static_cast<std::size_t>(i)];
      to = to + Vec3{double{force.x[slot]}, double{force.y[slot]}, double{force.z[slot]}};
    }
  }
}

/// Has workers take turns: each takes the next part when it has none, and does some of the work on it when
/// all parts before have had theirs done.
class Turns {
 public:
  explicit Turns(int parts) : parts_(parts) {}
  /// The next part, or -1 if all are taken.
  int take() {
    const std::lock_guard lock(mutex_);
    return taken_ < parts_ ? taken_++ : -1;
  }
  template <class Work>
  void in_turn(int part, const Work& work) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return done_ == part; });
    lock.unlock();
    work();
    lock.lock();
    ++done_;
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int parts_, taken_ = 0, done_ = 0;
};

void give(const detail::LjSums& found, LennardJonesSums& sums) {
  sums.energy += found.energy;
  sums.coulomb_energy += found.coulomb_energy;
  for (std::size_t k = 0; k < 6; ++k) sums.virial[k] += found.virial[k];
}

/// Numbers of particles, times a unit, by slot; 0 for padding.
template <class FourNumbers>
void sort_by_slot(const ClusterPairs& pairs, Span<const double> numbers, double unit,
                  ClusterPairs::Range clusters, std::vector<FourNumbers>& slots) {
  for (auto c = static_cast<std::size_t>(clusters.first); c < static_cast<std::size_t>(clusters.last); ++c) {
    for (std::size_t slot = 0; slot < ClusterPairs::kSlots; ++slot) {
      const std::int32_t i = pairs.particle[c * ClusterPairs::kSlots + slot];
      auto& number = slots[c].slot[slot];
      number = i < 0
                   ? 0
                   : static_cast<std::decay_t<decltype(number)>>(unit * numbers[static_cast<std::size_t>(i)]);
    }
  }
}

void run_parts(Executor* executor, int parts, const std::function<void(int)>& task) {
  if (parts == 1) {
    task(0);
  } else {
    executor->run(parts, task);
  }
}

}  // namespace

detail::ForceKind LennardJones::kind() const {
  using detail::ForceKind;
  const bool is_switched = switch_from_ >= 0;
  if (!has_charges_) return is_switched ? ForceKind::switched : ForceKind::lennard_jones;
  if (splitting_ > 0) return ForceKind::ewald;
  // Bare charges are those in a reaction field of strength 0.
  if (is_switched) return ForceKind::switched_reaction_field;
  return has_reaction_field_ || mixes_ ? ForceKind::reaction_field : ForceKind::plain;
}

detail::LjParameters LennardJones::parameters() const {
  using detail::LjParameters;
  if (mixes_) return LjParameters::by_particle;
  return types_ == 1 ? LjParameters::one_type : LjParameters::by_type;
}

template <class Real>
detail::LjConstants<Real> LennardJones::constants() const {
  const double width = largest_cutoff_ - switch_from_;
  return {static_cast<Real>(splitting_), static_cast<Real>(quadratic_), static_cast<Real>(offset_),
          static_cast<Real>(switch_from_), static_cast<Real>(switch_from_ >= 0 ? 1 / width : 0)};
}

template <class Real>
void LennardJones::run(const ClusterPairs& pairs, Span<const double> charges, const Tables<Real>& tables,
                       Scratch<Real>& scratch, Span<Vec3> forces, LennardJonesSums* sums) const {
  using Of = Kernels<Real>;
  const auto& functions = Of::functions(detail::force_kernels(instruction_set()));
  const auto function = functions.choose(kind(), parameters(), sums != nullptr);
  const auto parts = static_cast<int>(pairs.parts.size()) - 1;
  const int workers = executor_ ? std::min(executor_->threads(), parts) : 1;
  const auto clusters = static_cast<std::size_t>(pairs.clusters());
  scratch.force.resize(static_cast<std::size_t>(workers));
  scratch.lanes.resize(static_cast<std::size_t>(workers));
  scratch.earlier.resize(clusters);
  if (has_charges_) scratch.charge.resize(clusters);
  if (mixes_) scratch.half_sigma.resize(clusters), scratch.root_epsilon.resize(clusters);
  run_parts(executor_, workers, [&](int worker) {
    const ClusterPairs::Range own = share(pairs.clusters(), worker, workers);
    scratch.force[static_cast<std::size_t>(worker)].resize(clusters);
    if (functions.wants_lanes) scratch.lanes[static_cast<std::size_t>(worker)].resize(clusters);
    if (has_charges_) sort_by_slot(pairs, charges, charge_unit_, own, scratch.charge);
    if (mixes_) sort_by_slot(pairs, half_sigma_, 1, own, scratch.half_sigma);
    if (mixes_) sort_by_slot(pairs, root_epsilon_, 1, own, scratch.root_epsilon);
  });
  Turns turns(parts);
  run_parts(executor_, workers, [&](int worker) {
    auto& force = scratch.force[static_cast<std::size_t>(worker)];
    auto& lanes = scratch.lanes[static_cast<std::size_t>(worker)];
    for (int part = turns.take(); part >= 0; part = turns.take()) {
      const ClusterPairs::Part& own = pairs.parts[static_cast<std::size_t>(part)];
      const ClusterPairs::Part& next = pairs.parts[static_cast<std::size_t>(part) + 1];
      const std::size_t first_row = pairs.first_row(own), last_row = pairs.first_row(next);
      const Span<const ClusterPairs::Range> ranges{
          pairs.ranges.data() + own.first_range,
          static_cast<std::size_t>(next.first_range - own.first_range)};
      const detail::LjTask<Real> task{pairs.rows.data() + first_row,
                                      static_cast<std::int64_t>(last_row - first_row),
                                      pairs.entries.data(),
                                      Of::at(pairs).data(),
                                      Of::shift(pairs).data(),
                                      pairs.type.data(),
                                      types_,
                                      pointers_to(tables),
                                      mixes_ ? scratch.half_sigma.data()->slot : nullptr,
                                      mixes_ ? scratch.root_epsilon.data()->slot : nullptr,
                                      has_charges_ ? scratch.charge.data()->slot : nullptr,
                                      constants<Real>(),
                                      force.data(),
                                      functions.wants_lanes ? lanes.data()->numbers : nullptr,
                                      {own.first_cluster, next.first_cluster},
                                      ranges};
      detail::LjSums found;
      function(task, found);
      turns.in_turn(part, [&] {
        add_for_later(ranges, force, scratch.earlier);
        if (sums) give(found, *sums);
      });
      hand_out(pairs, {own.first_cluster, next.first_cluster}, force, scratch.earlier, forces);
    }
  });
}

template <class Pairs>
void LennardJones::check(const Pairs& pairs, std::size_t forces, std::size_t charges) const {
  if (forces != pairs.particles)
    throw InvalidParameter("room for " + std::to_string(forces) + " forces given for " +
                           std::to_string(pairs.particles) + " particles; give one each");
  if (charges != (has_charges_ ? pairs.particles : 0))
    throw InvalidParameter(
        std::to_string(charges) + " charges given for " + std::to_string(pairs.particles) +
        " particles; give " +
        (has_charges_ ? "one each" : "none, or say first with set_coulomb() how they act"));
  if (largest_cutoff_ > pairs.list_radius)
    throw InvalidParameter("the largest cutoff " + detail::describe(largest_cutoff_) +
                           " exceeds the radius " + detail::describe(pairs.list_radius) +
                           " of the pairs; make them with a larger one");
  if (types_ > 1 && pairs.types > types_)
    throw InvalidParameter("the pairs have " + std::to_string(pairs.types) +
                           " types, but Lennard-Jones pairs are given for " + std::to_string(types_) +
                           "; give one for each pair of types");
  if (mixes_ && half_sigma_.size() != pairs.particles)
    throw InvalidParameter("Lennard-Jones parameters of " + std::to_string(half_sigma_.size()) +
                           " particles given for pairs of " + std::to_string(pairs.particles) +
                           " particles; give one each");
}

void LennardJones::add(const ClusterPairs& pairs, ForcePrecision precision, Span<Vec3> forces,
                       Span<const double> charges, LennardJonesSums* sums) {
  check(pairs, forces.size(), charges.size());
  if (precision == ForcePrecision::mixed && !fits_single_)
    throw InvalidParameter(
        "a coefficient or squared cutoff is outside 1.2e-38..3.4e38, the range of single precision; use "
        "other "
        "units or ForcePrecision::full");
  if (pairs.parts.size() < 2) return;
  if (precision == ForcePrecision::mixed) {
    run(pairs, charges, mixed_, scratch_float_, forces, sums);
  } else {
    run(pairs, charges, full_, scratch_, forces, sums);
  }
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

void LennardJones::add(const PairList& pairs, Span<const Vec3> positions, const Box& now, Span<Vec3> forces,
                       Span<const double> charges, LennardJonesSums* sums) const {
  check(pairs, forces.size(), charges.size());
  if (positions.size() != pairs.particles)
    throw InvalidParameter(std::to_string(positions.size()) + " positions given for a pair list of " +
                           std::to_string(pairs.particles) +
                           " particles; make the list anew for another number");
  if (!same_periodicity(now, pairs.box))
    throw InvalidBox("a pair list made in the box " + pairs.box.description() + " was used in the box " +
                     now.description() + "; make it anew for another periodicity");
  const auto function =
      detail::force_kernels(instruction_set()).pairs.choose(kind(), parameters(), sums != nullptr);
  if (!function)
    throw InvalidParameter(
        "a pair list was given for a potential with a switch, a reaction field or parameters of particles; "
        "use cluster pairs");
  // Pairs without types are all of type 0, as in clusters.
  std::vector<std::int32_t> none;
  if (types_ > 1 && pairs.type.empty()) none.assign(pairs.particles, 0);
  detail::LjPairTask task{pairs.i.data(),
                          pairs.j.data(),
                          0,
                          0,
                          positions.data(),
                          {},
                          none.empty() ? pairs.type.data() : none.data(),
                          types_,
                          pointers_to(full_),
                          charges.data(),
                          charge_unit_,
                          constants<double>(),
                          forces.data()};
  detail::LjSums found;
  for (std::size_t g = 0; g + 1 < pairs.groups.size(); ++g) {
    task.first = pairs.groups[g].first;
    task.last = pairs.groups[g + 1].first;
    task.shift = pairs.shift(pairs.groups[g], now);
    if (task.first < task.last) function(task, found);
  }
  if (sums) give(found, *sums);
}

void LennardJones::add_forces(const PairList& pairs, Span<const Vec3> positions, const Box& now,
                              Span<Vec3> forces, Span<const double> charges) const {
  add(pairs, positions, now, forces, charges, nullptr);
}

LennardJonesSums LennardJones::add_forces_and_sum(const PairList& pairs, Span<const Vec3> positions,
                                                  const Box& now, Span<Vec3> forces,
                                                  Span<const double> charges) const {
  LennardJonesSums sums;
  add(pairs, positions, now, forces, charges, &sums);
  return sums;
}

}  // namespace dch
