// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/clusters/cluster_pairs.hpp>
#include <dch/lists/list_params.hpp>

#include "listed_hierarchy.hpp"
#include "random.hpp"
#include "scenes.hpp"

namespace dch::scenes {

inline constexpr double kOrderedCutoff = 1.0, kOrderedSkin = 0.3;
inline constexpr int kOrderedTypes = 5;
inline constexpr int kRefreshes = ClusterPairs::steps_to_order(ClusterPairs::EntryOrder::joined);
using EntryOrder = ClusterPairs::EntryOrder;
inline constexpr std::array kOrders{EntryOrder::joined, EntryOrder::by_halves,
                                    EntryOrder::by_image_and_halves};

/// Particles on a lattice that is shaken, 2.4 to a unit of volume; some leave the cell.
class OrderedPairs : public ::testing::TestWithParam<NamedBox> {
 protected:
  OrderedPairs() {
    constexpr int kSide = 13;
    Random random(21);
    for (int x = 0; x < kSide; ++x)
      for (int y = 0; y < kSide; ++y)
        for (int z = 0; z < kSide; ++z) {
          const Vec3 fraction = (1.0 / kSide) * Vec3{x + 0.0, y + 0.0, z + 0.0};
          const Vec3 at = box.kind() == Box::Kind::none ? 10.0 * fraction : from_fractional(box, fraction);
          points.push_back(at + random.in_ball(0.1));
          charges.push_back(random.uniform(-1, 1));
          types.push_back(static_cast<std::int32_t>(random.below(kOrderedTypes)));
        }
    random.shuffle(points);
    request.cutoffs = TypeCutoffs(kOrderedCutoff);
    request.skin = kOrderedSkin;
  }

  /// Pairs of a list before which another one has lived for so many steps.
  ClusterPairs searched(int refreshes, Executor* executor = nullptr) {
    StructureParams params;
    params.radius = request.list_radius();
    params.executor = executor;
    ListedHierarchy hierarchy(params);
    hierarchy.build(points, box);
    ClusterPairs pairs;
    hierarchy.cluster_pairs(request, pairs);
    for (int k = 0; k < refreshes; ++k) pairs.refresh(points, box);
    hierarchy.cluster_pairs(request, pairs);
    return pairs;
  }
  ClusterPairs ordered(EntryOrder order, Executor* executor = nullptr) {
    ClusterPairs pairs = searched(kRefreshes, executor);
    pairs.order_entries(order, executor);
    return pairs;
  }

  Box box = GetParam().box;
  std::vector<Vec3> points;
  std::vector<double> charges;
  std::vector<std::int32_t> types;
  ListParams request;
};

}  // namespace dch::scenes
