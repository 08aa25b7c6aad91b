// SPDX-License-Identifier: MIT
#include <cstdio>
#include <vector>

#include <dch/hierarchy/hierarchy.hpp>
#include <dch/proximity/nearest.hpp>

int main() {
  const std::vector<dch::Vec3> positions{{0, 0, 0}, {1.5, 0, 0}, {4, 0, 0}};
  dch::HierarchyParams params;
  params.radius = 2;
  dch::Hierarchy hierarchy(params);
  hierarchy.build(positions, dch::Box::none());
  const dch::NearestRows rows = dch::Nearest(hierarchy.view()).of_points({});
  std::printf("the nearest of each: %d %d %d\n", rows.id[0], rows.id[1], rows.id[2]);
  return rows.id == std::vector<std::int32_t>{1, 0, 1} ? 0 : 1;
}
