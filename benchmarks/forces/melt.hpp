// SPDX-License-Identifier: MIT
//
// The Lennard-Jones melt: density 0.8442, cutoff 2.5, skin 0.3.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <dch/engines/pair_search.hpp>
#include <dch/forces/lennard_jones.hpp>

namespace melt {

inline constexpr double kDensity = 0.8442, kCutoff = 2.5, kSkin = 0.3, kTimeStep = 0.005;
inline constexpr int kStepsToMelt = 200, kStepsBetweenLists = 10;

inline dch::ListParams request() {
  dch::ListParams params;
  params.cutoffs = dch::TypeCutoffs(kCutoff);
  params.skin = kSkin;
  return params;
}

/// Face-centered cubic at first, with velocities of temperature 1.44; then whatever Newton's laws make of it.
class Melt {
 public:
  explicit Melt(int cells) : search_(dch::make_dch_search(hierarchy_params())), potential_({1, 1, kCutoff}) {
    const double spacing = std::cbrt(4 / kDensity), side = spacing * cells;
    box = dch::Box::orthorhombic({side, side, side});
    const dch::Vec3 basis[] = {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
    for (int x = 0; x < cells; ++x)
      for (int y = 0; y < cells; ++y)
        for (int z = 0; z < cells; ++z)
          for (const dch::Vec3 b : basis)
            positions.push_back(spacing * (dch::Vec3{double(x), double(y), double(z)} + b));
    std::mt19937_64 engine(1);
    const auto uniform = [&] { return 2 * static_cast<double>(engine() >> 11) * 0x1p-53 - 1; };
    const double largest = std::sqrt(3 * 1.44);
    for (std::size_t i = 0; i < positions.size(); ++i)
      velocity_.push_back(largest * dch::Vec3{uniform(), uniform(), uniform()});
    force_.resize(positions.size());
    search_->update(positions, box);
    search();
    for (int step = 0; step < kStepsToMelt; ++step) this->step();
  }

  void search() {
    search_->update(positions, box);
    search_->cluster_pairs(request(), pairs);
    useful = count_useful(), steps_since_search_ = 0;
  }
  /// Pairs in the order that forces are computed in, where lists live some steps.
  void search_for(dch::ForcePrecision precision) {
    const auto order = dch::LennardJones::wanted_order(precision);
    for (int step = 0; step < dch::ClusterPairs::steps_to_order(order); ++step) pairs.refresh(positions, box);
    search();
    pairs.order_entries(order);
    pairs.refresh(positions, box);
  }
  /// Leapfrog.
  void step() {
    if (steps_since_search_++ == kStepsBetweenLists) search();
    pairs.refresh(positions, box);
    std::fill(force_.begin(), force_.end(), dch::Vec3{});
    potential_.add_forces(pairs, dch::ForcePrecision::double_precision, force_);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      velocity_[i] = velocity_[i] + kTimeStep * force_[i];
      positions[i] = positions[i] + kTimeStep * velocity_[i];
    }
  }
  double atoms() const { return static_cast<double>(positions.size()); }

  std::vector<dch::Vec3> positions;
  dch::Box box;
  dch::ClusterPairs pairs;
  std::int64_t useful = 0;  ///< pairs within the cutoff

 private:
  static dch::HierarchyParams hierarchy_params() {
    dch::HierarchyParams params;
    params.radius = kCutoff + kSkin;
    return params;
  }
  std::int64_t count_useful() {
    dch::ListParams within = request();
    within.skin = 0;
    within.order = dch::RowOrder::unsorted;
    dch::NeighborList list;
    search_->list(within, list);
    return list.pairs();
  }

  std::unique_ptr<dch::PairSearch> search_;
  dch::LennardJones potential_;
  std::vector<dch::Vec3> velocity_, force_;
  int steps_since_search_ = 0;
};

}  // namespace melt
