// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <dch/necklace/contacts.hpp>

#include "contacts/contact_tasks.hpp"

namespace dch::necklace::detail {

/// Whether the topological distances within one chain leave pairs of two of its ranges out; a comes before b.
class BondRule {
 public:
  BondRule(int skip, bool closed, std::int32_t beads) : skip_(skip), around_(closed ? beads : kNever) {}

  bool leaves_out(std::int32_t bonds) const { return bonds <= skip_ || around_ - bonds <= skip_; }
  /// All pairs of the ranges, as far as that is plain.
  bool leaves_out_all(const ChainTrees::Node& a, const ChainTrees::Node& b) const {
    const std::int32_t min_bonds = b.first - (a.first + a.count - 1);
    const std::int32_t max_bonds = b.first + b.count - 1 - a.first;
    return max_bonds <= skip_ || around_ - min_bonds <= skip_;
  }
  bool leaves_out_some(const ChainTrees::Node& a, const ChainTrees::Node& b) const {
    const std::int32_t min_bonds = b.first - (a.first + a.count - 1);
    const std::int32_t max_bonds = b.first + b.count - 1 - a.first;
    return min_bonds <= skip_ || around_ - max_bonds <= skip_;
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

  void run(const ContactTask& task) { take_steps(task, std::numeric_limits<std::int64_t>::max()); }

  /// The first step of run(task); what that leaves to do is put behind `left`.
  void begin(const ContactTask& task, std::vector<ContactTask>& left) {
    take_steps(task, 1);
    left.insert(left.end(), stack_.begin(), stack_.end());
    stack_.clear();
  }

 private:
  BondRule rule_of(const ContactTask& task) const {
    if (task.chain < 0) return {skip_, false, 0};
    const auto chain = static_cast<std::size_t>(task.chain);
    return {skip_, hierarchy_.necklace().chains().closed(chain), trees_.node(trees_.roots()[chain]).count};
  }

  void take_steps(ContactTask task, std::int64_t max_steps) {
    const BondRule rule = rule_of(task);
    for (std::int64_t taken = 0; !visitor_.done(); ++taken) {
      if (taken == max_steps) return stack_.push_back(task);
      if (step(task, rule)) continue;
      if (stack_.empty()) return;
      task = stack_.back();
      stack_.pop_back();
    }
    stack_.clear();
  }

  /// False if nothing is left of the task. Else it has become one of its parts, and the others are on the
  /// stack. A call for each step would take a tenth of the time.
  [[gnu::always_inline]] bool step(ContactTask& task, const BondRule& rule) {
    const ChainTrees::Node &a = trees_.node(task.a), &b = trees_.node(task.b);
    if (task.a == task.b) return step_within(task, a, rule);
    if (task.chain >= 0 && rule.leaves_out_all(a, b)) return false;
    if (apart(task)) {
      visitor_.separated(caged(a, task.a), caged(b, task.b));
      return false;
    }
    if (a.is_leaf() && b.is_leaf()) {
      beads_of_leaves(a, b, task, rule);
      return false;
    }
    if (b.is_leaf() || (!a.is_leaf() && a.count >= b.count)) {
      stack_.push_back({a.right, task.b, task.chain, task.one_image, task.shift});
      task.a = ChainTrees::left(task.a);
    } else {
      stack_.push_back({task.a, b.right, task.chain, task.one_image, task.shift});
      task.b = ChainTrees::left(task.b);
    }
    return true;
  }

  bool step_within(ContactTask& task, const ChainTrees::Node& node, const BondRule& rule) {
    if (node.is_leaf()) {
      beads_of_leaf(node, rule);
      return false;
    }
    const std::int32_t left = ChainTrees::left(task.a);
    stack_.push_back({node.right, node.right, task.chain});
    stack_.push_back({left, node.right, task.chain, !periodic_});
    task.a = task.b = left;
    return true;
  }

  CagedBeads caged(const ChainTrees::Node& node, std::int32_t k) const {
    return {node.first, node.count, cages_[k]};
  }
  CagedBeads caged(std::int32_t place) const { return {place, 1, beads_[place]}; }

  /// Whether two cages are farther apart than the gap. If two beads in them can be in contact in one image
  /// alone, because that takes less than half a period, notes which one; that holds for all nodes below. Of
  /// their cages it does not, which may reach each other in another image: who wants to know of separated
  /// ones is told of those that are so in every image.
  bool apart(ContactTask& pair) {
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
    if (!Visitor::kWantsSeparated && reach < hierarchy_.box().max_cutoff()) {
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

  void beads_of_leaves(const ChainTrees::Node& a, const ChainTrees::Node& b, const ContactTask& pair,
                       const BondRule& rule) {
    const bool ask = pair.chain >= 0 && rule.leaves_out_some(a, b);
    if (!ask && !Visitor::kWantsSeparated && pair.one_image) return near_beads(a, b, pair);
    for (std::int32_t p = a.first; p < a.first + a.count; ++p) {
      for (std::int32_t q = b.first; q < b.first + b.count; ++q) {
        if (!ask || !rule.leaves_out(q - p)) decide(p, q);
      }
    }
  }

  /// Contacts of two leaves, for a visitor that does not want to know of each pair: a bead that is apart from
  /// the other cage is apart from its beads, and of the others a loop without a branch notes which are near.
  void near_beads(const ChainTrees::Node& a, const ChainTrees::Node& b, const ContactTask& pair) {
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
  std::vector<ContactTask> stack_;
  ContactStats stats_;
};

}  // namespace dch::necklace::detail
