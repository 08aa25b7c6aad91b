// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include <dch/engines/pair_search.hpp>

#include "peer_lists.hpp"

namespace dch::bench {

/// What the OpenMM plugin keeps in place of a list: the cluster pairs of a hierarchy.
class ClusterPairLists : public PeerLists {
 public:
  explicit ClusterPairLists(const Scene& scene);

  std::string name() const override { return "dch, cluster pairs"; }
  void forget() override;
  void take(const Scene& scene) override { scene_ = &scene; }
  void make() override;
  PairSum pairs_within(const Scene& scene) const override;
  std::int64_t pairs_held() const override { return pairs_.slot_pairs(); }

 private:
  double radius_;
  ListParams request_;
  std::unique_ptr<PairSearch> search_;
  ClusterPairs pairs_;
  const Scene* scene_ = nullptr;
};

}  // namespace dch::bench
