// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdio>
#include <vector>

#include <dch/engines/pair_search.hpp>
#include <dch/forces/lennard_jones.hpp>

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
  const double expected = 24 * std::pow(1.5, -7) * (1 - 2 * std::pow(1.5, -6));  // towards each other
  std::printf("%.15g, expected %.15g\n", forces[0].x, expected);
  return std::abs(forces[0].x - expected) <= 1e-12 * expected ? 0 : 1;
}
