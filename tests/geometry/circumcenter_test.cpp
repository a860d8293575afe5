#include "derham/geometry/circumcenter.hpp"

#include "derham/core/error.hpp"
#include "derham/meshes/boxes.hpp"

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

}  // namespace
}  // namespace derham
