// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include <dch/necklace/wrapped_hierarchy.hpp>

#include "balls/ball_basis.hpp"
#include "balls/basis_batch.hpp"

namespace dch::necklace {

namespace {

/// An update looks at all beads of a cage that has no more than these: one loop over beads that stand side by
/// side in memory.
constexpr std::int32_t kMaxUnwatched = 32;

/// What rounding may take from the bound on where beads are that are not watched, relative to the cage.
constexpr double kWatchMargin = 1e-12;
/// Makes up for the rounding of a sum.
constexpr double kUpward = 1 + 2.3e-16;

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
    : CageHierarchy(std::move(necklace), params.leaf_beads), params_(params) {
  const auto radii = this->necklace().radii();
  for (const std::int32_t particle : this->necklace().particle()) {
    even_ = even_ && radii[static_cast<std::size_t>(particle)] == this->necklace().largest_radius();
  }
  if (params.verification != Verification::watched) return;
  for (const ChainTrees::Node& node : trees().nodes()) {
    const bool large = node.count > kMaxUnwatched;
    watch_of_.push_back(large ? static_cast<std::int32_t>(watches_.size()) : -1);
    if (large) watches_.emplace_back();
  }
}

void WrappedHierarchy::forget() {
  bases_.clear();
  CageHierarchy::forget();
}

void WrappedHierarchy::build(Span<const Vec3> positions, const Box& box) {
  try {
    find_bases(positions, box);
  } catch (...) {
    forget();
    throw;
  }
}

void WrappedHierarchy::find_bases(Span<const Vec3> positions, const Box& box) {
  bases_.clear();
  take(positions, box);
  bases_.resize(trees().nodes().size());
  const WrappedStats before = stats_;
  // Who never updates should not pay for watches: the first update looks.
  const bool watched = params_.verification == Verification::watched;
  const Verification verification = watched ? Verification::naive : params_.verification;
  for (auto k = static_cast<std::int32_t>(bases_.size()) - 1; k >= 0; --k) {
    const ChainTrees::Node& node = trees().node(k);
    repair(k, node.is_leaf() ? of_leaf(node) : of_children(k), verification);
  }
  stats_ = before;
  if (watched) std::fill(watches_.begin(), watches_.end(), Watch());
}

void WrappedHierarchy::update(Span<const Vec3> positions, const Box& box) {
  if (bases_.empty()) return build(positions, box);
  try {
    repair_bases(positions, box);
  } catch (...) {
    forget();
    throw;
  }
  ++stats_.updates;
}

void WrappedHierarchy::repair_bases(Span<const Vec3> positions, const Box& box) {
  const bool watched = params_.verification == Verification::watched;
  take(positions, box, watched ? &bead_moved2_ : nullptr);
  if (watched) note_motion();
  if (even_) detail::balls_of_bases(beads(), bases_, mutable_cages());
  for (auto k = static_cast<std::int32_t>(bases_.size()) - 1; k >= 0; --k) {
    const auto slot = static_cast<std::size_t>(k);
    const ChainTrees::Node& node = trees().node(k);
    if (node.count == 1) {
      mutable_cages()[slot] = beads()[static_cast<std::size_t>(node.first)];
    } else if (even_ && cages()[slot].radius != detail::kNotCentral) {
      repair(k, {cages()[slot], bases_[slot]}, params_.verification);
    } else {
      repair(k, detail::ball_of_basis(beads(), bases_[slot]), params_.verification);
    }
  }
}

/// Brings a cage from a ball of some of its beads to that of all.
void WrappedHierarchy::repair(std::int32_t k, EnclosingBall found, Verification verification) {
  const auto slot = static_cast<std::size_t>(k);
  if (trees().node(k).count > 1) {
    ++stats_.cages_checked;
    stats_.escapes += detail::pivot(beads(), found, [&](const EnclosingBall& now, double& reach) {
      return farthest(k, now, verification, reach);
    });
    if (found.basis != bases_[slot]) ++stats_.basis_changes;
  }
  mutable_cages()[slot] = found.ball;
  bases_[slot] = found.basis;
}

std::int32_t WrappedHierarchy::farthest(std::int32_t k, const EnclosingBall& found, Verification verification,
                                        double& reach) {
  const ChainTrees::Node& node = trees().node(k);
  if (verification == Verification::cascade) return farthest_by_cascade(k, found, reach);
  if (verification == Verification::watched && node.count > kMaxUnwatched) {
    const auto watch = static_cast<std::size_t>(watch_of_[static_cast<std::size_t>(k)]);
    return farthest_of_watched(node, watches_[watch], found, reach);
  }
  return farthest_of_range(node, found, reach);
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
  const Vec3 center = found.ball.center;
  const Ball* const balls = beads().data();
  reach = found.ball.radius * (1 + detail::kContainmentTolerance);
  std::int32_t farthest = -1;
  for (std::int32_t place = node.first; place < node.first + node.count; ++place) {
    if (detail::inside(balls[place], center, reach)) continue;
    farthest = place;
    reach = detail::far_side(center, balls[place]);
  }
  stats_.containment_tests += node.count;
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

std::int32_t WrappedHierarchy::farthest_of_watched(const ChainTrees::Node& node, Watch& watch,
                                                   const EnclosingBall& found, double& reach) {
  const Vec3 center = found.ball.center;
  const double since = watch.travelled + std::sqrt(norm2(center - watch.center));
  // Right after a look the farthest bead is among those watched, wherever it is.
  if (!(watch.rest + since <= found.ball.radius * (1 - kWatchMargin))) scan(node, center, watch);
  const Ball* const balls = beads().data();
  reach = found.ball.radius * (1 + detail::kContainmentTolerance);
  std::int32_t farthest = -1;
  for (const std::int32_t place : watch.places) {
    if (detail::inside(balls[place], center, reach)) continue;
    farthest = place;
    reach = detail::far_side(center, balls[place]);
  }
  stats_.containment_tests += static_cast<std::int64_t>(watch.places.size());
  return farthest;
}

/// Watches the beads of a node that reach farthest from a center.
void WrappedHierarchy::scan(const ChainTrees::Node& node, Vec3 center, Watch& watch) {
  std::array<double, std::tuple_size<decltype(Watch::places)>::value> far;
  far.fill(-1);
  for (std::int32_t place = node.first; place < node.first + node.count; ++place) {
    const Ball& bead = beads()[static_cast<std::size_t>(place)];
    if (detail::inside(bead, center, far.back())) continue;
    const double side = detail::far_side(center, bead);
    std::size_t slot = far.size() - 1;
    for (; slot > 0 && far[slot - 1] < side; --slot) {
      far[slot] = far[slot - 1];
      watch.places[slot] = watch.places[slot - 1];
    }
    far[slot] = side;
    watch.places[slot] = place;
  }
  watch.center = center;
  watch.rest = far.back();
  watch.travelled = 0;
  stats_.containment_tests += node.count;
  ++stats_.looks;
}

void WrappedHierarchy::note_motion() {
  moved2_.resize(trees().nodes().size());
  for (std::size_t k = moved2_.size(); k-- > 0;) {
    const ChainTrees::Node& node = trees().nodes()[k];
    if (node.is_leaf()) {
      const double* const first = bead_moved2_.data() + node.first;
      moved2_[k] = *std::max_element(first, first + node.count);
    } else {
      moved2_[k] = std::max(moved2_[k + 1], moved2_[static_cast<std::size_t>(node.right)]);
    }
    if (watch_of_[k] < 0) continue;
    double& travelled = watches_[static_cast<std::size_t>(watch_of_[k])].travelled;
    travelled = (travelled + std::sqrt(moved2_[k])) * kUpward;
  }
}

std::size_t WrappedHierarchy::memory_bytes() const {
  return CageHierarchy::memory_bytes() + bases_.capacity() * sizeof(Basis) +
         watch_of_.capacity() * sizeof(std::int32_t) + watches_.capacity() * sizeof(Watch) +
         (bead_moved2_.capacity() + moved2_.capacity()) * sizeof(double);
}

}  // namespace dch::necklace
