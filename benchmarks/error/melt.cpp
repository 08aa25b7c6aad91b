// SPDX-License-Identifier: MIT
#include "melt.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <dch/engines/pair_search.hpp>

#include "scene.hpp"

namespace dch::bench {
namespace {

constexpr double kStartTemperature = 1.44;

std::uint64_t key_of(std::int32_t i, std::int32_t j) {
  return static_cast<std::uint64_t>(std::min(i, j)) << 32 | static_cast<std::uint64_t>(std::max(i, j));
}

template <class F>
void for_each_pair(const NeighborList& list, const F& f) {
  for (std::size_t row = 0; row < list.size(); ++row) {
    const std::int32_t i = list.particle.empty() ? static_cast<std::int32_t>(row) : list.particle[row];
    for (const std::int32_t j : list.row(row)) f(i, j);
  }
}

}  // namespace

double Melt::kinetic_energy() const {
  double sum = 0;
  for (const Vec3 v : velocities) sum += norm2(v);
  return 0.5 * sum;
}

Melt make_crystal(int cells, std::uint64_t seed) {
  const double spacing = std::cbrt(4 / kMeltDensity), side = spacing * cells;
  Melt melt;
  melt.box = Box::orthorhombic({side, side, side});
  const Vec3 basis[] = {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
  for (int x = 0; x < cells; ++x)
    for (int y = 0; y < cells; ++y)
      for (int z = 0; z < cells; ++z)
        for (const Vec3 b : basis)
          melt.positions.push_back(spacing * (Vec3{double(x), double(y), double(z)} + b));
  std::mt19937_64 engine(seed);
  const double largest = std::sqrt(3 * kStartTemperature);
  Vec3 mean;
  for (std::size_t i = 0; i < melt.positions.size(); ++i) {
    Vec3 v;
    for (int axis = 0; axis < 3; ++axis) v[axis] = largest * (2 * uniform(engine) - 1);
    mean = mean + (1 / melt.atoms()) * v;
    melt.velocities.push_back(v);
  }
  for (Vec3& v : melt.velocities) v = v - mean;
  return melt;
}

Truth truth_of(const Melt& melt) {
  Truth truth;
  ListParams params;
  params.cutoffs = TypeCutoffs(kMeltCutoff);
  const auto search = make_cell_search(kMeltCutoff);
  search->update(melt.positions, melt.box);
  search->list(params, truth.pairs);
  truth.forces.resize(melt.positions.size());
  const double at_cutoff = std::pow(kMeltCutoff, -12) - std::pow(kMeltCutoff, -6);
  for_each_pair(truth.pairs, [&](std::int32_t i, std::int32_t j) {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    const Vec3 d = melt.box.nearest_image(melt.positions[b] - melt.positions[a]);
    const double s = 1 / norm2(d), s3 = s * s * s;
    truth.potential += 4 * (s3 * s3 - s3 - at_cutoff);
    const Vec3 force = (24 * s3 * s * (2 * s3 - 1)) * d;
    truth.forces[b] = truth.forces[b] + force;
    truth.forces[a] = truth.forces[a] - force;
  });
  return truth;
}

HeldPairs::HeldPairs(const NeighborList& list) {
  for_each_pair(list, [this](std::int32_t i, std::int32_t j) { add(i, j); });
  sort();
}

HeldPairs::HeldPairs(const ClusterPairs& pairs) {
  pairs.for_each([this](std::int32_t i, std::int32_t j, Vec3) { add(i, j); });
  sort();
}

void HeldPairs::add(std::int32_t i, std::int32_t j) { pairs_.push_back(key_of(i, j)); }
void HeldPairs::sort() { std::sort(pairs_.begin(), pairs_.end()); }

std::int64_t HeldPairs::missing_of(const NeighborList& list) const {
  std::int64_t missing = 0;
  for_each_pair(list, [&](std::int32_t i, std::int32_t j) {
    missing += !std::binary_search(pairs_.begin(), pairs_.end(), key_of(i, j));
  });
  return missing;
}

double relative_error(const std::vector<Vec3>& found, const std::vector<Vec3>& expected) {
  double error2 = 0, size2 = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    error2 += norm2(found[i] - expected[i]);
    size2 += norm2(expected[i]);
  }
  return std::sqrt(error2 / size2);
}

}  // namespace dch::bench
