#include "derham/boundary/small_homology.hpp"

#include "derham/meshes/boxes.hpp"
#include "derham/meshes/classics.hpp"
#include "derham/meshes/constructions.hpp"

#include <gtest/gtest.h>

#include <string>

namespace derham {
namespace {

template <int n>
std::string homology(const SimplexList& rows) {
  return homology_text(small_homology(SimplicialComplex<n>(rows)));
}

TEST(SmallHomology, OfTheClassics) {
  using namespace meshes;
  EXPECT_EQ(homology<0>({{0}, {1}, {2}}), "H_0 = Z^3");
  EXPECT_EQ(homology<1>(cycle(5)), "H_0 = Z, H_1 = Z");
  EXPECT_EQ(homology<1>(path(5)), "H_0 = Z, H_1 = 0");
  EXPECT_EQ(homology<4>(sphere(4)), "H_0 = Z, H_1 = 0, H_2 = 0, H_3 = 0, H_4 = Z");
  EXPECT_EQ(homology<2>(projective_plane()), "H_0 = Z, H_1 = Z_2, H_2 = 0");
  EXPECT_EQ(homology<2>(klein_bottle()), "H_0 = Z, H_1 = Z + Z_2, H_2 = 0");
  EXPECT_EQ(homology<2>(csaszar_torus()), "H_0 = Z, H_1 = Z^2, H_2 = Z");
  EXPECT_EQ(homology<2>(moebius_strip()), "H_0 = Z, H_1 = Z, H_2 = 0");
  EXPECT_EQ(homology<3>(grid_torus(3)), "H_0 = Z, H_1 = Z^3, H_2 = Z^3, H_3 = Z");
  EXPECT_EQ(homology<4>(complex_projective_plane()), "H_0 = Z, H_1 = 0, H_2 = Z, H_3 = 0, H_4 = Z");
  EXPECT_EQ(homology<3>(lens_space(3, 1)), "H_0 = Z, H_1 = Z_3, H_2 = 0, H_3 = Z");
  EXPECT_EQ(homology<3>(poincare_sphere()), "H_0 = Z, H_1 = 0, H_2 = 0, H_3 = Z");
  EXPECT_EQ(homology<4>(product(sphere(2), sphere(2))), "H_0 = Z, H_1 = 0, H_2 = Z^2, H_3 = 0, H_4 = Z");
  EXPECT_EQ(homology<3>(product(projective_plane(), path(1))), "H_0 = Z, H_1 = Z_2, H_2 = 0, H_3 = 0");
  EXPECT_EQ(homology<3>(product(klein_bottle(), path(1))), "H_0 = Z, H_1 = Z + Z_2, H_2 = 0, H_3 = 0");
}

TEST(SmallHomology, OfNonPureAndNonManifoldComplexes) {
  EXPECT_EQ(homology<2>({{0, 1, 2}, {2, 3}, {3, 4}, {2, 4}, {5}}), "H_0 = Z^2, H_1 = Z, H_2 = 0");
  EXPECT_EQ(homology<2>({{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}), "H_0 = Z, H_1 = 0, H_2 = 0");
  EXPECT_EQ(homology<3>(meshes::suspension(meshes::projective_plane())), "H_0 = Z, H_1 = 0, H_2 = Z_2, H_3 = 0");
}

TEST(SmallHomology, TellsSpheresAndPoints) {
  const auto sphere = small_homology(SimplicialComplex<3>(meshes::sphere(3)));
  const auto ball = small_homology(SimplicialComplex<3>(meshes::box(3, 3).simplices));
  const auto lens = small_homology(SimplicialComplex<3>(meshes::lens_space(3, 1)));
  EXPECT_TRUE(is_homology_of_sphere(sphere));
  EXPECT_FALSE(is_homology_of_point(sphere));
  EXPECT_TRUE(is_homology_of_point(ball));
  EXPECT_FALSE(is_homology_of_sphere(ball));
  EXPECT_FALSE(is_homology_of_sphere(lens));
  EXPECT_TRUE(is_homology_of_sphere(small_homology(SimplicialComplex<0>(meshes::sphere(0)))));
  EXPECT_TRUE(is_homology_of_point(small_homology(SimplicialComplex<0>(SimplexList{{0}}))));
}

/// Unit pivots without fill-in: tens of thousands of simplices are no burden.
TEST(SmallHomology, OfALargeLink) {
  EXPECT_EQ(homology<3>(meshes::grid_torus(3, 12)), "H_0 = Z, H_1 = Z^3, H_2 = Z^3, H_3 = Z");
}

}  // namespace
}  // namespace derham
