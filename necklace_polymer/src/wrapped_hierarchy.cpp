// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <utility>

#include <dch/necklace/wrapped_hierarchy.hpp>

#include "ball_basis.hpp"

namespace dch::necklace {

namespace {

bool contains(const Basis& basis, std::int32_t place) {
  return std::find(basis.members.begin(), basis.members.end(), place) != basis.members.end();
}

/// How many members of a basis are beads of a node.
std::int32_t members_within(const Basis& basis, const ChainTrees::Node& node) {
  std::int32_t count = 0;
  for (const std::int32_t place : basis.members) {
    count += place >= node.first && place < node.first + node.count ? 1 : 0;
  }
  return count;
}

}  // namespace

WrappedHierarchy::WrappedHierarchy(Necklace necklace, const WrappedParams& params)
    : CageHierarchy(std::move(necklace), params.leaf_beads), params_(params) {}

void WrappedHierarchy::build(Span<const Vec3> positions, const Box& box) {
  bases_.clear();
  take(positions, box);
  bases_.resize(trees().nodes().size());
  const WrappedStats before = stats_;
  for (auto k = static_cast<std::int32_t>(bases_.size()) - 1; k >= 0; --k) {
    const ChainTrees::Node& node = trees().node(k);
    repair(k, node.is_leaf() ? of_leaf(node) : of_children(k));
  }
  stats_ = before;
}

void WrappedHierarchy::update(Span<const Vec3> positions, const Box& box) {
  if (bases_.empty()) return build(positions, box);
  try {
    take(positions, box);
  } catch (...) {
    bases_.clear();
    throw;
  }
  ++stats_.updates;
  for (auto k = static_cast<std::int32_t>(bases_.size()) - 1; k >= 0; --k) {
    repair(k, detail::ball_of_basis(beads(), bases_[static_cast<std::size_t>(k)]));
  }
}

/// Brings a cage from a ball of some of its beads to that of all.
void WrappedHierarchy::repair(std::int32_t k, EnclosingBall found) {
  const ChainTrees::Node& node = trees().node(k);
  const auto slot = static_cast<std::size_t>(k);
  if (node.count > 1) {
    ++stats_.cages_checked;
    stats_.escapes += detail::pivot(beads(), found, [&](const EnclosingBall& now, double& reach) {
      return params_.verification == Verification::naive ? farthest_of_range(node, now, reach)
                                                         : farthest_by_cascade(k, now, reach);
    });
    if (found.basis != bases_[slot]) ++stats_.basis_changes;
  }
  mutable_cages()[slot] = found.ball;
  bases_[slot] = found.basis;
}

EnclosingBall WrappedHierarchy::of_leaf(const ChainTrees::Node& node) const {
  const auto first = static_cast<std::size_t>(node.first);
  EnclosingBall found = enclosing_ball({beads().data() + first, static_cast<std::size_t>(node.count)});
  for (std::int32_t k = 0; k < found.basis.size; ++k) {
    found.basis.members[static_cast<std::size_t>(k)] += node.first;
  }
  return found;
}

/// The ball of the beads that the children's cages rest on: most often that of all beads.
EnclosingBall WrappedHierarchy::of_children(std::int32_t k) const {
  std::array<std::int32_t, 8> places{};
  std::array<Ball, 8> balls{};
  std::size_t size = 0;
  for (const std::int32_t child : {ChainTrees::left(k), trees().node(k).right}) {
    for (const std::int32_t place : bases_[static_cast<std::size_t>(child)].indices()) {
      places[size] = place;
      balls[size++] = beads()[static_cast<std::size_t>(place)];
    }
  }
  EnclosingBall found = enclosing_ball({balls.data(), size});
  for (std::int32_t member = 0; member < found.basis.size; ++member) {
    auto& index = found.basis.members[static_cast<std::size_t>(member)];
    index = places[static_cast<std::size_t>(index)];
  }
  return found;
}

std::int32_t WrappedHierarchy::farthest_of_range(const ChainTrees::Node& node, const EnclosingBall& found,
                                                 double& reach) {
  reach = found.ball.radius * (1 + detail::kContainmentTolerance);
  std::int32_t farthest = -1;
  for (std::int32_t place = node.first; place < node.first + node.count; ++place) {
    const Ball& bead = beads()[static_cast<std::size_t>(place)];
    ++stats_.containment_tests;
    if (detail::inside(bead, found.ball.center, reach)) continue;
    farthest = place;
    reach = detail::far_side(found.ball.center, bead);
  }
  return farthest;
}

/// What is left of the frontier stands on a stack. Once a bead has been found outside, cages count as inside
/// unless they reach farther out than that bead, so the farthest is found at no further cost. A node that
/// holds some of the basis, but not all, is not tested: its cage encloses a bead that touches the ball from
/// within, so it could only be inside by touching the ball there too.
std::int32_t WrappedHierarchy::farthest_by_cascade(std::int32_t k, const EnclosingBall& found,
                                                   double& reach) {
  const Vec3 center = found.ball.center;
  reach = found.ball.radius * (1 + detail::kContainmentTolerance);
  std::int32_t farthest = -1;
  const auto look_at_bead = [&](std::int32_t place) {
    if (contains(found.basis, place)) return;
    const Ball& bead = beads()[static_cast<std::size_t>(place)];
    ++stats_.containment_tests;
    if (detail::inside(bead, center, reach)) return;
    farthest = place;
    reach = detail::far_side(center, bead);
  };
  std::array<std::int32_t, 64> frontier{};
  std::size_t size = 0;
  frontier[size++] = k;
  while (size > 0) {
    const std::int32_t node_index = frontier[--size];
    const ChainTrees::Node& node = trees().node(node_index);
    const std::int32_t held = node_index == k ? -1 : members_within(found.basis, node);
    if (node.count > 1 && (held == 0 || held == found.basis.size)) {
      ++stats_.containment_tests;
      if (detail::inside(cages()[static_cast<std::size_t>(node_index)], center, reach)) continue;
    }
    if (node.is_leaf()) {
      for (std::int32_t place = node.first; place < node.first + node.count; ++place) look_at_bead(place);
    } else {
      frontier[size++] = ChainTrees::left(node_index);
      frontier[size++] = node.right;
    }
  }
  return farthest;
}

std::size_t WrappedHierarchy::memory_bytes() const {
  return CageHierarchy::memory_bytes() + bases_.capacity() * sizeof(Basis);
}

}  // namespace dch::necklace
