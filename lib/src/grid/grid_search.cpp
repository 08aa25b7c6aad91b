// SPDX-License-Identifier: MIT
#include "grid/grid_search.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <dch/base/error.hpp>

#include "base/describe.hpp"
#include "base/seconds_since.hpp"
#include "geometry/position_check.hpp"
#include "geometry/tolerance.hpp"
#include "grid/cell_crescents.hpp"
#include "lists/list_assembly.hpp"
#include "lists/list_check.hpp"
#include "lists/reach.hpp"

namespace dch {
namespace detail {
namespace {

using Clock = std::chrono::steady_clock;

bool have_sizes(Span<const ListParams> requests) {
  return std::any_of(requests.begin(), requests.end(), [](const ListParams& request) {
    return !request.radii.empty() || request.cutoffs.types() > 1;
  });
}

/// All particles alike.
SizeClasses one_class(Span<const ListParams> requests) {
  SizeClasses one;
  one.count = 1;
  one.reach.assign(1, 0.0);
  for (const ListParams& request : requests) one.reach[0] = std::max(one.reach[0], request.list_radius());
  return one;
}

double cube(double v) { return v * v * v; }

/// Pairs of points that are looked at, in cubes of the reach.
double work_of(const SizeClasses& classes) {
  std::vector<double> members(classes.count, 0.0);
  for (const std::int32_t g : classes.of) ++members[g];
  double work = 0;
  for (std::size_t a = 0; a < classes.count; ++a)
    for (std::size_t b = 0; b <= a; ++b) {
      work += members[a] * members[b] * cube(classes.reach_of(a, b)) * (a == b ? 1 : 2);
    }
  return work;
}
double work_of_one(const SizeClasses& one, std::size_t n) {
  return static_cast<double>(n) * static_cast<double>(n) * cube(one.reach[0]);
}

}  // namespace

void GridSearch::clear() {
  positions_ = {};
  copy_.clear();
  groups_.clear();
  plain_.clear();
  has_plain_ = false;
}

void GridSearch::update(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys) {
  update_by([&] { take(positions, box, keys, Keep::copy); });
}

void GridSearch::update_by_reference(Span<const Vec3> positions, const Box& box) {
  update_by([&] { take(positions, box, {}, Keep::reference); });
}

template <class Take>
void GridSearch::update_by(const Take& take) {
  const auto start = Clock::now();
  try {
    take();
  } catch (...) {
    clear();
    throw;
  }
  ++stats_.updates;
  stats_.maintain_seconds += seconds_since(start);
}

void GridSearch::lists(Span<const ListParams> requests, std::vector<NeighborList>& out) {
  out.resize(requests.size());
  std::vector<NeighborList*> each;
  each.reserve(out.size());
  for (NeighborList& list : out) each.push_back(&list);
  make_lists(requests, each);
}

/// Puts the points into the cells that the requests need.
GridSearch::Reach GridSearch::prepare(Span<const ListParams> requests) {
  const auto start = Clock::now();
  double reach = 0, host_error = 0;
  bool shell = false;
  for (const ListParams& request : requests) {
    reach = std::max(reach, request.list_radius());
    host_error = std::max(host_error, request.cutoff_error());
    shell = shell || request.shell > 0;
  }
  fine_ = shell;
  const double error = wrap_error_ + rounding_of_leaves(radius_) + host_error;
  // Two images of a point may both be within the band of the cutoff only if it is half a period.
  bool in_cells = !box_.any_periodic() || (reach + 3 * error) * kInflate < box_.max_cutoff();
  if (in_cells) {
    classify(requests);
    for (std::size_t k = 0; k < exact_reach_.size(); ++k)
      classes_.reach[k] = exact_reach_[k] > 0 ? (exact_reach_[k] + error) * kInflate : 0;
    in_cells = sort_points(error);
  }
  stats_.maintain_seconds += seconds_since(start);
  return {error, in_cells};
}

GridScene GridSearch::scene_of(double error) {
  GridScene scene{positions_, box_, {}, classes_.reach, error, executor_};
  for (Group& group : groups_) scene.layers.push_back(&group.layer);
  return scene;
}

void GridSearch::make_lists(Span<const ListParams> requests, const std::vector<NeighborList*>& out) {
  if (requests.empty()) return;
  for (const ListParams& request : requests) check_list_params(request, positions_.size(), radius_);
  make_or_empty(out, [&] {
    const auto [error, in_cells] = prepare(requests);
    const auto listing = Clock::now();
    const auto find_rows = [&, error = error, in_cells = in_cells](const auto& filters, const auto& lists) {
      if (!in_cells) return find_plainly(error, filters, lists);
      rows_.find(scene_of(error), filters, lists);
    };
    list_finder_.find({positions_, box_, error}, requests, find_rows, out);
    stats_.list_seconds += seconds_since(listing);
  });
}

void GridSearch::list_in_pieces(const ListParams& params,
                                const std::function<void(const NeighborList&)>& use) {
  check_list_params(params, positions_.size(), radius_);
  const auto [error, in_cells] = prepare({&params, 1});
  const PairFilter filter(positions_, box_, params, error);
  if (in_cells) {
    rows_.find_in_pieces(scene_of(error), filter, use);
  } else {
    NeighborList all;
    find_plainly(error, {&filter}, {&all});
    use(all);
  }
}

std::optional<Occupancy> GridSearch::occupancy_for(Span<const ListParams> requests) {
  for (const ListParams& request : requests) check_list_params(request, positions_.size(), radius_);
  if (!prepare(requests).in_cells) return std::nullopt;
  double points = 0, cells = 0, squares = 0, sparse = 0;
  for (const Group& group : groups_) {
    if (group.layer.size() == 0) continue;
    const Occupancy& own = group.layer.occupancy();
    points += group.layer.size();
    cells += group.layer.size() / own.mean;
    squares += group.layer.size() * own.of_point;
    sparse += group.layer.size() * own.sparse;
  }
  return points > 0 ? Occupancy{points / cells, squares / points, sparse / points} : Occupancy();
}

/// Several classes if those of the sizes that are asked for make for less work than one; those at hand if
/// sizes are what they were.
void GridSearch::classify(Span<const ListParams> requests) {
  /// Several grids have this share of the work of one at most, for it is more than the pairs looked at.
  constexpr double kWorthIt = 0.6;
  if (!groups_.empty() && sizes_.says_the_same(requests)) return;
  sizes_.forget();
  const std::size_t n = positions_.size();
  SizeClasses chosen = one_class(requests);
  if (have_sizes(requests)) {
    SizeClasses several(requests, n, true);
    if (several.count > 1 && work_of(several) < kWorthIt * work_of_one(chosen, n))
      chosen = std::move(several);
  }
  exact_reach_ = chosen.reach;
  if (groups_.size() != chosen.count || chosen.of != classes_.of) {
    groups_.clear();  // if memory runs out below, nothing is known of them
    std::vector<Group> groups(chosen.count);
    for (std::size_t i = 0; i < n && chosen.count > 1; ++i)
      groups[chosen.of[i]].particle.push_back(static_cast<std::int32_t>(i));
    groups_.swap(groups);
  }
  classes_ = std::move(chosen);
  sizes_.keep(requests);  // last, when all goes by them
}

/// Where lists reach half the box, or points lie too far apart for cells.
void GridSearch::find_plainly(double error, const std::vector<const PairFilter*>& filters,
                              const std::vector<NeighborList*>& out) {
  if (!has_plain_) {
    std::vector<Vec3> wrapped(positions_.begin(), positions_.end());
    for (Vec3& p : wrapped) p = box_.wrap(p);
    plain_.build(wrapped, box_, radius_ + error);
    has_plain_ = true;
    ++stats_.builds;
  }
  for (std::size_t r = 0; r < out.size(); ++r) {
    NeighborList& list = *out[r];
    start_rows(list);
    list.j.clear();
    plain_.find_rows(box_, *filters[r], [&](std::int32_t i, Span<const std::int32_t> others) {
      list.particle.push_back(i);
      list.j.insert(list.j.end(), others.begin(), others.end());
      list.first.push_back(static_cast<std::int64_t>(list.j.size()));
      if (filters[r]->params().shell > 0) list.near_end.push_back(list.first.back());
    });
  }
}

UnlistedPair GridSearch::unlisted_pair(const UnlistedQuestion& question) {
  const bool is_in_cells =
      !groups_.empty() && std::all_of(groups_.begin(), groups_.end(), [](const Group& group) {
        return group.reach > 0 && (group.layer.size() == 0 || group.layer.rounding().unit > 0);
      });
  if (!UnlistedPairs::can_tell(question) || !is_in_cells || question.positions.size() != positions_.size())
    return UnlistedPair::unknown;
  const UnlistedPairs pairs(question, positions_, box_, wrap_error_ + rounding_of_leaves(radius_));
  std::vector<CellCrescents> crescents;
  for (Group& group : groups_)
    if (group.layer.size() > 0) crescents.emplace_back(group.layer, positions_, box_);
  return pairs.find([&](const Crescent& crescent) {
    const auto is_unlisted = [&](std::int32_t j) { return pairs.contains(crescent.particle, j); };
    return std::any_of(crescents.begin(), crescents.end(),
                       [&](const CellCrescents& layer) { return layer.any(crescent, is_unlisted); });
  });
}

const SearchStats& GridSearch::stats() const {
  const auto bytes_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  stats_.memory_bytes = bytes_of(copy_) + bytes_of(classes_.of) + sizes_.memory_bytes() +
                        plain_.memory_bytes() + rows_.memory_bytes() + list_finder_.memory_bytes();
  for (const Group& group : groups_)
    stats_.memory_bytes += group.layer.memory_bytes() + bytes_of(group.particle);
  return stats_;
}

}  // namespace detail

std::unique_ptr<PairSearch> make_grid_search(double radius, Executor* executor) {
  if (!(std::isfinite(radius) && radius >= kMinListRadius && radius <= kMaxListRadius))
    throw InvalidParameter("the search radius is " + detail::describe(radius) + "; it must be " +
                           detail::describe(kMinListRadius) + " to " + detail::describe(kMaxListRadius));
  return std::make_unique<detail::GridSearch>(radius, executor);
}

}  // namespace dch
