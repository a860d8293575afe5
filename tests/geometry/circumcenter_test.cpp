#include "derham/geometry/circumcenter.hpp"

#include "derham/core/error.hpp"
#include "derham/geometry/quality.hpp"
#include "derham/meshes/boxes.hpp"
#include "geometry/mesh_kit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

namespace derham {
namespace {

TEST(Circumcenter, IsEquidistantAndInThePlane) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int k = 0; k <= 4; ++k)
    for (int m = k; m <= 7; ++m) {
      std::vector<double> points(static_cast<std::size_t>((k + 1) * m));
      for (double& x : points) x = normal(random);
      const Circumcenter center = circumcenter(points, k, m);
      double sum = 0;
      std::vector<double> combination(m);
      for (int i = 0; i <= k; ++i) {
        double square = 0;
        for (int c = 0; c < m; ++c) {
          square += std::pow(points[i * m + c] - center.point[c], 2);
          combination[c] += center.barycentric[i] * points[i * m + c];
        }
        EXPECT_NEAR(std::sqrt(square), center.radius, 1e-10 * (1 + center.radius)) << k << " " << m;
        sum += center.barycentric[i];
      }
      EXPECT_NEAR(sum, 1, 1e-12);
      for (int c = 0; c < m; ++c) EXPECT_NEAR(combination[c], center.point[c], 1e-10 * (1 + center.radius));
    }
}

TEST(Circumcenter, OfARightTriangleIsTheMiddleOfTheHypotenuse) {
  const Circumcenter center = circumcenter(std::vector<double>{0, 0, 2, 0, 0, 2}, 2, 2);
  EXPECT_NEAR(center.barycentric[0], 0, 1e-15);
  EXPECT_NEAR(center.point[0], 1, 1e-15);
  EXPECT_NEAR(center.point[1], 1, 1e-15);
}

TEST(Circumcenter, FlatSimplicesAreRefusedByName) {
  EXPECT_THROW((void)circumcenter(std::vector<double>{0, 0, 1, 1, 2, 2}, 2, 2), GeometryError);
  EXPECT_THROW((void)circumcenter(std::vector<double>{0, 0}, 2, 2), InputError);
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}});
  const auto g = Geometry<2>::from_points(K, {0, 0, 1, 1, 2, 2}, 2);
  EXPECT_NO_THROW((void)circumcenter(K, g, 1, 0));
  try {
    (void)circumcenter(K, g, 2, 0);
    FAIL();
  } catch (const GeometryError& error) {
    EXPECT_NE(std::string(error.what()).find("(0, 1, 2)"), std::string::npos);
  }
}

TEST(Circumcenter, OfFacesOfAPeriodicMesh) {
  const MeshData torus = meshes::periodic_box(3, 3);
  const SimplicialComplex<3> K(torus.simplices);
  const auto g = Geometry<3>::from_mesh(K, torus);
  for (int k = 1; k <= 3; ++k)
    for (Index i = 0; i < K.size(k); ++i) EXPECT_LT(circumcenter(K, g, k, i).radius, std::sqrt(3.0) / 6 + 1e-12);
}

// The rule of flatness is that of quality(): the longest of all edges, and the rounding of the coordinates.
TEST(Circumcenter, IsRefusedWhereQualityFindsDegenerateSimplices) {
  for (const double height : {1e-11, 1e-9, 1e-7}) {
    const MeshData far = test::single({1e6, 1e6, 1e6 + 1, 1e6, 1e6 + 0.5, 1e6 + height}, 2);
    const SimplicialComplex<2> K(far.simplices);
    const auto g = Geometry<2>::from_mesh(K, far);
    if (quality(K, g).degenerate.empty()) {
      EXPECT_NO_THROW((void)circumcenter(K, g, 2, 0)) << height;
    } else {
      EXPECT_THROW((void)circumcenter(K, g, 2, 0), GeometryError) << height;
    }
  }
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}});
  const double side = 0.5 + 1e-16;
  const auto lengths = Geometry<2>::from_squared_lengths(K, std::vector<double>{1, side * side, side * side});
  ASSERT_EQ(quality(K, lengths).degenerate.size(), 1u);
  EXPECT_THROW((void)circumcenter(K, lengths, 2, 0), GeometryError);
}

TEST(Circumcenter, AtExtremeScales) {
  for (const double s : {1e-200, 1e-110, 1e120, 1e200}) {
    const auto c = circumcenter(std::vector<double>{0, 0, 0, s, 0, 0, 0, s, 0, 0, 0, s}, 3, 3);
    EXPECT_NEAR(c.radius / s, std::sqrt(3.0) / 2, 1e-15) << s;
    for (const double x : c.point) EXPECT_NEAR(x / s, 0.5, 1e-15) << s;
  }
}

}  // namespace
}  // namespace derham
