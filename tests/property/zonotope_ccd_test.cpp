// SPDX-License-Identifier: MIT
//
// libccd's GJK on the same support functions, where the zonotopes are not so near that its tolerance matters.
#include <ccd/ccd.h>
#include <ccd/quat.h>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

#include <dch/zonotope/gjk.hpp>
#include <dch/zonotope/membership.hpp>

#include "effort.hpp"
#include "random.hpp"

namespace dch::zonotope {
namespace {

void support_of(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
  const auto& z = *static_cast<const Zonotope*>(object);
  const Vec3 p = support_point(z, {direction->v[0], direction->v[1], direction->v[2]});
  ccdVec3Set(point, p.x, p.y, p.z);
}

bool intersect_by_ccd(const Zonotope& a, const Zonotope& b) {
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = ccd.support2 = support_of;
  ccd.max_iterations = 500;
  return ccdGJKIntersect(&a, &b, &ccd) != 0;
}

TEST(ZonotopeAgainstCcd, IntersectionsAreTheSame) {
  scenes::Random random(61);
  int met = 0, compared = 0;
  const int trials = effort(3000);
  for (int n = 0; n < trials; ++n) {
    Zonotope a{random.in_cube(4), {}}, b{random.in_cube(4), {}};
    for (std::size_t k = 0; k < 3 + random.below(20); ++k)
      (k % 2 == 0 ? a : b).generators.push_back(random.in_cube(1));
    Zonotope wider = a, narrower = a;
    for (Vec3& v : wider.generators) v = 1.0001 * v;
    for (Vec3& v : narrower.generators) v = 0.9999 * v;
    const bool meet = intersect(a, b);
    if (intersect(wider, b) != meet || intersect(narrower, b) != meet) continue;
    ++compared;
    met += meet;
    EXPECT_EQ(intersect_by_ccd(a, b), meet) << n << ", at a distance of " << distance(a, b).distance;
  }
  std::printf("%d of %d compared, %d intersect\n", compared, trials, met);
  EXPECT_GT(compared, trials * 9 / 10);
  EXPECT_GT(met, trials / 20);
}

}  // namespace
}  // namespace dch::zonotope
