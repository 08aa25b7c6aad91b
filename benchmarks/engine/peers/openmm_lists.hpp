// SPDX-License-Identifier: MIT
#pragma once

#include <OpenMM.h>
#include <openmm/cpu/CpuNeighborList.h>
#include <openmm/internal/ThreadPool.h>
#include <set>
#include <vector>

#include "peer_lists.hpp"

namespace dch::bench {

/// OpenMM's CpuNeighborList on one thread: for each block of eight atoms, in an order of its own, the atoms
/// near any of them. It takes positions in float, wrapped into the box, as OpenMM's CPU platform hands them
/// over.
class OpenMmLists : public PeerLists {
 public:
  explicit OpenMmLists(const Scene& scene);

  std::string name() const override { return "OpenMM CpuNeighborList"; }
  void take(const Scene& scene) override;
  void make() override;
  PairSum pairs_within(const Scene& scene) const override;
  std::int64_t pairs_held() const override;

 private:
  static constexpr int kBlockSize = 8;
  template <class Visit>
  void for_pairs(const Visit& visit) const;

  int atoms_;
  float radius_;
  OpenMM::Vec3 box_[3];
  OpenMM::AlignedArray<float> positions_;
  std::vector<std::set<int>> exclusions_;
  OpenMM::CpuNeighborList list_{kBlockSize};
  OpenMM::ThreadPool threads_{1};
};

}  // namespace dch::bench
