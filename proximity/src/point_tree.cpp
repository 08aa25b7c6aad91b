// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

#include <dch/base/index_count.hpp>
#include <dch/proximity/point_tree.hpp>

#include "changed_ids.hpp"
#include "geometry/position_check.hpp"
#include "nested_nets.hpp"
#include "tree_changes.hpp"
#include "upper_nodes.hpp"

namespace dch {
namespace {

/// A tree is built anew if more than this share of its points needs another place, which takes as long.
constexpr std::size_t kShareOfBuild = 12;
/// And after balls of so many times as many points as it has were measured because of motion: this has taken
/// as long too, and points are no longer below the nearest site.
constexpr std::int64_t kWearOfBuild = 24;
/// All balls are looked at if more than this share of the points moves, not those above each of them.
constexpr std::size_t kShareOfMotion = 32;

}  // namespace

PointTree::PointTree(const HierarchyView& view)
    : box_(view.box()),
      rounding_(detail::WrapError(view.box()).bound(view.structure().largest_reach)),
      base_radius_(view.structure().base_radius),
      node_of_(view.capacity(), -1),
      positions_(view.structure().raw) {
  index_count(static_cast<std::int64_t>(view.size()), "points in a tree", "take fewer points",
              kMaxIndexCount / 2);
  detail::NewTree tree = std::move(detail::UpperNodes(view.structure()).tree);
  detail::NestedNets(box_, base_radius_, positions_, tree).complete();
  nodes_ = std::move(tree.nodes);
  nets_ = std::move(tree.nets);
  alive_ = static_cast<std::int32_t>(nodes_.size());
  for (std::int32_t k = 0; k < alive_; ++k)
    if (node(k).children == 0) node_of_[static_cast<std::size_t>(node(k).representative)] = k;
  work_.builds = 1;
}

bool PointTree::contains(std::int32_t id) const {
  return id >= 0 && static_cast<std::size_t>(id) < node_of_.size() &&
         node_of_[static_cast<std::size_t>(id)] >= 0;
}

void PointTree::build_anew(const HierarchyView& view) {
  PointTree anew(view);
  anew.work_ = work_;
  ++anew.work_.builds;
  *this = std::move(anew);
}

void PointTree::clear() noexcept {
  nodes_.clear();
  nets_.clear();
  alive_ = 0;
  free_rows_.clear();
  node_of_.clear();
  positions_.clear();
}

void PointTree::update(const HierarchyView& view) { take(view, nullptr); }

void PointTree::update(const HierarchyView& view, Span<const std::int32_t> changed) {
  detail::check_changed(changed, view);
  // With fewer ids the hierarchy was built anew.
  take(view, view.capacity() < capacity() ? nullptr : &changed);
}

/// Those named and new ones, or all that there are or were; ascending.
std::vector<std::int32_t> PointTree::ids_to_look_at(const HierarchyView& view,
                                                    const Span<const std::int32_t>* changed) const {
  std::vector<std::int32_t> ids;
  if (changed) ids.assign(changed->begin(), changed->end());
  const std::size_t from = changed ? capacity() : 0, all = std::max(capacity(), view.capacity());
  for (std::size_t id = from; id < all; ++id) ids.push_back(static_cast<std::int32_t>(id));
  if (!changed) return ids;
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

void PointTree::take(const HierarchyView& view, const Span<const std::int32_t>* changed) {
  try {
    if (nodes_.empty() || view.size() == 0 || view.box() != box_) return build_anew(view);
    change(view, ids_to_look_at(view, changed));
  } catch (...) {
    clear();
    throw;
  }
}

void PointTree::change(const HierarchyView& view, const std::vector<std::int32_t>& ids) {
  const detail::Structure& structure = view.structure();
  std::vector<std::int32_t> moved, leaving, coming;
  for (const std::int32_t id : ids) {
    const bool was_there = contains(id), is_there = structure.contains(id);
    if (was_there && !is_there) leaving.push_back(id);
    if (!was_there && is_there) coming.push_back(id);
    if (was_there && is_there && position(id) != structure.raw[static_cast<std::size_t>(id)])
      moved.push_back(id);
  }
  work_.compared += static_cast<std::int64_t>(ids.size());
  const std::size_t most = size() / kShareOfBuild;
  if (leaving.size() + coming.size() > most) return build_anew(view);
  rounding_ = detail::WrapError(box_).bound(structure.largest_reach);
  detail::TreeChanges changes(*this, structure);
  for (const std::int32_t id : leaving) changes.remove(id);
  node_of_.resize(view.capacity(), -1);
  positions_.resize(view.capacity());
  const std::int64_t measured = work_.measured;
  const std::vector<std::int32_t> strayed = changes.move(moved, moved.size() > size() / kShareOfMotion);
  wear_ += work_.measured - measured;
  if (leaving.size() + coming.size() + strayed.size() > most ||
      wear_ > kWearOfBuild * static_cast<std::int64_t>(size()))
    return build_anew(view);
  for (const std::int32_t id : strayed) changes.remove(id);
  coming.insert(coming.end(), strayed.begin(), strayed.end());
  for (const std::int32_t id : coming) changes.insert(id);
  changes.close_gaps();
}

}  // namespace dch
