// SPDX-License-Identifier: MIT
#include "engines/dch_search.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

#include <dch/base/error.hpp>

#include "base/seconds_since.hpp"
#include "engines/sized_search.hpp"
#include "geometry/metric.hpp"
#include "lists/leaf_crescents.hpp"
#include "lists/reach.hpp"

namespace dch {
namespace detail {
namespace {

using Clock = std::chrono::steady_clock;
}  // namespace

void DchSearch::update(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys) {
  const auto start = Clock::now();
  try {
    if (keys.empty()) {
      by_index(positions, box);
    } else {
      by_key(positions, box, keys);
    }
  } catch (...) {
    state_ = State::empty;
    hierarchy_.clear();
    throw;
  }
  ++updates_;
  maintain_seconds_ += seconds_since(start);
}

void DchSearch::list(const ListParams& params, NeighborList& out) {
  const auto start = Clock::now();
  list_maker_.list(hierarchy_.view(), params, out);
  list_seconds_ += seconds_since(start);
}

void DchSearch::lists(Span<const ListParams> requests, std::vector<NeighborList>& out) {
  const auto start = Clock::now();
  list_maker_.lists(hierarchy_.view(), requests, out);
  list_seconds_ += seconds_since(start);
}

void DchSearch::cluster_pairs(const ListParams& params, ClusterPairs& out) {
  const auto start = Clock::now();
  pair_maker_.make(hierarchy_.view(), params, out);
  list_seconds_ += seconds_since(start);
}

UnlistedPair DchSearch::unlisted_pair(const UnlistedQuestion& question) {
  const Structure& structure = hierarchy_.view().structure();
  if (!UnlistedPairs::can_tell(question) || structure.raw.size() != question.positions.size())
    return UnlistedPair::unknown;
  const UnlistedPairs pairs(question, structure.raw, structure.box, distance_error(structure));
  return with_metric(structure.box, [&](const auto& metric) {
    const LeafCrescents crescents(metric, structure);
    return pairs.find([&](const Crescent& crescent) {
      const std::int32_t i = crescent.particle;
      return crescents.any(crescent, crescents.leaf_of(i),
                           [&](std::int32_t j) { return pairs.contains(i, j); });
    });
  });
}

std::vector<LevelInfo> DchSearch::levels() {
  const HierarchyView view = hierarchy_.view();
  std::vector<LevelInfo> all;
  all.reserve(static_cast<std::size_t>(view.levels()));
  for (int i = 0; i < view.levels(); ++i) all.push_back(view.level(i));
  return all;
}

const SearchStats& DchSearch::stats() const {
  stats_ = hierarchy_.stats();
  stats_.memory_bytes += list_maker_.memory_bytes() + pair_maker_.memory_bytes();
  stats_.list_seconds = list_seconds_;
  stats_.updates = updates_;
  stats_.maintain_seconds = maintain_seconds_;
  return stats_;
}

void DchSearch::by_index(Span<const Vec3> positions, const Box& box) {
  if (state_ == State::indexed && positions.size() == hierarchy_.size()) {
    hierarchy_.update(positions, box);
  } else {
    hierarchy_.build(positions, box);
  }
  state_ = State::indexed;
}

void DchSearch::by_key(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys) {
  // The hierarchy may have lost its points in a list or a repair that was not finished.
  const std::vector<std::uint64_t>& before = keys_.keys();
  if (hierarchy_.size() != before.size()) state_ = State::empty;
  const bool are_as_before = state_ == State::keyed && keys.size() == positions.size() &&
                             std::equal(keys.begin(), keys.end(), before.begin(), before.end());
  if (are_as_before) {
    hierarchy_.update(positions, box);
    return;
  }
  const bool is_matched = state_ == State::keyed && keys.size() == positions.size() && match(positions, keys);
  state_ = State::empty;  // until all is done
  keys_.fill(positions.size(), keys);
  if (is_matched) {
    hierarchy_.update(positions, box);
  } else {
    hierarchy_.build(positions, box);
  }
  state_ = State::keyed;
}

/// Makes the hierarchy hold the particles with these keys under their new indices; false, with nothing done,
/// if so many come and go that a new build is less work, or if keys repeat, which KeyTable::fill() refuses.
bool DchSearch::match(Span<const Vec3> positions, Span<const std::uint64_t> keys) {
  const std::size_t before = hierarchy_.size();
  std::vector<std::int32_t> old_of_new(keys.size());
  std::vector<char> stays(before, 0);
  std::vector<std::uint64_t> arriving;
  bool any_twice = false;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const std::int32_t old = old_of_new[k] = keys_.find(keys[k]);
    if (old == KeyTable::kAbsent) {
      arriving.push_back(keys[k]);
    } else {
      any_twice |= stays[old] != 0;
      stays[old] = 1;
    }
  }
  const std::size_t arrivals = arriving.size();
  const std::size_t exchanged = arrivals + (before - (keys.size() - arrivals));
  if (hierarchy_.params().policy == MaintenancePolicy::automatic && !hierarchy_.exchange_pays(exchanged))
    return false;
  std::sort(arriving.begin(), arriving.end());
  if (any_twice || std::adjacent_find(arriving.begin(), arriving.end()) != arriving.end()) return false;
  for (std::size_t id = 0; id < before; ++id)
    if (!stays[id]) hierarchy_.remove(static_cast<std::int32_t>(id));
  for (std::size_t k = 0; k < keys.size(); ++k)
    if (old_of_new[k] == KeyTable::kAbsent)
      old_of_new[k] = hierarchy_.insert(positions[k], k == 0 ? -1 : old_of_new[k - 1]);
  hierarchy_.renumber(old_of_new);
  return true;
}

}  // namespace detail

std::unique_ptr<PairSearch> make_dch_search(const HierarchyParams& params) {
  return make_dch_search(detail::StructureParams(params));
}

std::unique_ptr<PairSearch> make_dch_search(const detail::StructureParams& params) {
  if (params.size_classes) return std::make_unique<detail::SizedSearch>(params);
  return std::make_unique<detail::DchSearch>(params);
}

std::unique_ptr<PairSearch> make_dch_search(double radius) {
  HierarchyParams params;
  params.radius = radius;
  return make_dch_search(params);
}

}  // namespace dch
