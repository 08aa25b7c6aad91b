// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <dch/engines/verlet_list.hpp>
#include <dch/lists/all_pairs.hpp>

#include "engines/dch_search.hpp"
#include "list_compare.hpp"
#include "scenes.hpp"

/// Lists that are kept by every engine that can tell when a pair is missing, and all pairs to compare them
/// with.
namespace dch::expiry {

using detail::StructureParams;

inline constexpr double kCutoff = 1.0, kSkin = 0.3, kRadius = kCutoff + kSkin;

struct NamedRequest {
  std::string name;
  ListParams params;
};

/// What lists may hold; owns what the requests view.
class Requests {
 public:
  explicit Requests(std::size_t n) {
    scenes::Random random(3);
    std::vector<IndexPair> excluded;
    for (std::size_t i = 0; i < n; ++i) {
      types_.push_back(static_cast<std::int32_t>(i % 5 == 0 ? 0 : 1 + i % 2));
      radii_.push_back(0.5 * kCutoff * (i % 7 == 0 ? 1.0 : std::pow(8, -random.uniform())));
      if (i % 3 == 0 && i + 1 < n)
        excluded.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(i + 1)});
    }
    exclusions_ = Exclusions::from_bonds(n, excluded, 1);
    const auto add = [&](const std::string& name) -> ListParams& {
      all_.push_back({name, {}});
      all_.back().params.cutoffs = TypeCutoffs(kCutoff);
      all_.back().params.skin = kSkin;
      return all_.back().params;
    };
    add("half");
    ListParams& full = add("full, unsorted, exclusions, ghosts");
    full.kind = ListKind::full;
    full.order = RowOrder::unsorted;
    full.exclusions = &exclusions_;
    full.first_ghost = static_cast<std::int32_t>(n - n / 4);
    ListParams& by_types = add("types, some without pairs");
    by_types.types = types_;
    by_types.cutoffs = TypeCutoffs(3, {kCutoff, 0.7, 0.0, 0.7, 0.3, 0.2, 0.0, 0.2, 0.0});
    ListParams& by_radii = add("radii");
    by_radii.radii = radii_;
    by_radii.order = RowOrder::unsorted;
  }
  Requests(const Requests&) = delete;
  Requests& operator=(const Requests&) = delete;
  const std::vector<NamedRequest>& all() const { return all_; }

 private:
  std::vector<std::int32_t> types_;
  std::vector<double> radii_;
  Exclusions exclusions_;
  std::vector<NamedRequest> all_;
};

struct NamedList {
  std::string name;
  VerletList list;
};

/// A list by each engine that can tell.
inline std::vector<NamedList> lists_of_all_engines(const ListParams& params) {
  const double radius = params.list_radius();
  HierarchyParams hierarchy, by_class, coarse;
  hierarchy.radius = by_class.radius = coarse.radius = radius;
  by_class.size_classes = true;
  coarse.policy = MaintenancePolicy::always_repair;
  std::vector<NamedList> all;
  all.push_back({"hierarchy", {make_dch_search(hierarchy), params}});
  all.push_back({"hierarchy, always repaired", {make_dch_search(coarse), params}});
  // Dozens of leaves among few particles, and edges that reach hardly farther than they have to.
  StructureParams small_leaves;
  small_leaves.radius = radius;
  small_leaves.base_radius = radius / 4;
  all.push_back({"hierarchy of small leaves", {make_dch_search(small_leaves), params}});
  all.push_back({"hierarchies by size", {make_dch_search(by_class), params}});
  all.push_back({"grid", {make_grid_search(radius), params}});
  all.push_back({"auto", {make_auto_search(hierarchy), params}});
  return all;
}

/// Pairs within their cutoffs now that a list lacks.
inline std::size_t missing_from(const NeighborList& list, const NeighborList& near) {
  const NeighborList rows = list.particle.empty() ? list : sorted_by_index(list, near.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < near.size(); ++i) {
    const auto row = rows.row(i);
    for (const std::int32_t j : near.row(i)) count += !std::binary_search(row.begin(), row.end(), j);
  }
  return count;
}

/// Follows particles in one box, and checks at each step what every list says of itself.
class Follower {
 public:
  Follower(Box box, const NamedRequest& request, std::vector<Vec3> points)
      : box_(std::move(box)), request_(request), points_(std::move(points)) {
    lists_ = lists_of_all_engines(request.params);
    bare_ = request.params;
    skin_ = request.params.skin;
    bare_.skin = 0;
    renew();
  }

  /// Moves on, then asks; lists that are stale are made anew.
  void step_to(const std::vector<Vec3>& points, const std::string& what) {
    points_ = points;
    const NeighborList near = all_pairs(points_, box_, bare_);
    const std::size_t fast = count_fast();
    bool is_stale = false;
    for (NamedList& each : lists_) {
      const std::string where = each.name + ", " + request_.name + ", " + what;
      const std::size_t missing = missing_from(each.list.list(), near);
      const ExpiryStats before = each.list.expiry();
      is_stale = each.list.is_stale(points_, box_);
      const ExpiryStats& after = each.list.expiry();
      const bool by_count = after.too_many > before.too_many;
      ASSERT_EQ(after.unknown, 0) << where;
      ASSERT_EQ(by_count, fast > most()) << where << ", " << fast << " fast";
      if (!by_count) {
        ASSERT_EQ(is_stale, missing > 0) << where << ", " << missing << " pairs missing";
        ASSERT_EQ(after.missing > before.missing, is_stale) << where;
      }
      kept_beyond_half_ += !is_stale && fast > 0;
      given_up_for_a_pair_ += is_stale && !by_count;
    }
    if (is_stale) renew();
  }

  const std::vector<Vec3>& points() const { return points_; }
  const Box& box() const { return box_; }
  int kept_beyond_half() const { return kept_beyond_half_; }
  int given_up_for_a_pair() const { return given_up_for_a_pair_; }
  std::size_t most() const {
    return std::max<std::size_t>(16,
                                 static_cast<std::size_t>(kMostFast * static_cast<double>(points_.size())));
  }

 private:
  void renew() {
    for (NamedList& each : lists_) each.list.update(points_, box_);
    at_list_ = points_;
  }
  /// Particles that have moved by more than half the skin; none of a test is within rounding of that.
  std::size_t count_fast() const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < points_.size(); ++i)
      count += std::sqrt(box_.distance2(points_[i], at_list_[i])) > 0.5 * skin_;
    return count;
  }

  Box box_;
  const NamedRequest& request_;
  ListParams bare_;  ///< without the skin
  double skin_ = 0;
  std::vector<Vec3> points_, at_list_;
  std::vector<NamedList> lists_;
  int kept_beyond_half_ = 0, given_up_for_a_pair_ = 0;
};

}  // namespace dch::expiry
