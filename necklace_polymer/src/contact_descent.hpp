// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <dch/necklace/contacts.hpp>

namespace dch::necklace::detail {

/// Whether the topological distances within one chain leave pairs of two of its ranges out; a comes before b.
class BondRule {
 public:
  BondRule(int skip, bool closed, std::int32_t beads) : skip_(skip), around_(closed ? beads : kNever) {}

  bool leaves_out(std::int32_t bonds) const { return bonds <= skip_ || around_ - bonds <= skip_; }
  /// All pairs of the ranges, as far as that is plain.
  bool leaves_out_all(const ChainTrees::Node& a, const ChainTrees::Node& b) const {
    const std::int32_t least = b.first - (a.first + a.count - 1), most = b.first + b.count - 1 - a.first;
    return most <= skip_ || around_ - least <= skip_;
  }
  bool leaves_out_some(const ChainTrees::Node& a, const ChainTrees::Node& b) const {
    const std::int32_t least = b.first - (a.first + a.count - 1), most = b.first + b.count - 1 - a.first;
    return least <= skip_ || around_ - most <= skip_;
  }

 private:
  // Larger than any skip plus number of bonds.
  static constexpr std::int64_t kNever = std::int64_t{1} << 40;
  std::int64_t skip_, around_;
};

/// Compares cages from given nodes down. The visitor is told of
///     separated(a, b)   two CagedBeads that are apart
///     contact(p, q)     places of two beads in contact
///     done()            asked in between: true ends the search
template <class Visitor>
class ContactDescent {
 public:
  ContactDescent(const CageHierarchy& hierarchy, const ContactQuery& query, Visitor& visitor)
      : hierarchy_(hierarchy),
        trees_(hierarchy.trees()),
        cages_(hierarchy.cages().data()),
        beads_(hierarchy.beads().data()),
        positions_(hierarchy.positions().data()),
        periodic_(hierarchy.box().any_periodic()),
        gap_(query.gap),
        skip_(query.skip_bonds),
        visitor_(visitor) {}

  const ContactStats& stats() const { return stats_; }

  /// All pairs of beads of one chain.
  void within(std::size_t chain) {
    const std::int32_t root = trees_.roots()[chain];
    const BondRule rule(skip_, hierarchy_.necklace().chains().closed(chain), trees_.node(root).count);
    std::vector<std::int32_t> selves{root};
    while (!selves.empty() && !visitor_.done()) {
      const std::int32_t k = selves.back();
      selves.pop_back();
      const ChainTrees::Node& node = trees_.node(k);
      if (node.is_leaf()) {
        beads_of_leaf(node, rule);
        continue;
      }
      descend(ChainTrees::left(k), node.right, &rule);
      selves.push_back(node.right);
      selves.push_back(ChainTrees::left(k));
    }
  }

  /// All pairs of a bead of one chain and a bead of another.
  void between(std::size_t chain, std::size_t other) {
    descend(trees_.roots()[chain], trees_.roots()[other], nullptr);
  }

 private:
  /// Two nodes, and the displacement of their images that may be in contact where there is only one.
  struct Pair {
    std::int32_t a, b;
    bool one_image;
    Vec3 shift;
  };

  void descend(std::int32_t first, std::int32_t second, const BondRule* rule) {
    stack_.push_back({first, second, !periodic_, {}});
    while (!stack_.empty()) {
      if (visitor_.done()) return stack_.clear();
      Pair pair = stack_.back();
      stack_.pop_back();
      const ChainTrees::Node &a = trees_.node(pair.a), &b = trees_.node(pair.b);
      if (rule != nullptr && rule->leaves_out_all(a, b)) continue;
      if (apart(pair)) {
        visitor_.separated(caged(a, pair.a), caged(b, pair.b));
      } else if (a.is_leaf() && b.is_leaf()) {
        beads_of_leaves(a, b, pair, rule);
      } else if (b.is_leaf() || (!a.is_leaf() && a.count >= b.count)) {
        stack_.push_back({a.right, pair.b, pair.one_image, pair.shift});
        stack_.push_back({ChainTrees::left(pair.a), pair.b, pair.one_image, pair.shift});
      } else {
        stack_.push_back({pair.a, b.right, pair.one_image, pair.shift});
        stack_.push_back({pair.a, ChainTrees::left(pair.b), pair.one_image, pair.shift});
      }
    }
  }

  CagedBeads caged(const ChainTrees::Node& node, std::int32_t k) const {
    return {node.first, node.count, cages_[k]};
  }
  CagedBeads caged(std::int32_t place) const { return {place, 1, beads_[place]}; }

  /// Whether two cages are farther apart than the gap. If two beads in them can be in contact in one image
  /// alone, because that takes less than half a period, notes which one; that holds for all nodes below.
  bool apart(Pair& pair) {
    ++stats_.cage_pairs;
    const Ball &a = cages_[pair.a], &b = cages_[pair.b];
    const double radii = a.radius + b.radius;
    const double reach = radii + gap_ + 1e-11 * radii + hierarchy_.rounding();
    if (reach < 0) return true;
    const Vec3 given = b.center - a.center;
    if (pair.one_image) return norm2(given + pair.shift) > reach * reach;
    const Vec3 nearest = hierarchy_.box().nearest_image(given);
    if (norm2(nearest) > reach * reach) return true;
    // Beads reach out from the centers of their cages by no more than the radii.
    if (reach < hierarchy_.box().max_cutoff()) {
      pair.one_image = true;
      pair.shift = nearest - given;
    }
    return false;
  }

  bool touch(std::int32_t p, std::int32_t q) const {
    const double reach = beads_[p].radius + beads_[q].radius + gap_;
    if (reach < 0) return false;
    const double distance2 = periodic_ ? hierarchy_.box().distance2(positions_[p], positions_[q])
                                       : norm2(positions_[q] - positions_[p]);
    return distance2 <= reach * reach;
  }

  void decide(std::int32_t p, std::int32_t q) {
    ++stats_.bead_pairs;
    if (touch(p, q)) {
      visitor_.contact(p, q);
    } else {
      visitor_.separated(caged(p), caged(q));
    }
  }

  void beads_of_leaf(const ChainTrees::Node& leaf, const BondRule& rule) {
    for (std::int32_t p = leaf.first; p < leaf.first + leaf.count; ++p) {
      for (std::int32_t q = p + 1; q < leaf.first + leaf.count; ++q) {
        if (!rule.leaves_out(q - p)) decide(p, q);
      }
    }
  }

  void beads_of_leaves(const ChainTrees::Node& a, const ChainTrees::Node& b, const Pair& pair,
                       const BondRule* rule) {
    const bool ask = rule != nullptr && rule->leaves_out_some(a, b);
    if (!ask && !Visitor::kWantsSeparated && pair.one_image) return near_beads(a, b, pair);
    for (std::int32_t p = a.first; p < a.first + a.count; ++p) {
      for (std::int32_t q = b.first; q < b.first + b.count; ++q) {
        if (!ask || !rule->leaves_out(q - p)) decide(p, q);
      }
    }
  }

  /// Contacts of two leaves, for a visitor that does not want to know of each pair: a bead that is apart from
  /// the other cage is apart from its beads, and of the others a loop without a branch notes which are near.
  void near_beads(const ChainTrees::Node& a, const ChainTrees::Node& b, const Pair& pair) {
    const Ball& cage = cages_[pair.b];
    const double slack = gap_ + hierarchy_.rounding();
    for (std::int32_t p = a.first; p < a.first + a.count; ++p) {
      const Vec3 at = beads_[p].center - pair.shift;
      const double reach = beads_[p].radius + slack;
      const double to_cage = reach + cage.radius + 1e-11 * (cage.radius + beads_[p].radius);
      if (to_cage < 0 || norm2(cage.center - at) > to_cage * to_cage) continue;
      std::uint64_t near = 0;  // leaves hold up to 64 beads
      for (std::int32_t k = 0; k < b.count; ++k) {
        const Ball& bead = beads_[b.first + k];
        const double sum = std::max(reach + bead.radius, 0.0);
        near |= std::uint64_t{norm2(bead.center - at) <= sum * sum} << k;
      }
      stats_.bead_pairs += b.count;
      for (std::int32_t q = b.first; near != 0; near >>= 1, ++q) {
        if ((near & 1) != 0 && touch(p, q)) visitor_.contact(p, q);
      }
    }
  }

  const CageHierarchy& hierarchy_;
  const ChainTrees& trees_;
  const Ball* cages_;
  const Ball* beads_;
  const Vec3* positions_;
  bool periodic_;
  double gap_;
  int skip_;
  Visitor& visitor_;
  std::vector<Pair> stack_;
  ContactStats stats_;
};

}  // namespace dch::necklace::detail
