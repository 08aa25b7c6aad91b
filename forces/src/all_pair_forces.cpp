// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/forces/all_pair_forces.hpp>

#include "base/aligned_vector.hpp"
#include "base/describe.hpp"
#include "same_count.hpp"
#include "simd/force_kernels.hpp"
#include "turns.hpp"

namespace dch {
namespace {

constexpr auto kBlock = static_cast<std::size_t>(detail::kPairBlock);
using Numbers = detail::AlignedVector<float>;
using ThreeNumbers = std::array<Numbers, 3>;

void check_number(const char* what, std::size_t i, double value, bool may_be_negative) {
  if (std::isfinite(value) && (may_be_negative || value >= 0)) return;
  throw InvalidParameter(std::string(what) + " of particle " + std::to_string(i) + " is " +
                         detail::describe(value) + "; it must be finite" +
                         (may_be_negative ? "" : " and not negative"));
}

}  // namespace

struct AllPairForces::Impl {
  std::size_t count = 0, blocks = 0;
  const Exclusions* exclusions = nullptr;
  Executor* executor = nullptr;
  Numbers half_sigma, root_epsilon, charge;
  ThreeNumbers high, low;
  /// Of a thread: what the pairs of a block have found.
  struct Found {
    ThreeNumbers force;
    double own[kBlock][3];
    double energy;
  };
  std::vector<Found> by_worker;

  void place(Span<const Vec3> positions);
  void compute(std::size_t block, bool wants_energy, Found& found) const;
  void hand_out(std::size_t block, const Found& found, Span<Vec3> forces) const;
};

void AllPairForces::Impl::place(Span<const Vec3> positions) {
  for (std::size_t i = 0; i < count; ++i) {
    const double at[3] = {positions[i].x, positions[i].y, positions[i].z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      high[axis][i] = static_cast<float>(at[axis]);
      low[axis][i] = static_cast<float>(at[axis] - static_cast<double>(high[axis][i]));
    }
  }
}

void AllPairForces::Impl::compute(std::size_t block, bool wants_energy, Found& found) const {
  const std::size_t first = block * kBlock;
  const std::int32_t *next[kBlock], *end[kBlock];
  for (std::size_t k = 0; k < kBlock; ++k) {
    const auto i = static_cast<std::int32_t>(first + k);
    const Span<const std::int32_t> partners = exclusions->partners(i);
    next[k] = std::upper_bound(partners.begin(), partners.end(), i);
    end[k] = partners.end();
  }
  found.energy = 0;
  for (auto& own : found.own) own[0] = own[1] = own[2] = 0;
  const detail::AllPairsTask task{{high[0].data(), high[1].data(), high[2].data()},
                                  {low[0].data(), low[1].data(), low[2].data()},
                                  half_sigma.data(),
                                  root_epsilon.data(),
                                  charge.data(),
                                  static_cast<std::int32_t>(count),
                                  static_cast<std::int32_t>(first),
                                  next,
                                  end,
                                  {found.force[0].data(), found.force[1].data(), found.force[2].data()},
                                  found.own};
  detail::force_kernels(instruction_set()).all_pairs.add[wants_energy](task, found.energy);
}

void AllPairForces::Impl::hand_out(std::size_t block, const Found& found, Span<Vec3> forces) const {
  const std::size_t first = block * kBlock;
  for (std::size_t j = first; j < count; ++j) {
    Vec3 force{found.force[0][j], found.force[1][j], found.force[2][j]};
    if (j < first + kBlock) {
      const double* const own = found.own[j - first];
      force = force + Vec3{own[0], own[1], own[2]};
    }
    forces[j] = forces[j] + force;
  }
}

AllPairForces::AllPairForces(Span<const LennardJonesParticle> particles, Span<const double> charges,
                             double constant, const Exclusions& exclusions)
    : impl_(std::make_unique<Impl>()) {
  Impl& all = *impl_;
  all.count = particles.size();
  all.blocks = (all.count + kBlock - 1) / kBlock;
  all.exclusions = &exclusions;
  if (!charges.empty()) detail::require_same_count(all.count, "particles", charges.size(), "charges");
  if (!exclusions.empty())
    detail::require_same_count(all.count, "particles", exclusions.size(), "rows of exclusions");
  if (!(std::isfinite(constant) && constant >= 0))
    throw InvalidParameter("the constant of all pairs is " + detail::describe(constant) +
                           "; it must be finite and not negative");
  for (Numbers* numbers : {&all.half_sigma, &all.root_epsilon, &all.charge})
    numbers->resize(all.blocks * kBlock);
  for (ThreeNumbers* three : {&all.high, &all.low})
    for (Numbers& numbers : *three) numbers.resize(all.blocks * kBlock);
  for (std::size_t i = 0; i < all.count; ++i) {
    const auto [epsilon, sigma] = particles[i];
    check_number("epsilon", i, epsilon, false);
    check_number("sigma", i, sigma, false);
    // A sigma without an epsilon does not matter, and could be large.
    all.half_sigma[i] = static_cast<float>(epsilon > 0 ? 0.5 * sigma : 0);
    all.root_epsilon[i] = static_cast<float>(2 * std::sqrt(epsilon));
    if (charges.empty()) continue;
    check_number("the charge", i, charges[i], true);
    all.charge[i] = static_cast<float>(std::sqrt(constant) * charges[i]);
  }
}

AllPairForces::~AllPairForces() = default;
AllPairForces::AllPairForces(AllPairForces&&) noexcept = default;
AllPairForces& AllPairForces::operator=(AllPairForces&&) noexcept = default;

void AllPairForces::set_executor(Executor* executor) { impl_->executor = executor; }

double AllPairForces::add_forces(Span<const Vec3> positions, Span<Vec3> forces, bool wants_energy) const {
  Impl& all = *impl_;
  detail::require_same_count(all.count, "particles", positions.size(), "positions");
  detail::require_same_count(all.count, "particles", forces.size(), "forces");
  all.place(positions);
  const auto blocks = static_cast<int>(all.blocks);
  const int workers = std::max(all.executor ? std::min(all.executor->threads(), blocks) : 1, 1);
  all.by_worker.resize(static_cast<std::size_t>(workers));
  double energy = 0;
  detail::Turns turns(blocks);
  detail::run_parts(all.executor, workers, [&](int worker) {
    Impl::Found& found = all.by_worker[static_cast<std::size_t>(worker)];
    for (Numbers& numbers : found.force) numbers.resize(all.blocks * kBlock);
    for (int block = turns.take(); block >= 0; block = turns.take()) {
      all.compute(static_cast<std::size_t>(block), wants_energy, found);
      turns.in_turn(block, [&] {
        all.hand_out(static_cast<std::size_t>(block), found, forces);
        energy += found.energy;
      });
    }
  });
  return energy;
}

}  // namespace dch
