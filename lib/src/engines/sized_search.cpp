// SPDX-License-Identifier: MIT
#include "engines/sized_search.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include <dch/base/error.hpp>

#include "base/key_table.hpp"
#include "base/seconds_since.hpp"
#include "geometry/metric.hpp"
#include "geometry/position_check.hpp"
#include "geometry/tolerance.hpp"
#include "lists/leaf_crescents.hpp"
#include "lists/list_check.hpp"
#include "lists/reach.hpp"

namespace dch::detail {
namespace {

using Clock = std::chrono::steady_clock;
/// A hierarchy serves lists whose radius is this share of its own or more.
constexpr double kMinShare = 0.8;

/// List radius of a class with itself or, if it has no pairs with itself, the largest with another one.
double own_reach(const SizeClasses& classes, std::size_t g) {
  double reach = classes.reach_of(g, g);
  for (std::size_t b = 0; b < classes.count && classes.reach_of(g, g) == 0; ++b)
    reach = std::max(reach, classes.reach_of(g, b));
  return reach;
}

/// Of a particle among those of its class, which are in order.
std::int32_t id_of(std::int32_t i, const std::vector<std::int32_t>& particle) {
  return static_cast<std::int32_t>(std::lower_bound(particle.begin(), particle.end(), i) - particle.begin());
}

}  // namespace

SizedSearch::SizedSearch(const StructureParams& params) : params_(params) {
  Hierarchy checked(params);  // throws for parameters out of range
}

void SizedSearch::clear() {
  for (const Group& group : groups_) retire(group);
  groups_.clear();
  sizes_.forget();
  positions_.clear();
  keys_.clear();
  stale_ = false;
}

/// Counts what the search of a group did, if it has one.
void SizedSearch::retire(const Group& group) {
  if (group.search) retired_ += group.search->stats();
}

void SizedSearch::update(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys) {
  const auto start = Clock::now();
  try {
    largest_reach_ = check_positions(positions, box);
    check_radius(params_.radius, box);
    if (!keys.empty()) key_table_.fill(positions.size(), keys);
    if (keys.empty() != keys_.empty() || (keys.empty() && positions.size() != positions_.size())) clear();
    positions_.assign(positions.begin(), positions.end());
    keys_.assign(keys.begin(), keys.end());
  } catch (...) {
    clear();
    throw;
  }
  box_ = box;
  stale_ = true;
  ++updates_;
  maintain_seconds_ += seconds_since(start);
}

void SizedSearch::lists(Span<const ListParams> requests, std::vector<NeighborList>& out) {
  out.resize(requests.size());
  std::vector<NeighborList*> each;
  each.reserve(out.size());
  for (NeighborList& list : out) each.push_back(&list);
  make_lists(requests, each);
}

void SizedSearch::make_lists(Span<const ListParams> requests, const std::vector<NeighborList*>& out) {
  if (requests.empty()) return;
  const auto start = Clock::now();
  host_error_ = 0;
  for (const ListParams& request : requests) host_error_ = std::max(host_error_, request.cutoff_error());
  classify(requests);
  make_or_empty(out, [&] {
    bring_up_to_date();
    maintain_seconds_ += seconds_since(start);
    const auto listing = Clock::now();
    const ListScene leaves = scene();
    list_finder_.find(
        {positions_, box_, leaves.error}, requests,
        [&](const auto& filters, const auto& lists) { leaf_rows_.find(leaves, filters, lists); }, out);
    list_seconds_ += seconds_since(listing);
  });
}

/// The hierarchies of all groups, which are up to date.
ListScene SizedSearch::scene() {
  double error = 0;
  sources_.clear();
  for (Group& group : groups_) {
    const Structure& hierarchy = group.search->hierarchy().view().structure();
    error = std::max(error, distance_error(hierarchy));
    group.source.structure = &hierarchy;
    group.source.ids = {group.particle, ids_version_};
    sources_.push_back(&group.source);
  }
  error += rounding_of_leaves(params_.radius) + host_error_;  // distances between classes too
  ListScene scene{box_, sources_, classes_.reach, error, params_.executor};
  for (double& reach : scene.reach) reach = (reach + error) * kInflate;
  return scene;
}

/// Checks the requests and sorts the particles into classes, unless sizes are what they were.
void SizedSearch::classify(Span<const ListParams> requests) {
  // One class where two images of a particle may tie at the cutoff, up to rounding.
  constexpr double kTie = 1e-6;
  const double farthest = box_.any_periodic() ? box_.max_cutoff() * (1 - kTie) -
                                                    4 * (WrapError(box_).bound(largest_reach_) + host_error_)
                                              : std::numeric_limits<double>::infinity();
  for (const ListParams& request : requests) check_list_params(request, positions_.size(), params_.radius);
  const bool are_known = classes_.of.size() == positions_.size() && sizes_.says_the_same(requests);
  if (!are_known) {
    largest_radius_ = 0;
    for (const ListParams& request : requests)
      largest_radius_ = std::max(largest_radius_, request.list_radius());
  }
  const bool can_be_told_apart = largest_radius_ < farthest;
  if (are_known && can_be_told_apart == told_apart_) return;
  sizes_.forget();
  classes_ = SizeClasses(requests, positions_.size(), can_be_told_apart);
  told_apart_ = can_be_told_apart;
  ++ids_version_;
  assign_particles();
  sizes_.keep(requests);  // last, when all goes by them
}

/// Each group gets the particles of its class, in their order.
void SizedSearch::assign_particles() {
  while (groups_.size() > classes_.count) {
    retire(groups_.back());
    groups_.pop_back();
  }
  groups_.resize(classes_.count);
  std::vector<std::vector<std::int32_t>> members(classes_.count);
  for (std::size_t i = 0; i < classes_.of.size(); ++i)
    members[classes_.of[i]].push_back(static_cast<std::int32_t>(i));
  for (std::size_t g = 0; g < classes_.count; ++g) {
    groups_[g].is_new |= groups_[g].particle != members[g];  // still, if its hierarchy never got them
    groups_[g].particle = std::move(members[g]);
  }
}

void SizedSearch::take_positions(Group& group) const {
  group.positions.resize(group.particle.size());
  group.keys.resize(keys_.empty() ? 0 : group.particle.size());
  for (std::size_t k = 0; k < group.particle.size(); ++k) group.positions[k] = positions_[group.particle[k]];
  for (std::size_t k = 0; k < group.keys.size(); ++k) group.keys[k] = keys_[group.particle[k]];
}

void SizedSearch::bring_up_to_date() {
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    Group& group = groups_[g];
    const double reach = own_reach(classes_, g);
    const double wanted = reach > 0
                              ? std::max(reach + host_error_, kMinListRadius)  // a larger one serves as well
                              : params_.radius;  // any will do where there are no pairs
    const double radius = group.search ? group.search->hierarchy().params().radius : 0;
    const bool fits = wanted <= radius && wanted >= kMinShare * radius;
    // It may have got no points yet, or lost them, in a list that was not finished.
    group.is_new |= group.search && group.search->hierarchy().size() != group.particle.size();
    if (!group.search || !fits || (group.is_new && keys_.empty())) {
      StructureParams own = params_;
      own.radius = wanted;
      own.collapse_singletons = false;  // they may have neighbors in other classes
      auto search = std::make_unique<DchSearch>(own);
      retire(group);
      group.search = std::move(search);
    } else if (!stale_ && !group.is_new) {
      continue;
    }
    take_positions(group);
    group.search->update(group.positions, box_, group.keys);
    group.is_new = false;
  }
  stale_ = false;
}

UnlistedPair SizedSearch::unlisted_pair(const UnlistedQuestion& question) {
  const bool is_up_to_date = !stale_ && classes_.of.size() == positions_.size() &&
                             std::all_of(groups_.begin(), groups_.end(),
                                         [](const Group& group) { return group.search && !group.is_new; });
  if (!UnlistedPairs::can_tell(question) || !is_up_to_date || question.positions.size() != positions_.size())
    return UnlistedPair::unknown;
  std::vector<const Structure*> structures;
  double error = rounding_of_leaves(params_.radius);
  for (Group& group : groups_) {
    structures.push_back(&group.search->hierarchy().view().structure());
    error = std::max(error, rounding_of_leaves(params_.radius) + distance_error(*structures.back()));
  }
  const UnlistedPairs pairs(question, positions_, box_, error);
  return with_metric(box_, [&](const auto& metric) {
    std::vector<LeafCrescents<std::decay_t<decltype(metric)>>> crescents;
    crescents.reserve(structures.size());
    for (const Structure* structure : structures) crescents.emplace_back(metric, *structure);
    return pairs.find([&](const Crescent& crescent) {
      const std::int32_t i = crescent.particle;
      const auto own = static_cast<std::size_t>(classes_.of[i]);
      for (std::size_t g = 0; g < groups_.size(); ++g) {
        const std::vector<std::int32_t>& particle = groups_[g].particle;
        if (particle.empty() || classes_.reach_of(own, g) == 0) continue;
        const std::int32_t leaf = g != own ? kNone : crescents[g].leaf_of(id_of(i, particle));
        if (crescents[g].any(crescent, leaf,
                             [&](std::int32_t id) { return pairs.contains(i, particle[id]); }))
          return true;
      }
      return false;
    });
  });
}

std::string SizedSearch::validate() {
  for (Group& group : groups_) {
    std::string fault = group.search ? group.search->validate() : std::string();
    if (!fault.empty()) return fault;
  }
  return {};
}

const SearchStats& SizedSearch::stats() const {
  stats_ = retired_;
  stats_.memory_bytes = positions_.capacity() * sizeof(Vec3) + keys_.capacity() * sizeof(std::uint64_t) +
                        classes_.of.capacity() * sizeof(std::int32_t) + sizes_.memory_bytes() +
                        leaf_rows_.memory_bytes() + list_finder_.memory_bytes();
  for (const Group& group : groups_) {
    if (!group.search) continue;
    const SearchStats& own = group.search->stats();
    stats_ += own;
    stats_.levels = std::max(stats_.levels, own.levels);
    stats_.memory_bytes +=
        own.memory_bytes + group.source.memory_bytes() + group.particle.capacity() * sizeof(std::int32_t) +
        group.positions.capacity() * sizeof(Vec3) + group.keys.capacity() * sizeof(std::uint64_t);
  }
  stats_.updates = updates_;
  stats_.maintain_seconds = maintain_seconds_;
  stats_.list_seconds = list_seconds_;
  return stats_;
}

}  // namespace dch::detail
