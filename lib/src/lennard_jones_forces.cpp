// SPDX-License-Identifier: MIT
//
// LennardJones at work: its kernels over cluster pairs, on one thread or several, and over pairs one by one.
#include <algorithm>
#include <string>
#include <type_traits>

#include <dch/error.hpp>
#include <dch/lennard_jones.hpp>

#include "describe.hpp"
#include "simd/cluster_kernels.hpp"

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
  static const auto& functions(const detail::ClusterKernels& kernels) { return kernels.full; }
  static const auto& at(const ClusterPairs& pairs) { return pairs.at; }
  static const auto& shift(const ClusterPairs& pairs) { return pairs.shift_vector; }
};

template <>
struct Kernels<float> {
  static const auto& functions(const detail::ClusterKernels& kernels) { return kernels.mixed; }
  static const auto& at(const ClusterPairs& pairs) { return pairs.at_float; }
  static const auto& shift(const ClusterPairs& pairs) { return pairs.shift_vector_float; }
};

/// Part `part` of `parts` of 0 .. count.
struct Range {
  Range(std::size_t count, int part, int parts)
      : first(count * static_cast<std::size_t>(part) / static_cast<std::size_t>(parts)),
        last(count * static_cast<std::size_t>(part + 1) / static_cast<std::size_t>(parts)) {}
  std::size_t first, last;
};

/// Rows with about as many entries in each part.
Range rows_of_part(const ClusterPairs& pairs, int part, int parts) {
  const Range entries(pairs.entries.size(), part, parts);
  const auto row_at = [&](std::size_t entry) {
    const auto found =
        std::lower_bound(pairs.rows.begin(), pairs.rows.end() - 1, static_cast<std::int64_t>(entry),
                         [](const ClusterPairs::Row& row, std::int64_t e) { return row.first < e; });
    return static_cast<std::size_t>(found - pairs.rows.begin());
  };
  Range rows(0, 0, 1);
  rows.first = row_at(entries.first);
  rows.last = part + 1 == parts ? pairs.rows.size() - 1 : row_at(entries.last);
  return rows;
}

/// Sums up what the threads found for some clusters; a particle stands in one slot at most.
template <class Real>
void add_cluster_forces(const ClusterPairs& pairs, const std::vector<std::vector<ClusterOfFour<Real>>>& found,
                        Range clusters, Span<Vec3> forces) {
  for (std::size_t c = clusters.first; c < clusters.last; ++c) {
    for (std::size_t slot = 0; slot < ClusterPairs::kSlots; ++slot) {
      const std::int32_t i = pairs.particle[c * ClusterPairs::kSlots + slot];
      if (i < 0) continue;
      Vec3& to = forces[static_cast<std::size_t>(i)];
      for (const auto& of_thread : found) {
        const ClusterOfFour<Real>& force = of_thread[c];
        to = to + Vec3{double{force.x[slot]}, double{force.y[slot]}, double{force.z[slot]}};
      }
    }
  }
}

void give(const detail::LjSums& found, LennardJonesSums& sums) {
  sums.energy += found.energy;
  sums.coulomb_energy += found.coulomb_energy;
  for (std::size_t k = 0; k < 6; ++k) sums.virial[k] += found.virial[k];
}

/// Numbers of particles, times a unit, by slot; 0 for padding.
template <class FourNumbers>
void sort_by_slot(const ClusterPairs& pairs, Span<const double> numbers, double unit, Range clusters,
                  std::vector<FourNumbers>& slots) {
  for (std::size_t c = clusters.first; c < clusters.last; ++c) {
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
  const int parts = executor_ ? executor_->threads() : 1;
  const auto clusters = static_cast<std::size_t>(pairs.clusters());
  scratch.force.resize(static_cast<std::size_t>(parts));
  if (has_charges_) scratch.charge.resize(clusters);
  if (mixes_) scratch.half_sigma.resize(clusters), scratch.root_epsilon.resize(clusters);
  run_parts(executor_, parts, [&](int part) {
    const Range own(clusters, part, parts);
    scratch.force[static_cast<std::size_t>(part)].assign(clusters, ClusterOfFour<Real>());
    if (has_charges_) sort_by_slot(pairs, charges, charge_unit_, own, scratch.charge);
    if (mixes_) sort_by_slot(pairs, half_sigma_, 1, own, scratch.half_sigma);
    if (mixes_) sort_by_slot(pairs, root_epsilon_, 1, own, scratch.root_epsilon);
  });
  const auto function =
      Of::functions(detail::cluster_kernels(instruction_set())).choose(kind(), parameters(), sums != nullptr);
  std::vector<detail::LjSums> found(static_cast<std::size_t>(parts));
  run_parts(executor_, parts, [&](int part) {
    const Range rows = rows_of_part(pairs, part, parts);
    const detail::LjTask<Real> task{pairs.rows.data() + rows.first,
                                    static_cast<std::int64_t>(rows.last - rows.first),
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
                                    scratch.force[static_cast<std::size_t>(part)].data()};
    function(task, found[static_cast<std::size_t>(part)]);
  });
  run_parts(executor_, parts, [&](int part) {
    add_cluster_forces(pairs, scratch.force, Range(clusters, part, parts), forces);
  });
  if (!sums) return;
  for (const detail::LjSums& of_thread : found) give(of_thread, *sums);
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
  if (pairs.rows.empty()) return;
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
      detail::cluster_kernels(instruction_set()).pairs.choose(kind(), parameters(), sums != nullptr);
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
