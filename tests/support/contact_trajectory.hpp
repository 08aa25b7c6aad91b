// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/necklace/contacts.hpp>
#include <dch/necklace/wrapped_hierarchy.hpp>

#include "contact_oracle.hpp"
#include "random.hpp"

namespace dch::test {

/// Chains in a box, some of them rings, with solvent between, and the pairs in contact in each frame.
struct Trajectory {
  std::uint64_t seed;
  necklace::Necklace beads;
  necklace::ContactQuery query;
  std::vector<double> times;
  std::vector<std::vector<necklace::Contact>> found;  ///< by the wrapped hierarchy
  std::vector<std::vector<IndexPair>> oracle;         ///< by all pairs
};

inline necklace::Necklace random_necklace(scenes::Random& random, const std::vector<int>& lengths) {
  std::vector<std::int32_t> order;
  for (const int length : lengths) {
    for (int k = 0; k < length + 1; ++k) order.push_back(static_cast<std::int32_t>(order.size()));
  }
  random.shuffle(order);
  necklace::Chains chains(order.size());
  auto next = order.data();
  for (const int length : lengths) {
    chains.add({next, static_cast<std::size_t>(length)}, length >= 3 && random.below(2) == 0);
    next += length + 1;  // one particle is solvent
  }
  std::vector<double> radii;
  for (std::size_t k = 0; k < order.size(); ++k) radii.push_back(random.uniform(0.2, 0.5));
  return {chains, radii};
}

inline Trajectory random_trajectory(std::uint64_t seed, const std::vector<int>& lengths,
                                    const necklace::ContactQuery& query) {
  scenes::Random random(seed);
  Trajectory result{seed, random_necklace(random, lengths), query, {}, {}, {}};
  const Box box = Box::orthorhombic({10, 10, 10});
  std::vector<Vec3> positions(result.beads.particles());
  for (Vec3& p : positions) p = random.in_ball(2.2);  // bonds stay below half the box
  necklace::WrappedHierarchy hierarchy(result.beads);
  for (int frame = 0; frame < 12; ++frame) {
    result.times.push_back(frame == 0 ? 5 : result.times.back() + random.uniform(0, 2));
    hierarchy.update(positions, box);
    result.found.push_back(necklace::find_contacts(hierarchy, query));
    result.oracle.push_back(contact_oracle(result.beads, positions, box, query));
    for (Vec3& p : positions) p = 0.9 * (p + random.in_ball(0.2));
    if (frame == 5) {
      for (Vec3& p : positions) p = 1.5 * p;
    }
  }
  return result;
}

inline std::vector<Trajectory> random_trajectories() {
  std::vector<Trajectory> result;
  std::uint64_t seed = 1;
  for (const necklace::ContactQuery& query :
       {necklace::ContactQuery{0.1, 1, true, true}, necklace::ContactQuery{0.3, 3, true, false},
        necklace::ContactQuery{0, 0, false, true}, necklace::ContactQuery{0.2, 0, true, true}}) {
    for (const std::vector<int>& lengths :
         std::vector<std::vector<int>>{{40}, {1, 2, 3, 4, 17}, {12, 12, 12}, {6, 3, 9, 30}, {7}}) {
      result.push_back(random_trajectory(seed++, lengths, query));
    }
  }
  return result;
}

}  // namespace dch::test
