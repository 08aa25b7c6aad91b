// SPDX-License-Identifier: MIT
#include <cstdio>
#include <vector>

#include <dch/engines/pair_search.hpp>
#include <dch/forces/lennard_jones.hpp>
#include <dch/necklace/chains.hpp>

int main() {
  const std::vector<dch::Vec3> positions{{0, 0, 0}, {1.5, 0, 0}};
  const auto search = dch::make_dch_search(3);
  search->update(positions, dch::Box::none());
  dch::ListParams params;
  params.cutoffs = dch::TypeCutoffs(2.5);
  dch::ClusterPairs pairs;
  search->cluster_pairs(params, pairs);
  std::vector<dch::Vec3> forces(2);
  dch::LennardJones({1, 1, 2.5}).add_forces(pairs, dch::ForcePrecision::double_precision, forces);
  const dch::necklace::Chains chains;
  std::printf("%zu chains, force %g\n", chains.size(), forces[0].x);
  return search->list(params).pairs() == 1 && forces[0].x > 0 ? 0 : 1;
}
