// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdlib>
#include <vector>

#include <dch/lists/all_pairs.hpp>
#include <dch/necklace/contacts.hpp>

namespace dch::test {

inline std::vector<IndexPair> pairs_of(const std::vector<necklace::Contact>& contacts) {
  std::vector<IndexPair> pairs;
  for (const necklace::Contact& contact : contacts) pairs.push_back({contact.i, contact.j});
  return pairs;
}

/// To the last bit.
inline bool same(const necklace::Contact& a, const necklace::Contact& b) {
  return a.i == b.i && a.j == b.j && a.gap == b.gap && a.on_i == b.on_i && a.on_j == b.on_j;
}

/// Where each particle stands: chain (-1: none) and number along it.
struct Standing {
  std::vector<int> chain, along;

  explicit Standing(const necklace::Chains& chains)
      : chain(chains.particles(), -1), along(chains.particles(), 0) {
    for (std::size_t c = 0; c < chains.size(); ++c) {
      int k = 0;
      for (const std::int32_t bead : chains.beads(c)) {
        chain[static_cast<std::size_t>(bead)] = static_cast<int>(c);
        along[static_cast<std::size_t>(bead)] = k++;
      }
    }
  }
};

/// All contacts by looking at all pairs of particles, in ascending order.
inline std::vector<IndexPair> contact_oracle(const necklace::Necklace& necklace,
                                             const std::vector<Vec3>& positions, const Box& box,
                                             const necklace::ContactQuery& query) {
  const Standing standing(necklace.chains());
  std::vector<IndexPair> pairs;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    for (std::size_t j = i + 1; j < positions.size(); ++j) {
      const int chain = standing.chain[i], other = standing.chain[j];
      if (chain < 0 || other < 0) continue;
      if (!(chain == other ? query.within_chains : query.between_chains)) continue;
      if (chain == other) {
        const auto which = static_cast<std::size_t>(chain);
        int bonds = std::abs(standing.along[i] - standing.along[j]);
        if (necklace.chains().closed(which)) {
          bonds = std::min(bonds, static_cast<int>(necklace.chains().beads(which).size()) - bonds);
        }
        if (bonds <= query.skip_bonds) continue;
      }
      const double reach = necklace.radii()[i] + necklace.radii()[j] + query.gap;
      if (reach < 0 || box.distance2(positions[i], positions[j]) > reach * reach) continue;
      pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
    }
  }
  return pairs;
}

/// The same from the library's oracle for lists, which looks at all images; for gaps >= 0 and radii not all
/// 0.
inline std::vector<IndexPair> listed_contacts(const necklace::Necklace& necklace,
                                              const std::vector<Vec3>& positions, const Box& box,
                                              const necklace::ContactQuery& query) {
  ListParams params;
  params.radii = necklace.radii();
  params.skin = query.gap;
  const NeighborList list = all_pairs(positions, box, params);
  std::vector<IndexPair> pairs;
  for (const IndexPair& pair :
       contact_oracle(necklace, positions, Box::none(),
                      {1e200, query.skip_bonds, query.within_chains, query.between_chains})) {
    const auto row = list.row(static_cast<std::size_t>(pair[0]));
    if (std::binary_search(row.begin(), row.end(), pair[1])) pairs.push_back(pair);
  }
  return pairs;
}

}  // namespace dch::test
