#include "derham/geometry/volumes.hpp"

#include "derham/core/error.hpp"
#include "derham/meshes/boxes.hpp"
#include "geometry/mesh_kit.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace derham {
namespace {

template <class T>
struct Volumes : testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                                  std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(Volumes, Dimensions);

TYPED_TEST(Volumes, OfTheUnitCornerSimplex) {
  // Faces through the origin have volume 1/k!, faces opposite √(k+1)/k!.
  constexpr int n = TypeParam::value;
  std::vector<double> points;
  for (int i = 0; i <= n; ++i)
    for (int c = 0; c < n; ++c) points.push_back(i == c + 1 ? 1 : 0);
  for (const int m : {n, n + 1, n + 3}) {
    MeshData mesh = test::single(points, n);
    if (m > n) mesh = test::moved(mesh, m, 1, 1, 5);
    const SimplicialComplex<n> K(mesh.simplices);
    const auto volume = primal_volumes(K, Geometry<n>::from_mesh(K, mesh));
    for (int k = 0; k <= n; ++k)
      for (Index i = 0; i < K.size(k); ++i) {
        const bool origin = K.simplex(k, i)[0] == 0;
        EXPECT_NEAR(volume[k][i], (origin ? 1 : std::sqrt(k + 1.0)) / static_cast<double>(factorial(k)), 1e-14);
      }
  }
}

TYPED_TEST(Volumes, JitterKeepsThePeriodicVolume) {
  constexpr int n = TypeParam::value;
  const MeshData mesh = meshes::periodic_box(n, 3, {.jitter = 0.15, .seed = 7});
  const SimplicialComplex<n> K(mesh.simplices);
  EXPECT_NEAR(total_volume(K, Geometry<n>::from_mesh(K, mesh)), 1, 1e-13);
}

TYPED_TEST(Volumes, AreInvariantAndScale) {
  constexpr int n = TypeParam::value;
  const MeshData mesh = meshes::box(n, 2, {.jitter = 0.2});
  std::vector<Index> id;
  const MeshData other = test::shuffled(test::moved(mesh, n + 2, 1e3, 1, 2), 3, id);
  const SimplicialComplex<n> K(mesh.simplices), L(other.simplices);
  const auto a = primal_volumes(K, Geometry<n>::from_mesh(K, mesh));
  const auto b = primal_volumes(L, Geometry<n>::from_mesh(L, other));
  for (int k = 0; k <= n; ++k)
    for (Index i = 0; i < K.size(k); ++i) {
      std::vector<Index> alias;
      for (const Index v : K.simplex(k, i)) alias.push_back(id[v]);
      EXPECT_NEAR(b[k][L.at(alias).index] / (a[k][i] * std::pow(1e3, k)), 1, 1e-11);
    }
}

TYPED_TEST(Volumes, OrientationFollowsThemForAnyOrderOfTheTuples) {
  constexpr int n = TypeParam::value;
  std::vector<Index> id;
  const MeshData mesh = test::shuffled(meshes::box(n, 2, {.jitter = 0.2}), 4, id);
  SimplicialComplex<n> K(mesh.simplices);
  const auto g = Geometry<n>::from_mesh(K, mesh);
  orient_by_volume(K, g);
  const auto volume = signed_volumes(K, g);
  for (Index t = 0; t < K.size(n); ++t) EXPECT_GT(volume[t] * K.sign(n, t), 0);
}

TEST(Orientation, EveryComponentByItself) {
  SimplicialComplex<2> K(SimplexList{{0, 1, 2}, {3, 4, 5}});
  orient_by_volume(K, Geometry<2>::from_points(K, {0, 0, 0, 1, 1, 0, 5, 0, 6, 0, 5, 1}, 2));
  EXPECT_EQ(K.sign(2, 0), -1);
  EXPECT_EQ(K.sign(2, 1), 1);
}

TEST(Orientation, SurfacesInSpaceKeepTheOrderOfTheirFirstTuple) {
  SimplicialComplex<2> K(SimplexList{{0, 2, 1}});
  const auto g = Geometry<2>::from_points(K, {0, 0, 0, 1, 0, 0, 0, 1, 0}, 3);
  orient_by_volume(K, g);
  EXPECT_EQ(K.sign(2, 0), -1);
  EXPECT_THROW((void)signed_volumes(K, g), GeometryError);
}

TEST(Volumes, SquaredLengthsFollowTheOrderOfTheEdges) {
  const SimplicialComplex<2> K(SimplexList{{3, 1, 0}, {0, 1, 2}});
  const auto g = Geometry<2>::from_points(K, {0, 0, 3, 0, 0, 4, 1, -1}, 2);
  EXPECT_EQ(squared_lengths(K, g), (std::vector<double>{9, 16, 2, 25, 5}));  // (0,1) (0,2) (0,3) (1,2) (1,3)
  const SimplicialComplex<2> other(SimplexList{{0, 1, 2}});
  EXPECT_THROW((void)squared_lengths(other, g), InputError);
}

}  // namespace
}  // namespace derham
