// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include <dch/base/index_count.hpp>
#include <dch/necklace/chains.hpp>

namespace dch::necklace {

namespace {

constexpr std::int32_t kNone = -1;

std::string bead_name(std::int32_t bead) { return "bead " + std::to_string(bead); }

std::string bond_name(std::int32_t a, std::int32_t b) {
  return "bond " + std::to_string(a) + "-" + std::to_string(b);
}

void check_index(std::int32_t bead, std::size_t particles) {
  if (bead < 0 || static_cast<std::size_t>(bead) >= particles) {
    throw InvalidParameter(bead_name(bead) +
                           " does not exist: indices run from 0 to the number of particles, " +
                           std::to_string(particles) + ", exclusive");
  }
}

/// The graph of the bonds: no bead has more than two partners.
class BondGraph {
 public:
  BondGraph(std::size_t particles, Span<const IndexPair> bonds) : partners_(particles, {kNone, kNone}) {
    for (const IndexPair& bond : bonds) {
      const auto [a, b] = bond;
      check_index(a, particles);
      check_index(b, particles);
      if (a == b) throw InvalidParameter(bond_name(a, b) + " joins a bead with itself");
      if (partners(a)[0] == b || partners(a)[1] == b) {
        throw InvalidParameter(bond_name(a, b) + " is given twice; give each bond once");
      }
      join(a, b);
      join(b, a);
    }
    for (auto& pair : partners_) {
      if (pair[1] != kNone && pair[1] < pair[0]) std::swap(pair[0], pair[1]);
    }
  }

  /// Partners of a bead in ascending order; kNone for one that is missing.
  const std::array<std::int32_t, 2>& partners(std::int32_t bead) const {
    return partners_[static_cast<std::size_t>(bead)];
  }
  bool is_end(std::int32_t bead) const { return partners(bead)[0] != kNone && partners(bead)[1] == kNone; }
  bool is_inner(std::int32_t bead) const { return partners(bead)[1] != kNone; }

  /// Beads met on the way from `start`, its smaller partner first, up to an end or back to the start.
  std::vector<std::int32_t> walk(std::int32_t start) const {
    std::vector<std::int32_t> chain{start};
    std::int32_t previous = start;
    std::int32_t bead = partners(start)[0];
    while (bead != kNone && bead != start) {
      chain.push_back(bead);
      const auto& next = partners(bead);
      const std::int32_t onward = next[0] == previous ? next[1] : next[0];
      previous = std::exchange(bead, onward);
    }
    return chain;
  }

 private:
  void join(std::int32_t bead, std::int32_t partner) {
    auto& slots = partners_[static_cast<std::size_t>(bead)];
    if (slots[1] != kNone) {
      throw InvalidParameter(bead_name(bead) + " has three or more bonds (to " + std::to_string(slots[0]) +
                             ", " + std::to_string(slots[1]) + " and " + std::to_string(partner) +
                             "); a chain has two at most, so leave side groups and cross-links out");
    }
    slots[slots[0] == kNone ? 0 : 1] = partner;
  }

  std::vector<std::array<std::int32_t, 2>> partners_;
};

/// Integer multiples of the cell vectors, along its periodic axes, nearest to the displacement d.
std::array<double, 3> lattice_steps(Vec3 d, const Box& box) {
  std::array<double, 3> steps{0, 0, 0};
  const Vec3 fraction = box.fractional(box.origin() + d);
  for (int axis = 0; axis < 3; ++axis) {
    if (box.periodic(axis)) steps[static_cast<std::size_t>(axis)] = std::round(fraction[axis]);
  }
  return steps;
}

Vec3 shifted(Vec3 p, const std::array<double, 3>& steps, const Box& box) {
  for (int axis = 0; axis < 3; ++axis) p = p + steps[static_cast<std::size_t>(axis)] * box.vector(axis);
  return p;
}

/// Follows one chain through the periodic images.
class Unwrapper {
 public:
  Unwrapper(Span<const Vec3> positions, const Box& box) : positions_(positions), box_(box) {}

  /// How many cell vectors further than `from`, whose image stands at `from_image`, the next bead is.
  std::array<double, 3> steps(std::int32_t from, Vec3 from_image, std::int32_t to) const {
    const Vec3 given = positions_[static_cast<std::size_t>(to)];
    const Vec3 bond = box_.nearest_image(given - positions_[static_cast<std::size_t>(from)]);
    const double length = std::sqrt(norm2(bond));
    // Written so that a NaN is refused too.
    if (!(length < box_.max_cutoff())) {
      throw Undetermined(bond_name(from, to) + " is " + std::to_string(length) +
                             " long, which is not below half the smallest box height, " +
                             std::to_string(box_.max_cutoff()) +
                             ": which image it leads to cannot be told; use a larger box or check the bonds",
                         {from, to});
    }
    return lattice_steps(from_image + bond - given, box_);
  }

  Vec3 image(std::int32_t bead, const std::array<double, 3>& steps) const {
    return shifted(positions_[static_cast<std::size_t>(bead)], steps, box_);
  }

 private:
  Span<const Vec3> positions_;
  const Box& box_;
};

}  // namespace

Chains::Chains(std::size_t particles) {
  index_count(static_cast<std::int64_t>(particles), "particles", "divide the system");
  chain_of_.assign(particles, kNone);
}

Chains Chains::from_bonds(std::size_t particles, Span<const IndexPair> bonds) {
  index_count(static_cast<std::int64_t>(particles), "particles", "divide the system");
  const BondGraph graph(particles, bonds);
  // Open chains are walked from their ends first, so an inner bead that no walk has met lies on a ring.
  std::vector<bool> met(particles, false);
  std::vector<std::pair<std::vector<std::int32_t>, bool>> found;
  for (const bool closed : {false, true}) {
    for (std::size_t k = 0; k < particles; ++k) {
      const auto bead = static_cast<std::int32_t>(k);
      if (met[k] || !(closed ? graph.is_inner(bead) : graph.is_end(bead))) continue;
      found.emplace_back(graph.walk(bead), closed);
      for (const std::int32_t member : found.back().first) met[static_cast<std::size_t>(member)] = true;
    }
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first[0] < b.first[0]; });

  Chains chains(particles);
  for (const auto& [beads, closed] : found) chains.add(beads, closed);
  return chains;
}

Chains Chains::from_molecules(Span<const std::int32_t> molecules) {
  std::vector<std::int32_t> order(molecules.size());
  std::iota(order.begin(), order.end(), 0);
  const auto molecule = [&](std::int32_t bead) { return molecules[static_cast<std::size_t>(bead)]; };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::int32_t a, std::int32_t b) { return molecule(a) < molecule(b); });

  Chains chains(molecules.size());
  for (auto begin = order.begin(); begin != order.end();) {
    const std::int32_t number = molecule(*begin);
    if (number < 0) {
      throw InvalidParameter(bead_name(*begin) + " has the molecule number " + std::to_string(number) +
                             "; they start from 1, and 0 means none");
    }
    const auto end =
        std::find_if(begin, order.end(), [&](std::int32_t bead) { return molecule(bead) != number; });
    if (number > 0) chains.add({&*begin, static_cast<std::size_t>(end - begin)});
    begin = end;
  }
  return chains;
}

void Chains::add(Span<const std::int32_t> beads, bool closed) {
  if (beads.empty()) throw InvalidParameter("a chain has no bead; it needs one at least");
  if (closed && beads.size() < 3) {
    throw InvalidParameter("the ring at bead " + std::to_string(beads[0]) + " has " +
                           std::to_string(beads.size()) + " beads; it needs three at least");
  }
  const auto chain = static_cast<std::int32_t>(size());
  const std::size_t beads_before = beads_.size();
  std::size_t entered = 0;
  try {
    for (; entered < beads.size(); ++entered) {
      const std::int32_t bead = beads[entered];
      check_index(bead, particles());
      std::int32_t& owner = chain_of_[static_cast<std::size_t>(bead)];
      if (owner == chain) throw InvalidParameter(bead_name(bead) + " stands in one chain twice");
      if (owner != kNone) {
        throw InvalidParameter(bead_name(bead) + " stands in two chains, " + std::to_string(owner) + " and " +
                               std::to_string(chain) + "; a bead belongs to one at most");
      }
      owner = chain;
    }
    beads_.insert(beads_.end(), beads.begin(), beads.end());
    first_.push_back(static_cast<std::int64_t>(beads_.size()));
    closed_.push_back(closed);
  } catch (...) {
    for (std::size_t k = 0; k < entered; ++k) chain_of_[static_cast<std::size_t>(beads[k])] = kNone;
    first_.resize(static_cast<std::size_t>(chain) + 1);
    beads_.resize(beads_before);
    throw;
  }
}

std::vector<IndexPair> Chains::bonds() const {
  std::vector<IndexPair> result;
  result.reserve(beads_.size());
  for (std::size_t chain = 0; chain < size(); ++chain) {
    const auto row = beads(chain);
    for (std::size_t k = 1; k < row.size(); ++k) result.push_back({row[k - 1], row[k]});
    if (closed(chain)) result.push_back({row[row.size() - 1], row[0]});
  }
  return result;
}

std::vector<Vec3> unwrap(const Chains& chains, Span<const Vec3> positions, const Box& box) {
  if (positions.size() != chains.particles()) {
    throw InvalidParameter("there are " + std::to_string(positions.size()) + " positions for chains over " +
                           std::to_string(chains.particles()) + " particles; give one for each");
  }
  std::vector<Vec3> result(positions.begin(), positions.end());
  const Unwrapper unwrapper(positions, box);
  for (std::size_t chain = 0; chain < chains.size(); ++chain) {
    const auto beads = chains.beads(chain);
    for (std::size_t k = 1; k < beads.size(); ++k) {
      const Vec3 previous = result[static_cast<std::size_t>(beads[k - 1])];
      const auto steps = unwrapper.steps(beads[k - 1], previous, beads[k]);
      result[static_cast<std::size_t>(beads[k])] = unwrapper.image(beads[k], steps);
    }
    if (!chains.closed(chain)) continue;
    const std::int32_t last = beads[beads.size() - 1];
    const auto steps = unwrapper.steps(last, result[static_cast<std::size_t>(last)], beads[0]);
    if (steps != std::array<double, 3>{0, 0, 0}) {
      throw Undetermined(
          "the ring at " + bead_name(beads[0]) + " winds around the periodic box, so it has no closed image",
          {last, beads[0]});
    }
  }
  return result;
}

}  // namespace dch::necklace
