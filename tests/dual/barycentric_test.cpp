#include "derham/dual/circumcentric.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/polytopes.hpp"

#include <gtest/gtest.h>

namespace derham {
namespace {

template <class T>
struct Barycentric : testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                                  std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(Barycentric, Dimensions);

TYPED_TEST(Barycentric, VerticesGetEqualSharesAndTheIdentityHoldsAtTheEnds) {
  constexpr int n = TypeParam::value;
  const MeshData mesh = meshes::box(n, 2, {.jitter = 0.3});
  const SimplicialComplex<n> K(mesh.simplices);
  const auto g = Geometry<n>::from_mesh(K, mesh);
  const auto dual = barycentric_dual_volumes(K, g), primal = primal_volumes(K, g);
  std::vector<double> expected(dual[0].size());
  for (Index t = 0; t < K.size(n); ++t)
    for (const Index v : K.simplex(n, t)) expected[v] += primal[n][t] / (n + 1);
  for (Index v = 0; v < K.size(0); ++v) EXPECT_NEAR(dual[0][v], expected[v], 1e-13);
  for (const double one : dual[n]) EXPECT_EQ(one, 1);
}

// In a regular simplex barycentre and circumcentre coincide.
TYPED_TEST(Barycentric, RegularSimplexHasTheCircumcentricVolumes) {
  constexpr int n = TypeParam::value;
  const MeshData mesh = meshes::regular_simplex(n);
  const SimplicialComplex<n> K(mesh.simplices);
  const auto g = Geometry<n>::from_mesh(K, mesh);
  const auto a = barycentric_dual_volumes(K, g), b = dual_volumes(K, g);
  for (int k = 0; k <= n; ++k)
    for (Index i = 0; i < K.size(k); ++i) EXPECT_NEAR(a[k][i], b[k][i], 1e-13);
}

}  // namespace
}  // namespace derham
