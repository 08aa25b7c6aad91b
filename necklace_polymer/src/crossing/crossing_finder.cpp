// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <mutex>
#include <string>
#include <tuple>
#include <utility>

#include <dch/necklace/crossings.hpp>

#include "crossing/directed_bonds.hpp"
#include "crossing/near_midpoints.hpp"
#include "crossing/pair_tests.hpp"
#include "geometry/position_check.hpp"

namespace dch::necklace {

CrossingStats& CrossingStats::operator+=(const CrossingStats& other) {
  bonds += other.bonds;
  near_pairs += other.near_pairs;
  by_ball += other.by_ball;
  by_box += other.by_box;
  by_zonotope += other.by_zonotope;
  by_cubic += other.by_cubic;
  exact += other.exact;
  wide += other.wide;
  return *this;
}

class CrossingFinder::Impl {
 public:
  Impl(std::size_t particles, detail::DirectedBonds bonds, const CrossingFinderParams& params)
      : particles_(particles), params_(params), bonds_(std::move(bonds)), near_(params.executor) {
    if (!(params.thickness >= 0) || !std::isfinite(params.thickness)) {
      throw InvalidParameter("the thickness is " + std::to_string(params.thickness) +
                             "; it has to be finite and at least 0");
    }
  }

  std::size_t particles() const { return particles_; }
  Span<const IndexPair> bonds() const { return bonds_.bonds; }
  void set_bonds(detail::DirectedBonds bonds) {
    std::vector<IndexPair> known;  // those that are new before a step still are after another change
    for (std::size_t k = 0; k < bonds_.bonds.size(); ++k) {
      if (is_new_.empty() || !is_new_[k]) known.push_back(bonds_.bonds[k]);
    }
    std::vector<bool> is_new = detail::new_bonds(known, bonds.bonds);
    bonds_ = std::move(bonds);
    is_new_ = std::move(is_new);
  }

  void start(Span<const Vec3> positions, const Box& box) {
    is_ready_ = false;
    check(positions, box);
    before_.assign(positions.begin(), positions.end());
    box_ = box;
    is_new_.clear();
    is_ready_ = true;
  }

  const StepCrossings& step(Span<const Vec3> positions, const Box& box) {
    if (!is_ready_) throw InvalidParameter("there are no positions to step from; call start() first");
    is_ready_ = false;
    check(positions, box);
    if (box.any_periodic() != box_.any_periodic() || (box.any_periodic() && !same_periodicity(box, box_))) {
      throw InvalidParameter("the box was " + box_.description() + " and is " + box.description() +
                             " now; its periodic vectors have to stay, or call start() again");
    }
    result_ = StepCrossings();
    const detail::StepMotion motion(before_, box_, positions, box);
    measure(motion);
    near_.update(centers_, bounds_, motion.middle_box());
    search({motion, bonds_.bonds, centers_, bounds_, near_.largest(), bonds_.on_chains, params_.thickness});
    std::copy(positions.begin(), positions.end(), before_.begin());
    box_ = box;
    is_new_.clear();
    is_ready_ = true;
    return result_;
  }

  std::size_t memory_bytes() const {
    return (before_.capacity() + centers_.capacity()) * sizeof(Vec3) +
           bounds_.capacity() * sizeof(detail::SweepBounds) + bonds_.bonds.capacity() * sizeof(IndexPair) +
           is_new_.capacity() / 8 + near_.memory_bytes();
  }

 private:
  void check(Span<const Vec3> positions, const Box& box) const {
    if (positions.size() != particles_) {
      throw InvalidParameter("there are " + std::to_string(positions.size()) + " positions for " +
                             std::to_string(particles_) +
                             " particles; give one for each, or make a new finder");
    }
    dch::detail::check_positions(positions, box);
  }

  /// Centers and bounds of the sweeps, and which bonds are left out.
  void measure(const detail::StepMotion& motion) {
    const std::size_t count = bonds_.bonds.size();
    result_.stats.bonds = static_cast<std::int64_t>(count);
    centers_.resize(count);
    bounds_.resize(count);
    for_ranges(params_.executor, count, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) centers_[k] = measure(motion, k);
    });
    for (std::size_t k = 0; k < count; ++k) {
      if (!bounds_[k].is_left_out()) continue;
      if (!is_new_.empty() && is_new_[k]) {
        ++result_.started;
        continue;
      }
      const detail::BondStep step = motion.bond(bonds_.bonds[k]);
      result_.undetermined.push_back({static_cast<std::int32_t>(k),
                                      step.beads_determined ? UndeterminedBond::Reason::bond_too_long
                                                            : UndeterminedBond::Reason::bead_moved_too_far});
    }
  }

  Vec3 measure(const detail::StepMotion& motion, std::size_t k) {
    const detail::BondStep step = motion.bond(bonds_.bonds[k]);
    const detail::BondSweep sweep(step.ends);
    if (!step.beads_determined || !step.bond_determined || (!is_new_.empty() && is_new_[k])) {
      bounds_[k] = {};
      return sweep.center;
    }
    // Rounded up: to single precision, and by what the ends and an image of the center are off.
    const double radius = sweep.radius();
    const double more = 0.5 * params_.thickness + 64 * detail::kEndError * step.magnitude;
    const double rounding = 1e-6 * (radius + more);
    const auto up = [&](double size) { return static_cast<float>(size + more + rounding); };
    const Vec3 half = sweep.half_widths();
    bounds_[k] = {up(radius), {up(half.x), up(half.y), up(half.z)}};
    return sweep.center;
  }

  void search(const detail::StepScene& scene) {
    const std::vector<std::int32_t>& wide = near_.wide();
    result_.stats.wide = static_cast<std::int64_t>(wide.size());
    std::mutex mutex;
    const auto test = [&](const auto& take) {
      detail::PairTests tests(scene);
      take(tests);
      const std::lock_guard<std::mutex> lock(mutex);
      gather(tests.found);
    };
    near_.for_each_piece(
        [&](const NeighborList& piece) { test([&](detail::PairTests& tests) { tests.take_piece(piece); }); });
    for_ranges(params_.executor, wide.size(), [&](std::size_t first, std::size_t last) {
      test([&](detail::PairTests& tests) {
        for (std::size_t n = first; n < last; ++n) tests.take_wide(wide[n]);
      });
    });
    std::sort(result_.crossings.begin(), result_.crossings.end(), [](const auto& a, const auto& b) {
      return std::tuple(a.p, a.q, a.time) < std::tuple(b.p, b.q, b.time);
    });
    std::sort(result_.contacts.begin(), result_.contacts.end(), [](const auto& a, const auto& b) {
      return std::tuple(a.p, a.q, a.time) < std::tuple(b.p, b.q, b.time);
    });
  }

  void gather(const StepCrossings& found) {
    result_.crossings.insert(result_.crossings.end(), found.crossings.begin(), found.crossings.end());
    result_.contacts.insert(result_.contacts.end(), found.contacts.begin(), found.contacts.end());
    result_.stats += found.stats;
  }

  std::size_t particles_;
  CrossingFinderParams params_;
  detail::DirectedBonds bonds_;
  detail::NearMidpoints near_;
  bool is_ready_ = false;
  std::vector<Vec3> before_;
  Box box_;
  std::vector<bool> is_new_;   ///< by bond; empty if none is
  std::vector<Vec3> centers_;  ///< of the sweeps, by bond
  std::vector<detail::SweepBounds> bounds_;
  StepCrossings result_;
};

CrossingFinder::CrossingFinder(const Chains& chains, const CrossingFinderParams& params)
    : impl_(std::make_unique<Impl>(chains.particles(), detail::directed_bonds(chains), params)) {}
CrossingFinder::CrossingFinder(std::size_t particles, Span<const IndexPair> bonds,
                               const CrossingFinderParams& params)
    : impl_(std::make_unique<Impl>(particles, detail::directed_bonds(particles, bonds), params)) {}
CrossingFinder::~CrossingFinder() = default;
CrossingFinder::CrossingFinder(CrossingFinder&&) noexcept = default;
CrossingFinder& CrossingFinder::operator=(CrossingFinder&&) noexcept = default;

Span<const IndexPair> CrossingFinder::bonds() const { return impl_->bonds(); }
void CrossingFinder::set_bonds(Span<const IndexPair> bonds) {
  impl_->set_bonds(detail::directed_bonds(impl_->particles(), bonds));
}
void CrossingFinder::set_bonds(const Chains& chains) {
  if (chains.particles() != impl_->particles()) {
    throw InvalidParameter("the chains are over " + std::to_string(chains.particles()) +
                           " particles and the finder over " + std::to_string(impl_->particles()) +
                           "; make a new finder");
  }
  impl_->set_bonds(detail::directed_bonds(chains));
}
void CrossingFinder::start(Span<const Vec3> positions, const Box& box) { impl_->start(positions, box); }
const StepCrossings& CrossingFinder::step(Span<const Vec3> positions, const Box& box) {
  return impl_->step(positions, box);
}
std::size_t CrossingFinder::memory_bytes() const { return impl_->memory_bytes(); }

}  // namespace dch::necklace
