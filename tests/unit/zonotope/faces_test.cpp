// SPDX-License-Identifier: MIT
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/zonotope/faces.hpp>

#include "error_message.hpp"
#include "random.hpp"
#include "random_zonotope.hpp"

namespace dch::zonotope {
namespace {

/// Of the pyramids from the center to the facets.
double volume_of_facets(const Zonotope& z, const std::vector<Facet>& found) {
  double sum = 0;
  for (const Facet& facet : found) {
    const std::vector<Vec3> corner = corners(z, facet);
    for (std::size_t k = 2; k < corner.size(); ++k)
      sum += std::abs(dot(cross(corner[0] - z.center, corner[k - 1] - z.center), corner[k] - z.center)) / 6;
  }
  return sum;
}

TEST(Faces, AreAsManyAsTheTheoremSaysInGeneralPosition) {
  for (const int n : {2, 3, 4, 7, 20, 40}) {
    const Zonotope z = canonical(random_zonotope(static_cast<std::size_t>(n), 5));
    const std::vector<Facet> found = facets(z);
    const FaceCounts counts = count_faces(found);
    EXPECT_EQ(counts.facets, n * (n - 1));
    EXPECT_EQ(counts.vertices, n * (n - 1) + 2);
    EXPECT_EQ(counts.edges, 2 * n * (n - 1));
    for (const Facet& facet : found) {
      EXPECT_NEAR(dot(facet.center, facet.normal), support(z, facet.normal), 1e-12);
      for (const Vec3& corner : corners(z, facet))
        EXPECT_NEAR(dot(corner, facet.normal), support(z, facet.normal), 1e-12);
    }
    EXPECT_NEAR(volume_of_facets(z, found), volume(z), 1e-12 * volume(z));
  }
}

TEST(Faces, OfKnownZonotopesAreWhatTheyAre) {
  Zonotope octahedron;  // truncated: 8 hexagons of three coplanar generators, 6 squares
  for (const Vec3 v : {Vec3{1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1}, {0, 1, 1}, {0, 1, -1}})
    octahedron.generators.push_back(v);
  octahedron = canonical(octahedron);
  const std::vector<Facet> found = facets(octahedron);
  FaceCounts counts = count_faces(found);
  EXPECT_EQ(counts.facets, 14);
  EXPECT_EQ(counts.vertices, 24);
  EXPECT_EQ(counts.edges, 36);
  EXPECT_NEAR(volume_of_facets(octahedron, found), volume(octahedron), 1e-12);
  const Zonotope dodecahedron = canonical({{}, {{1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, -1, -1}}});  // rhombic
  counts = count_faces(facets(dodecahedron));
  EXPECT_EQ(counts.facets, 12);
  EXPECT_EQ(counts.vertices, 14);
  EXPECT_EQ(counts.edges, 24);
}

TEST(Faces, OfFlatZonotopesAreTwoSides) {
  const Zonotope hexagon = canonical({{1, 1, 1}, {{1, 0, 0}, {0, 1, 0}, {1, 1, 0}}});
  const std::vector<Facet> sides = facets(hexagon);
  ASSERT_EQ(sides.size(), 2u);
  EXPECT_EQ(sides[0].center, hexagon.center);
  EXPECT_EQ(sides[0].generators.size(), 3u);
  EXPECT_EQ(count_faces(sides).vertices, 6);
  EXPECT_EQ(corners(hexagon, sides[0]).size(), 6u);
  EXPECT_TRUE(facets({{}, {{1, 0, 0}}}).empty());
  EXPECT_TRUE(facets({{}, {}}).empty());
}

TEST(Faces, RefuseParallelGenerators) {
  const std::string message = test::message_of<InvalidParameter>([] {
    facets({{}, {{1, 0, 0}, {2, 0, 0}, {0, 1, 0}}});
  });
  EXPECT_THAT(message, ::testing::HasSubstr("3 generators have 2 directions"));
  EXPECT_THROW(facets({{}, {{1, 0, 0}, {0, 0, 0}}}), InvalidParameter);
  EXPECT_THROW(facets({{NAN, 0, 0}, {}}), InvalidPosition);
}

}  // namespace
}  // namespace dch::zonotope
