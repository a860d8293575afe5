#include "derham/geometry/simplex_inequalities.hpp"

#include "derham/core/error.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/geometry/volumes.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/classics.hpp"
#include "geometry/mesh_kit.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <type_traits>
#include <vector>

namespace derham {
namespace {

template <class T>
struct SimplexInequalities : testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                                  std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(SimplexInequalities, Dimensions);

TYPED_TEST(SimplexInequalities, HoldForPointsInSpace) {
  constexpr int n = TypeParam::value;
  const MeshData mesh = test::moved(meshes::box(n, 2, {.jitter = 0.3 / n}), n + 2, 3, 1, 1);
  const SimplicialComplex<n> K(mesh.simplices);
  EXPECT_TRUE(impossible_simplices(K, squared_lengths(K, Geometry<n>::from_mesh(K, mesh))).empty());
}

/// Vertex k has the same distance from k vertices with all distances 1, whose squared circumradius is (k-1)/(2k): too small
/// a one by 0.01 of its square. Its faces have smaller radii, and the vertices after it are far away.
TYPED_TEST(SimplexInequalities, NameTheLowestDegreeThatFails) {
  constexpr int n = TypeParam::value;
  std::vector<Index> row;
  for (Index v = 0; v <= n; ++v) row.push_back(v);
  const SimplicialComplex<n> K(SimplexList(n, row));
  for (int k = 2; k <= n; ++k) {
    const double squared_radius = (k - 1) / (2.0 * k), last = squared_radius - 0.01;
    std::vector<double> squares;
    for (Index e = 0; e < K.size(1); ++e) {
      const Index b = K.simplex(1, e)[1];
      squares.push_back(b < k ? 1 : b == k ? last : 100);
    }
    const auto found = impossible_simplices(K, squares);
    ASSERT_EQ(found.size(), 1U) << "degree " << k;
    EXPECT_EQ(found[0].degree, k);
    EXPECT_EQ(K.simplex(k, found[0].index).back(), k);
    EXPECT_NEAR(found[0].squared_altitude, -0.01, 1e-12);
    EXPECT_THROW((void)Geometry<n>::from_squared_lengths(K, squares), GeometryError);
    for (double& s : squares)
      if (s == last) s = squared_radius + 1e-3;
    EXPECT_TRUE(impossible_simplices(K, squares).empty());
    EXPECT_NO_THROW((void)Geometry<n>::from_squared_lengths(K, squares));
  }
}

std::string complaint(const SimplicialComplex<2>& K, const std::vector<double>& squares) {
  try {
    require_simplex_inequalities(K, squares);
  } catch (const GeometryError& error) {
    return error.what();
  }
  return "";
}

TEST(SimplexInequality, AllAreListedAndTheFirstIsExplained) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}, {1, 2, 3}, {2, 3, 4}});  // edges 01 02 12 13 23 24 34
  const std::vector<double> squares{1, 16, 1, 1, 1, 1, 9};
  const auto found = impossible_simplices(K, squares);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].index, 0);
  EXPECT_EQ(found[1].index, 2);
  EXPECT_EQ(
      complaint(K, squares),
      "no Euclidean simplex has the edge lengths of 2-simplex 0 = (0, 1, 2): its edge (0, 2) is longer than the two "
      "others together, by 2; shorten it or lengthen these (and 1 more simplex violates the simplex inequalities; "
      "impossible_simplices lists them)");
  EXPECT_EQ(complaint(K, {1, 1, 1, 1, 1, 1, 1}), "");
}

TEST(SimplexInequality, EdgesAreSimplices) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto found = impossible_simplices(K, std::vector<double>{1, 0, nan});
  ASSERT_EQ(found.size(), 2U);  // and not the triangle
  EXPECT_EQ(found[0].degree, 1);
  EXPECT_EQ(found[0].index, 1);
  EXPECT_EQ(found[1].index, 2);
  EXPECT_THROW((void)impossible_simplices(K, std::vector<double>(2, 1.0)), InputError);
}

}  // namespace
}  // namespace derham
