// SPDX-License-Identifier: MIT
//
// The hierarchy stands alone: this program is linked with the objects of the floors up to lib/src/hierarchy,
// and with nothing of lists, cluster pairs, engines and forces.
#include <gtest/gtest.h>
#include <vector>

#include <dch/hierarchy/hierarchy.hpp>

#include "scenes.hpp"

namespace dch {
namespace {

TEST(HierarchyAlone, IsBuiltRepairedAndChangedWithoutListsClustersAndForces) {
  const Box box = Box::orthorhombic({9, 9, 9});
  HierarchyParams params;
  params.radius = 1.5;
  Hierarchy hierarchy(params);
  std::vector<Vec3> points = scenes::uniform_in(box, 500, 17);
  hierarchy.build(points, box);
  ASSERT_EQ(validate(hierarchy.view()), "");
  scenes::Random random(18);
  for (Vec3& p : points) p = p + random.in_cube(2);
  hierarchy.update(points, box);
  hierarchy.repair();
  ASSERT_EQ(validate(hierarchy.view()), "");
  const std::int32_t id = hierarchy.insert({1, 2, 3});
  hierarchy.remove(id - 1);
  EXPECT_EQ(validate(hierarchy.view()), "");
  EXPECT_EQ(hierarchy.size(), points.size());
}

}  // namespace
}  // namespace dch
