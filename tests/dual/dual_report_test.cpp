#include "derham/dual/dual_report.hpp"

#include "derham/meshes/boxes.hpp"
#include "geometry/mesh_kit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace derham {
namespace {

DualReport report_of(const SimplicialComplex<2>& K, std::vector<double> points, int m = 2) {
  return dual_report(K, Geometry<2>::from_points(K, std::move(points), m));
}

// A rhombus across its long diagonal: both opposite angles are obtuse, ⋆ of the diagonal is ½(cot α + cot β) = -1.05.
TEST(DualReport, NegativeInteriorEdge) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}, {0, 1, 3}});
  const auto report = report_of(K, {0, 0, 1, 0, 0.5, 0.2, 0.5, -0.2});
  EXPECT_EQ(report.star[1].negative, std::vector<Index>{K.at({0, 1}).index});
  EXPECT_NEAR(report.star[1].min, -1.05, 1e-14);
  EXPECT_FALSE(report.pairwise_delaunay);
  EXPECT_TRUE(report.one_sided);
  EXPECT_FALSE(report.well_centered);
}

TEST(DualReport, NegativeBoundaryEdge) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}});
  const auto report = report_of(K, {0, 0, 1, 0, 0.5, 0.2});
  EXPECT_TRUE(report.pairwise_delaunay);
  EXPECT_FALSE(report.one_sided);
  EXPECT_EQ(report.star[1].negative, std::vector<Index>{0});
  EXPECT_FALSE(report.well_centered);
}

TEST(DualReport, AcuteTrianglesAreWellCentredInAnySpace) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}, {0, 1, 3}});
  const auto report = report_of(K, {0, 0, 0, 1, 0, 0, 0.5, 0.8, 0, 0.5, 0, 0.9}, 3);
  EXPECT_TRUE(report.well_centered);
  EXPECT_TRUE(report.pairwise_delaunay);
  EXPECT_TRUE(report.one_sided);
  for (int k = 0; k <= 2; ++k) EXPECT_GT(report.star[k].min, 0);
}

TEST(DualReport, DegenerateSimplicesLeaveTheOthersDefined) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}, {2, 3, 4}});
  const auto report = report_of(K, {0, 0, 1, 0, 2, 0, 3, 0, 2.5, 1});
  EXPECT_EQ(report.degenerate, std::vector<Index>{0});
  EXPECT_EQ(report.star[0].undefined, 3);
  EXPECT_EQ(report.star[1].undefined, 3);
  EXPECT_EQ(report.star[2].undefined, 1);
  EXPECT_TRUE(std::isfinite(report.star[1].min));
  EXPECT_FALSE(report.well_centered);
  const SimplicialComplex<2> only(SimplexList{{0, 1, 2}});
  EXPECT_TRUE(std::isnan(report_of(only, {0, 0, 1, 0, 2, 0}).star[2].min));
}

// The vertices of the rhombus moved to a square: cocircular, so the diagonal is exactly zero and still Delaunay.
TEST(DualReport, CocircularIsWeaklyDelaunay) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}, {0, 1, 3}});
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    MeshData mesh;
    mesh.simplices = SimplexList{{0, 1, 2}, {0, 1, 3}};
    mesh.vertex_count = 4;
    mesh.ambient_dimension = 2;
    mesh.points = {-1, 0, 1, 0, 0.6, 0.8, 0.28, -0.96};
    mesh = test::moved(mesh, 2, 1, 1, seed);
    const auto report = dual_report(K, Geometry<2>::from_mesh(K, mesh));
    EXPECT_EQ(report.star[1].zero, std::vector<Index>{0});
    EXPECT_TRUE(report.pairwise_delaunay);
  }
}

// A power of two changes no digit, so every star that doubles can hold is that of the mesh itself, scaled.
TEST(DualReport, AtExtremeScalesStarsAreRightOrUndefined) {
  const MeshData mesh = meshes::box(3, 2, {.jitter = 0.1});
  const SimplicialComplex<3> K(mesh.simplices);
  const auto plain = dual_report(K, Geometry<3>::from_mesh(K, mesh));
  for (const int exponent : {-600, -360, -300, 300, 400, 600}) {
    std::vector<double> points = mesh.points;
    for (double& x : points) x = std::ldexp(x, exponent);
    const auto g = Geometry<3>::from_points(K, points, 3);
    const auto report = dual_report(K, g);
    EXPECT_TRUE(report.degenerate.empty()) << exponent;
    for (int k = 0; k <= 3; ++k) {
      // D(σ) has size 2^(e(3-k)), |σ| has 2^(ek); both and their ratio must be normal numbers.
      const int largest = std::abs(exponent) * std::max({3 - k, k, std::abs(3 - 2 * k)});
      if (largest < 980) {
        EXPECT_EQ(report.star[k].undefined, 0) << exponent << ' ' << k;
        EXPECT_EQ(report.star[k].min, std::ldexp(plain.star[k].min, exponent * (3 - 2 * k))) << exponent << ' ' << k;
        EXPECT_EQ(report.star[k].negative, plain.star[k].negative) << exponent << ' ' << k;
      } else if (largest > 1060 && plain.star[k].zero.empty()) {
        EXPECT_EQ(report.star[k].undefined, K.size(k)) << exponent << ' ' << k;
      }
    }
  }
}

}  // namespace
}  // namespace derham
