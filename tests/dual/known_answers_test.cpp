#include "derham/dual/circumcentric.hpp"
#include "derham/dual/dual_report.hpp"
#include "derham/io/read_mesh.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/lattices.hpp"
#include "derham/meshes/polytopes.hpp"
#include "geometry/mesh_kit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace derham {
namespace {

template <int n>
struct Mesh {
  explicit Mesh(const MeshData& data)
      : K(data.simplices), g(Geometry<n>::from_mesh(K, data)), dual(circumcentric_dual(K, g)) {}
  [[nodiscard]] double star(int k, Index i) const { return dual.dual[k][i] / dual.primal[k][i]; }
  void expect_all(int k, double dual_volume, double tolerance = 1e-10) const {
    for (Index i = 0; i < K.size(k); ++i) ASSERT_NEAR(dual.dual[k][i] / dual_volume, 1, tolerance) << k << " " << i;
  }
  SimplicialComplex<n> K;
  Geometry<n> g;
  CircumcentricDual<n> dual;
};

TEST(KnownAnswers, RegularTriangle) {
  const Mesh<2> mesh(meshes::regular_simplex(2));
  EXPECT_NEAR(mesh.dual.primal[2][0], 0.43301270189, 1e-11);
  mesh.expect_all(0, 0.14433756730);
  mesh.expect_all(1, 0.28867513459);
  EXPECT_NEAR(mesh.star(2, 0), 2.3094010768, 1e-10);
}

TEST(KnownAnswers, RegularTetrahedron) {
  const Mesh<3> mesh(meshes::regular_simplex(3));
  EXPECT_NEAR(mesh.dual.primal[3][0], 0.11785113020, 1e-11);
  mesh.expect_all(0, 0.02946278255);
  mesh.expect_all(1, 0.05892556510);
  mesh.expect_all(2, 0.20412414523);
  EXPECT_NEAR(mesh.star(2, 0), 0.47140452079, 1e-10);
  EXPECT_NEAR(mesh.star(3, 0), 8.48528137424, 1e-9);
}

TEST(KnownAnswers, BodyCentredCubicTorus) {
  const Mesh<3> mesh(meshes::bcc_lattice(3));
  mesh.expect_all(0, 0.5);
  for (Index e = 0; e < mesh.K.size(1); ++e)
    EXPECT_NEAR(mesh.star(1, e), mesh.dual.primal[1][e] > 0.9 ? 1.0 / 8 : 3.0 / 8, 1e-12);
  for (Index f = 0; f < mesh.K.size(2); ++f) EXPECT_NEAR(mesh.star(2, f), 1, 1e-12);
  for (Index t = 0; t < mesh.K.size(3); ++t) EXPECT_NEAR(mesh.star(3, t), 12, 1e-11);
  EXPECT_TRUE(mesh.dual.well_centered);
}

TEST(KnownAnswers, EquilateralFlatTorus) {
  const Mesh<2> mesh(meshes::a_star_lattice(2, 4));
  const double h = mesh.dual.primal[1][0];
  mesh.expect_all(0, std::sqrt(3.0) / 2 * h * h);
  for (Index e = 0; e < mesh.K.size(1); ++e) EXPECT_NEAR(mesh.star(1, e), 1 / std::sqrt(3.0), 1e-12);
  for (Index t = 0; t < mesh.K.size(2); ++t) EXPECT_NEAR(mesh.star(2, t) * h * h, 4 / std::sqrt(3.0), 1e-11);
  EXPECT_TRUE(mesh.dual.well_centered);
}

TEST(KnownAnswers, Cell600) {
  const Mesh<3> mesh(meshes::cell_600());
  mesh.expect_all(0, 0.13910439, 1e-7);
  mesh.expect_all(1, 0.11253781, 1e-7);
  mesh.expect_all(2, 0.25231132, 1e-7);
  mesh.expect_all(3, 1);
}

// The diagonals of a grid have dual volume zero, in any position and at any scale, and nothing is negative.
TEST(KnownAnswers, KuhnGridsHaveExactZeros) {
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    const double scale = std::pow(10, static_cast<int>(seed) - 6), shift = (seed % 3) * 100 * scale;
    const auto square = dual_report(Mesh<2>(test::moved(meshes::box(2, 4), 2, scale, shift, seed)).K,
                                    Mesh<2>(test::moved(meshes::box(2, 4), 2, scale, shift, seed)).dual);
    const Mesh<3> cube(test::moved(meshes::box(3, 4), seed % 2 ? 3 : 5, scale, shift, seed));
    const auto report = dual_report(cube.K, cube.dual);
    EXPECT_EQ(cube.K.size(1), 604);
    EXPECT_EQ(cube.K.size(2), 864);
    EXPECT_EQ(square.star[1].zero.size(), 16u);
    EXPECT_EQ(report.star[0].zero.size(), 0u);
    EXPECT_EQ(report.star[1].zero.size(), 304u);
    EXPECT_EQ(report.star[2].zero.size(), 384u);
    EXPECT_EQ(report.star[3].zero.size(), 0u);
    for (int k = 0; k <= 3; ++k) EXPECT_TRUE(report.star[k].negative.empty());
    EXPECT_EQ(report.star[1].min, 0);
    EXPECT_TRUE(report.pairwise_delaunay);
    EXPECT_TRUE(report.one_sided);
    EXPECT_FALSE(report.well_centered);
  }
}

// Far from the origin the coordinates are rounded; verdicts allow for it.
TEST(KnownAnswers, KuhnGridFarFromTheOrigin) {
  const Mesh<3> cube(test::moved(meshes::box(3, 4), 3, 1, 1e6, 3));
  const auto report = dual_report(cube.K, cube.dual);
  EXPECT_EQ(report.star[1].zero.size(), 304u);
  EXPECT_EQ(report.star[2].zero.size(), 384u);
  EXPECT_TRUE(report.pairwise_delaunay);
}

TEST(KnownAnswers, LatticesAreWellCentredInFourDimensionsOnlyWeakly) {
  const Mesh<4> mesh(meshes::a_star_lattice(4, 3));
  const auto report = dual_report(mesh.K, mesh.dual);
  for (int k = 0; k <= 4; ++k) {
    EXPECT_GT(report.star[k].min, 0) << k;
    EXPECT_TRUE(report.star[k].zero.empty());
  }
  EXPECT_TRUE(report.pairwise_delaunay);
}

// The mesh of PyDEC's resonant cavity: one pair of triangles is not Delaunay.
TEST(KnownAnswers, CavityHasOneNegativeEdge) {
  const Mesh<2> mesh(read_mesh(DERHAM_CAVITY));
  EXPECT_EQ(mesh.K.size(0), 191);
  EXPECT_EQ(mesh.K.size(1), 526);
  EXPECT_EQ(mesh.K.size(2), 336);
  double area = 0;
  for (const double a : mesh.dual.primal[2]) area += a;
  EXPECT_NEAR(area, std::numbers::pi * std::numbers::pi, 1e-12);
  const DualReport report = dual_report(mesh.K, mesh.dual);
  ASSERT_EQ(report.star[1].negative.size(), 1U);
  const Index edge = report.star[1].negative.front();
  EXPECT_EQ(mesh.K.simplex(1, edge)[0], 63);
  EXPECT_EQ(mesh.K.simplex(1, edge)[1], 103);
  EXPECT_NEAR(mesh.star(1, edge), -0.0842, 5e-5);
  EXPECT_FALSE(report.pairwise_delaunay);
}

}  // namespace
}  // namespace derham
