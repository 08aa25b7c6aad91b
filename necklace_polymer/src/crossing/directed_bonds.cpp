// SPDX-License-Identifier: MIT
#include "crossing/directed_bonds.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string>

#include <dch/base/error.hpp>

namespace dch::necklace::detail {
namespace {

std::string name_of(IndexPair bond) {
  return "the bond of beads " + std::to_string(bond[0]) + " and " + std::to_string(bond[1]);
}

/// In the order of their smaller beads, and of the larger ones.
std::vector<IndexPair> sorted(std::vector<IndexPair> bonds) {
  for (IndexPair& bond : bonds) bond = {std::min(bond[0], bond[1]), std::max(bond[0], bond[1])};
  std::sort(bonds.begin(), bonds.end());
  return bonds;
}

void check(std::size_t particles, const std::vector<IndexPair>& sorted_bonds) {
  for (std::size_t k = 0; k < sorted_bonds.size(); ++k) {
    const IndexPair bond = sorted_bonds[k];
    if (bond[0] < 0 || static_cast<std::size_t>(bond[1]) >= particles) {
      throw InvalidParameter(name_of(bond) + " has a bead outside 0.." + std::to_string(particles) +
                             "; beads are indices of particles");
    }
    if (bond[0] == bond[1]) {
      throw InvalidParameter(name_of(bond) + " is of a bead with itself; leave it out");
    }
    if (k > 0 && sorted_bonds[k - 1] == bond) {
      throw InvalidParameter(name_of(bond) + " is given twice; give it once");
    }
  }
}

/// Parts of a graph whose beads are connected.
class Parts {
 public:
  explicit Parts(std::size_t particles) : parent_(particles) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::int32_t of(std::int32_t bead) {
    while (parent(bead) != bead) bead = parent(bead) = parent(parent(bead));
    return bead;
  }
  void join(IndexPair bond) { parent(of(bond[0])) = of(bond[1]); }

 private:
  std::int32_t& parent(std::int32_t bead) { return parent_[static_cast<std::size_t>(bead)]; }
  std::vector<std::int32_t> parent_;
};

}  // namespace

DirectedBonds directed_bonds(const Chains& chains) {
  DirectedBonds result{chains.bonds(), 0};
  result.on_chains = result.bonds.size();
  return result;
}

DirectedBonds directed_bonds(std::size_t particles, Span<const IndexPair> bonds) {
  const std::vector<IndexPair> all = sorted({bonds.begin(), bonds.end()});
  check(particles, all);
  std::vector<std::int32_t> degree(particles, 0);
  Parts parts(particles);
  for (const IndexPair bond : all) {
    ++degree[static_cast<std::size_t>(bond[0])];
    ++degree[static_cast<std::size_t>(bond[1])];
    parts.join(bond);
  }
  std::vector<bool> has_branch(particles, false);
  for (std::size_t k = 0; k < particles; ++k) {
    if (degree[k] > 2) has_branch[static_cast<std::size_t>(parts.of(static_cast<std::int32_t>(k)))] = true;
  }
  std::vector<IndexPair> of_chains, branched;
  for (const IndexPair bond : all)
    (has_branch[static_cast<std::size_t>(parts.of(bond[0]))] ? branched : of_chains).push_back(bond);
  DirectedBonds result = directed_bonds(Chains::from_bonds(particles, of_chains));
  result.bonds.insert(result.bonds.end(), branched.begin(), branched.end());
  return result;
}

std::vector<bool> new_bonds(const std::vector<IndexPair>& before, const std::vector<IndexPair>& now) {
  const std::vector<IndexPair> known = sorted(before);
  std::vector<bool> result(now.size());
  for (std::size_t k = 0; k < now.size(); ++k) {
    const IndexPair bond{std::min(now[k][0], now[k][1]), std::max(now[k][0], now[k][1])};
    result[k] = !std::binary_search(known.begin(), known.end(), bond);
  }
  return result;
}

}  // namespace dch::necklace::detail
