#include "derham/complex/simplicial_complex.hpp"
#include "derham/forms/exterior_derivative.hpp"
#include "derham/geometry/volumes.hpp"
#include "derham/meshes/boxes.hpp"
#include "geometry/mesh_kit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>
#include <vector>

namespace derham {
namespace {

// By Laplace's expansion; a is row-major.
double determinant(const std::vector<double>& a, int size) {
  if (size == 0) return 1;
  double sum = 0;
  for (int column = 0; column < size; ++column) {
    std::vector<double> minor;
    for (int i = 1; i < size; ++i)
      for (int j = 0; j < size; ++j)
        if (j != column) minor.push_back(a[static_cast<std::size_t>(i * size + j)]);
    sum += (column % 2 == 0 ? 1 : -1) * a[static_cast<std::size_t>(column)] * determinant(minor, size - 1);
  }
  return sum;
}

// Flux of a field with the value `field` at the barycentre, exact for linear fields: the integral over the facet of
// i_X dx^1…dx^n, which is det(X, edges)/(n-1)!.
double flux(const std::vector<double>& field, const std::vector<double>& corners, int n) {
  std::vector<double> rows = field;
  double factorial = 1;
  for (int i = 1; i < n; ++i) {
    factorial *= i;
    for (int c = 0; c < n; ++c)
      rows.push_back(corners[static_cast<std::size_t>(i * n + c)] - corners[static_cast<std::size_t>(c)]);
  }
  return determinant(rows, n) / factorial;
}

template <class T>
struct Flux : testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                                  std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(Flux, Dimensions);

// Stokes' theorem with div(x/n) = 1 and div(const) = 0: the values on t, as oriented, are its volume and 0.
TYPED_TEST(Flux, ThroughTheFacetsOfEverySimplexIsItsVolume) {
  constexpr int n = TypeParam::value;
  for (const std::uint32_t seed : {1, 2, 3}) {
    std::vector<Index> id;
    const MeshData mesh = test::shuffled(meshes::box(n, n < 4 ? 3 : 2, {.jitter = 0.4 / n, .seed = seed}), seed, id);
    SimplicialComplex<n> K(mesh.simplices);
    const auto g = Geometry<n>::from_mesh(K, mesh);
    orient_by_volume(K, g);
    PrimalForm<n, n - 1> radial(K), constant(K);
    for (Index f = 0; f < K.size(n - 1); ++f) {
      const auto corners = g.simplex_corners(K, n - 1, f);
      std::vector<double> position(n, 0.0), direction;
      for (std::size_t i = 0; i < corners.size(); ++i) position[i % n] += corners[i] / n / n;
      for (int c = 0; c < n; ++c) direction.push_back(1.5 - c);
      radial[f] = flux(position, corners, n);
      constant[f] = flux(direction, corners, n);
    }
    const auto volumes = primal_volumes(K, g)[n];
    const auto divergence = d(radial), nothing = d(constant);
    for (Index t = 0; t < K.size(n); ++t) {
      EXPECT_GT(volumes[static_cast<std::size_t>(t)], 1e-6);
      EXPECT_NEAR(divergence[t], volumes[static_cast<std::size_t>(t)], 1e-14) << seed << ' ' << t;
      EXPECT_NEAR(nothing[t], 0, 1e-14) << seed << ' ' << t;
    }
  }
}

}  // namespace
}  // namespace derham
