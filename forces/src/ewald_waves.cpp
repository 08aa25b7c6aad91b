// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/base/instruction_set.hpp>
#include <dch/forces/ewald_waves.hpp>

#include "base/aligned_vector.hpp"
#include "base/describe.hpp"
#include "simd/force_kernels.hpp"
#include "turns.hpp"

namespace dch {
namespace {

using detail::kWaveBlock;
using detail::kWaveLanes;
using WaveArray = detail::AlignedVector<double>;

constexpr int kMaxWaves = 1000;
// Charges whose sums are added up by themselves: so many blocks, on whichever thread.
constexpr std::size_t kBlocksOfPart = 8;
const double kTwoPi = 2 * std::acos(-1.0);

/// A block of charges, in the form that the kernels want.
struct WaveBlock {
  WaveArray cosine[3], sine[3], charge = WaveArray(kWaveBlock);
  void resize(const std::array<int, 3>& count) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (WaveArray* numbers : {&cosine[axis], &sine[axis]})
        numbers->resize(static_cast<std::size_t>(count[axis]) * kWaveBlock);
  }
  void set_phase(std::size_t axis, std::size_t k, double phase);
};

/// cos(n p) and sin(n p) from those of (n - 1) p.
void WaveBlock::set_phase(std::size_t axis, std::size_t k, double phase) {
  const double c = std::cos(phase), s = std::sin(phase);
  double *to_cosine = cosine[axis].data(), *to_sine = sine[axis].data();
  double now[2] = {1, 0};
  for (std::size_t at = k; at < cosine[axis].size(); at += kWaveBlock) {
    to_cosine[at] = now[0];
    to_sine[at] = now[1];
    const double next[2] = {now[0] * c - now[1] * s, now[1] * c + now[0] * s};
    now[0] = next[0];
    now[1] = next[1];
  }
}

}  // namespace

struct EwaldWaves::Impl {
  Impl(const std::array<int, 3>& numbers, double splitting_now, double constant_now)
      : count(numbers), splitting(splitting_now), constant(constant_now) {}

  std::array<int, 3> count;
  double splitting, constant;
  const detail::WaveKernels& kernels = detail::force_kernels(instruction_set()).waves;
  Executor* executor = nullptr;
  Vec3 lengths{};  ///< of the box
  WaveArray sums;  ///< eight for each wave
  WaveArray factors;
  struct Worker {
    WaveBlock block;
    WaveArray lanes;
  };
  std::vector<Worker> by_worker;
  Span<const Vec3> positions;
  Span<const double> charges;

  std::size_t waves() const { return sums.size() / 8; }
  std::size_t blocks() const { return (positions.size() + kWaveBlock - 1) / kWaveBlock; }
  double length(int axis) const { return axis == 0 ? lengths.x : axis == 1 ? lengths.y : lengths.z; }
  void prepare(const Box& box);
  detail::WaveTask take(std::size_t block, WaveBlock& to) const;
  void find_sums();
  double find_factors();
  double weight(const std::array<int, 3>& n) const;
  void hand_out(std::size_t block, WaveBlock& with, Span<Vec3> forces) const;
};

void EwaldWaves::Impl::prepare(const Box& box) {
  lengths = {box.vector(0).x, box.vector(1).y, box.vector(2).z};
  const auto octant = static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]) *
                      static_cast<std::size_t>(count[2]);
  sums.assign(8 * octant, 0);
  factors.resize(16 * octant);
  by_worker.resize(static_cast<std::size_t>(executor ? executor->threads() : 1));
  for (Worker& worker : by_worker) worker.block.resize(count);
}

detail::WaveTask EwaldWaves::Impl::take(std::size_t block, WaveBlock& to) const {
  for (std::size_t k = 0; k < kWaveBlock; ++k) {
    const std::size_t i = block * kWaveBlock + k;
    const bool exists = i < positions.size();
    const Vec3 at = exists ? positions[i] : Vec3{};
    to.charge[k] = exists ? charges[i] : 0;
    const double parts[3] = {at.x / lengths.x, at.y / lengths.y, at.z / lengths.z};
    for (std::size_t axis = 0; axis < 3; ++axis)
      to.set_phase(axis, k, kTwoPi * (parts[axis] - std::floor(parts[axis])));
  }
  detail::WaveTask task{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    task.count[axis] = static_cast<std::size_t>(count[axis]);
    task.cosine[axis] = to.cosine[axis].data();
    task.sine[axis] = to.sine[axis].data();
  }
  task.charge = to.charge.data();
  return task;
}

void EwaldWaves::Impl::find_sums() {
  const std::size_t parts = (blocks() + kBlocksOfPart - 1) / kBlocksOfPart;
  detail::Turns turns(static_cast<int>(parts));
  detail::run_parts(executor, static_cast<int>(by_worker.size()), [&](int worker) {
    Worker& own = by_worker[static_cast<std::size_t>(worker)];
    for (int part = turns.take(); part >= 0; part = turns.take()) {
      own.lanes.assign(sums.size() * kWaveLanes, 0);
      const auto first = static_cast<std::size_t>(part) * kBlocksOfPart;
      for (std::size_t b = first; b < std::min(first + kBlocksOfPart, blocks()); ++b)
        kernels.gather(take(b, own.block), own.lanes.data());
      turns.in_turn(part, [&] {
        for (std::size_t s = 0; s < sums.size(); ++s)
          for (std::size_t k = 0; k < kWaveLanes; ++k) sums[s] += own.lanes[s * kWaveLanes + k];
      });
    }
  });
}

/// Of the squares of the eight sums in the energy: all waves that differ from this one in signs.
double EwaldWaves::Impl::weight(const std::array<int, 3>& n) const {
  double k2 = 0, alike = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const int number = n[static_cast<std::size_t>(axis)];
    const double k = kTwoPi * number / length(axis);
    k2 += k * k;
    if (number > 0) alike *= 2;
  }
  if (k2 == 0) return 0;
  const double volume = lengths.x * lengths.y * lengths.z;
  return kTwoPi * constant / volume * alike * std::exp(-k2 / (4 * splitting * splitting)) / k2;
}

/// Of the slopes of the energy; returns the latter.
double EwaldWaves::Impl::find_factors() {
  double energy = 0;
  std::array<int, 3> n{};
  for (std::size_t w = 0; w < waves(); ++w) {
    const double of_square = weight(n), wave_z = kTwoPi * n[2] / lengths.z;
    for (std::size_t p = 0; p < 8; ++p) {
      const double sum = sums[8 * w + p], factor = 2 * of_square * sum;
      energy += of_square * sum * sum;
      factors[16 * w + p] = factor;
      factors[16 * w + 8 + p] = (p % 2 == 0 ? -1 : 1) * wave_z * factor;
    }
    for (std::size_t axis = 3; axis-- > 0;) {
      if (++n[axis] < count[axis]) break;
      n[axis] = 0;
    }
  }
  return energy;
}

void EwaldWaves::Impl::hand_out(std::size_t block, WaveBlock& with, Span<Vec3> forces) const {
  alignas(64) double slope[3][kWaveBlock] = {};
  const double wave_lengths[2] = {kTwoPi / lengths.x, kTwoPi / lengths.y};
  kernels.slopes(take(block, with), factors.data(), wave_lengths, slope);
  for (std::size_t k = 0, i = block * kWaveBlock; k < kWaveBlock && i < forces.size(); ++k, ++i)
    forces[i] = forces[i] - charges[i] * Vec3{slope[0][k], slope[1][k], slope[2][k]};
}

EwaldWaves::EwaldWaves(std::array<int, 3> count, double splitting, double constant) {
  for (const int along : count)
    if (along < 1 || along > kMaxWaves)
      throw InvalidParameter(std::to_string(along) + " wave numbers along an axis were asked for; 1 to " +
                             std::to_string(kMaxWaves) + " are to be had");
  if (!(std::isfinite(splitting) && splitting > 0))
    throw InvalidParameter("the splitting parameter of waves is " + detail::describe(splitting) +
                           "; it must be finite and positive");
  if (!(std::isfinite(constant) && constant >= 0))
    throw InvalidParameter("the constant of waves is " + detail::describe(constant) +
                           "; it must be finite and not negative");
  impl_ = std::make_unique<Impl>(count, splitting, constant);
}

EwaldWaves::~EwaldWaves() = default;
EwaldWaves::EwaldWaves(EwaldWaves&&) noexcept = default;
EwaldWaves& EwaldWaves::operator=(EwaldWaves&&) noexcept = default;

void EwaldWaves::set_executor(Executor* executor) { impl_->executor = executor; }

double EwaldWaves::add_forces(Span<const Vec3> positions, Span<const double> charges, const Box& box,
                              Span<Vec3> forces) {
  if (charges.size() != positions.size() || forces.size() != positions.size())
    throw InvalidParameter(std::to_string(charges.size()) + " charges and room for " +
                           std::to_string(forces.size()) + " forces given for " +
                           std::to_string(positions.size()) + " positions; give one each");
  if (box.kind() != Box::Kind::orthorhombic || !box.periodic(0) || !box.periodic(1) || !box.periodic(2))
    throw InvalidBox("a sum over waves was asked for in the box " + box.description() +
                     "; it has to be rectangular and periodic along all axes");
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (!std::isfinite(norm2(positions[i])))
      throw InvalidPosition("the position of charge " + std::to_string(i) + " is not finite");
  Impl& all = *impl_;
  all.positions = positions;
  all.charges = charges;
  all.prepare(box);
  all.find_sums();
  const double energy = all.find_factors();
  const auto workers = static_cast<int>(all.by_worker.size());
  detail::run_parts(all.executor, workers, [&](int worker) {
    for (std::size_t b = share_begin(all.blocks(), worker, workers);
         b < share_begin(all.blocks(), worker + 1, workers); ++b)
      all.hand_out(b, all.by_worker[static_cast<std::size_t>(worker)].block, forces);
  });
  return energy;
}

}  // namespace dch
