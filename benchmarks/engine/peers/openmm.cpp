// SPDX-License-Identifier: MIT
#include "cluster_pair_lists.hpp"
#include "openmm_lists.hpp"

int main(int argc, char** argv) {
  using namespace dch::bench;
  return run_beside(
      argc, argv, [](const Scene& scene) { return std::make_unique<OpenMmLists>(scene); },
      [](const Scene& scene) { return std::make_unique<ClusterPairLists>(scene); });
}
