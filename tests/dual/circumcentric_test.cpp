#include "derham/dual/circumcentric.hpp"

#include "derham/core/error.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/polytopes.hpp"
#include "derham/meshes/tori.hpp"
#include "geometry/mesh_kit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace derham {
namespace {

// Σ |σ| |⋆σ| = C(n,k) |M| for every k.
template <int n>
void expect_identity(const SimplicialComplex<n>& K, const Geometry<n>& g, double tolerance) {
  const auto dual = dual_volumes(K, g);
  const auto primal = primal_volumes(K, g);
  const double volume = total_volume(K, g);
  for (int k = 0; k <= n; ++k) {
    double sum = 0;
    for (Index i = 0; i < K.size(k); ++i) sum += primal[k][i] * dual[k][i];
    EXPECT_NEAR(sum / (static_cast<double>(binomial(n, k)) * volume), 1, tolerance) << "k = " << k;
  }
}

template <int n>
void expect_identity(const MeshData& mesh, double tolerance = 1e-12) {
  const SimplicialComplex<n> K(mesh.simplices);
  expect_identity(K, Geometry<n>::from_mesh(K, mesh), tolerance);
}

template <class T>
struct Circumcentric : testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                                  std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(Circumcentric, Dimensions);

TYPED_TEST(Circumcentric, VolumeIdentityOnAnyMesh) {
  constexpr int n = TypeParam::value;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const MeshData box = meshes::box(n, 3, {.jitter = 0.8 / n, .seed = seed});
    const MeshData torus = meshes::periodic_box(n, 3, {.jitter = 0.8 / n, .seed = seed});
    expect_identity<n>(box);
    expect_identity<n>(torus);
    expect_identity<n>(test::moved(box, n + 2, 1e-5, 1e-5, 1));
    expect_identity<n>(test::moved(torus, n + 1, 1e7, 1e7, 2));
  }
}

TYPED_TEST(Circumcentric, VolumesAreInvariantUnderRelabellingAndScale) {
  constexpr int n = TypeParam::value;
  const MeshData mesh = meshes::periodic_box(n, 3, {.jitter = 0.5 / n});
  std::vector<Index> id;
  const double s = 37;
  const MeshData other = test::shuffled(test::moved(mesh, n + 1, s, 1, 2), 3, id);
  const SimplicialComplex<n> K(mesh.simplices), L(other.simplices);
  const auto a = dual_volumes(K, Geometry<n>::from_mesh(K, mesh));
  const auto b = dual_volumes(L, Geometry<n>::from_mesh(L, other));
  for (int k = 0; k <= n; ++k)
    for (Index i = 0; i < K.size(k); ++i) {
      std::vector<Index> alias;
      for (const Index v : K.simplex(k, i)) alias.push_back(id[v]);
      const double expected = a[k][i] * std::pow(s, n - k);
      EXPECT_NEAR(b[k][L.at(alias).index], expected, 1e-10 * std::pow(s, n - k));
    }
}

TYPED_TEST(Circumcentric, LengthsGiveWhatPositionsGive) {
  constexpr int n = TypeParam::value;
  const meshes::BoxOptions options{.jitter = 0.5 / n};
  for (const MeshData& mesh : {meshes::box(n, 2, options), meshes::periodic_box(n, 3, options)}) {
    const SimplicialComplex<n> K(mesh.simplices);
    const auto g = Geometry<n>::from_mesh(K, mesh);
    ASSERT_EQ(g.source(), mesh.has_corners() ? MetricSource::corners : MetricSource::points);
    const auto lengths = Geometry<n>::from_squared_lengths(K, squared_lengths(K, g));
    const auto a = dual_volumes(K, g), b = dual_volumes(K, lengths);
    for (int k = 0; k <= n; ++k)
      for (Index i = 0; i < K.size(k); ++i) EXPECT_NEAR(a[k][i], b[k][i], 1e-10);
    const auto before = squared_lengths(K, g), after = squared_lengths(K, lengths);
    for (Index e = 0; e < K.size(1); ++e) EXPECT_NEAR(before[e], after[e], 1e-14);
  }
}

TEST(Circumcentric, IdentityOnCurvedManifolds) {
  expect_identity<2>(meshes::torus(12, 8));
  expect_identity<2>(meshes::clifford_torus(5, 6));
  expect_identity<3>(meshes::cross_polytope(3));
  expect_identity<3>(meshes::cell_600());
  expect_identity<4>(meshes::simplex_boundary(4));
}

TEST(Circumcentric, PointsAndEmptyMeshes) {
  const SimplicialComplex<0> points(SimplexList{{0}, {1}});
  const auto dual = dual_volumes(points, Geometry<0>::from_points(points, {1, 2}, 1));
  EXPECT_EQ(dual[0], (std::vector<double>{1, 1}));
  const SimplicialComplex<2> empty;
  EXPECT_TRUE(dual_volumes(empty, Geometry<2>::from_points(empty, {}, 2))[0].empty());
}

// A flat tetrahedron beside a sound one that shares a vertex with it only.
TEST(Circumcentric, DegenerateSimplicesAreNamedAndHarmOnlyTheirOwnFaces) {
  const SimplicialComplex<3> K(SimplexList{{0, 1, 2, 3}, {3, 4, 5, 6}});
  for (const double lift : {0.0, 1e-17}) {
    const auto g = Geometry<3>::from_points(K, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, lift, 2, 1, 0, 1, 2, 0, 1, 1, 1}, 3);
    try {
      (void)dual_volumes(K, g);
      ADD_FAILURE();
    } catch (const GeometryError& error) {
      EXPECT_NE(std::string(error.what()).find("3-simplex 0 = (0, 1, 2, 3)"), std::string::npos);
    }
    const auto result = circumcentric_dual(K, g);
    EXPECT_EQ(result.degenerate, std::vector<Index>{0});
    for (int k = 0; k <= 3; ++k)
      for (Index i = 0; i < K.size(k); ++i)
        EXPECT_EQ(std::isnan(result.dual[k][i]), K.simplex(k, i)[0] < 3 || (k == 0 && i == 3)) << k << " " << i;
  }
}

}  // namespace
}  // namespace derham
