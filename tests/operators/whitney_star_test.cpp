#include "derham/operators/whitney_star.hpp"

#include "derham/core/error.hpp"
#include "derham/forms/dual_wedge.hpp"
#include "derham/meshes/lattices.hpp"
#include "derham/operators/expression.hpp"
#include "operators/own_matrix.hpp"
#include "operators/spaces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace derham {
namespace {

using test::Space;

template <class T>
struct WhitneyStars : testing::Test {};
TYPED_TEST_SUITE(WhitneyStars, test::Dimensions);

TYPED_TEST(WhitneyStars, TheStarTwiceIsASignAndTheInverseUndoesIt) {
  constexpr int n = TypeParam::value;
  const Space<n> space(test::random_mesh<n>(1, 2));
  const Material material{.values = {3}};
  test::for_each_degree<n>([&]<int k>() {
    const WhitneyStar<n, k> star(space.K, space.g, material);
    const auto w = test::random_values_on<n, k>(space.K, 1);
    const auto image = star(w);
    const auto back = star.inverse(image), twice = star(image);
    const Eigen::VectorXd expected =
        whitney_mass(space.K, space.g, k, material) * Eigen::Map<const Eigen::VectorXd>(w.values().data(), w.size());
    for (Index i = 0; i < w.size(); ++i) {
      EXPECT_NEAR(image[i], expected[i], 1e-13);
      EXPECT_NEAR(back[i], w[i], 1e-10);
      EXPECT_NEAR(twice[i], (k * (n - k) % 2 == 0 ? 1 : -1) * w[i], 1e-10);
    }
  });
}

/// Δ_0 = ⋆_0⁻¹ d_0ᵀ ⋆_1 d_0 with Whitney stars, as an expression: symmetric in ⟨,⟩, never negative, zero on constants.
TYPED_TEST(WhitneyStars, ArePartsOfExpressions) {
  constexpr int n = TypeParam::value;
  const Space<n> space(test::random_mesh<n>(1, n < 4 ? 2 : 1));
  const Derivative<n> d(space.K);
  test::for_each_degree<n>([&]<int k>() {
    const WhitneyStar<n, k> star(space.K, space.g);
    const Operator<PrimalForm<n, k>, DualForm<n, n - k>> down = star;
    test::expect_own_matrix(down);
    const Operator<DualForm<n, n - k>, PrimalForm<n, k>> up = star;
    test::expect_own_matrix(up);
    const auto w = test::random_values_on<n, k>(space.K, 1);
    EXPECT_EQ(down(w), star(w));
    EXPECT_EQ(up(down(w)), star(star(w)));
  });
  const WhitneyStar<n, 0> star_0(space.K, space.g);
  const WhitneyStar<n, 1> star_1(space.K, space.g);
  using Functions = PrimalForm<n, 0>;
  const Operator<Functions, Functions> laplacian = -(star_0 * d * star_1 * d);
  const Operator<Functions, DualForm<n, n>> weak = star_0 * laplacian;
  const auto f = test::random_values_on<n, 0>(space.K, 2), g = test::random_values_on<n, 0>(space.K, 3);
  EXPECT_NEAR(pair(f, weak(g)), pair(g, weak(f)), 1e-11);
  EXPECT_NEAR(pair(f, weak(f)), pair(d(f), star_1(d(f))), 1e-11);
  EXPECT_GT(pair(f, weak(f)), 0.1);
  Functions ones(space.K);
  for (double& value : ones.values()) value = 1;
  EXPECT_LT(support::distance(laplacian(ones), Functions(space.K)), 1e-10);
}

TYPED_TEST(WhitneyStars, SeveralColumnsAreTheSameAsOneByOne) {
  constexpr int n = TypeParam::value;
  const Space<n> space(test::random_mesh<n>(2, 2));
  const MassInverse mass(whitney_mass(space.K, space.g, 1));
  const auto rows = static_cast<std::size_t>(space.K.size(1));
  const auto x = support::random_values(3 * static_cast<Index>(rows), 1);
  auto y = x;
  mass.apply_inverse(y, y, 3);
  std::vector<double> one(rows);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < rows; ++i) one[i] = x[3 * i + c];
    mass.apply_inverse(one, one);
    for (std::size_t i = 0; i < rows; ++i) EXPECT_NEAR(y[3 * i + c], one[i], 1e-12 * std::abs(one[i]) + 1e-12);
  }
  mass.apply(y, y, 3);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(y[i], x[i], 1e-10);
}

TEST(WhitneyStar, RefusesWhatHasNoInverse) {
  const Space<2> space(meshes::box(2, 2)), other(meshes::box(2, 2));
  EXPECT_THROW((WhitneyStar<2, 1>(space.K, space.g, Material{.values = {-1}})), GeometryError);
  EXPECT_THROW((WhitneyStar<2, 0>(space.K, space.g, Material{.values = {0}})), GeometryError);
  try {
    const WhitneyStar<2, 1> none(space.K, space.g, Material{.values = {2, -3}, .row_of = {0, 0, 0, 0, 0, 1, 0, 0}});
    ADD_FAILURE() << "a negative material";
  } catch (const GeometryError& error) {
    EXPECT_NE(std::string(error.what()).find("2-simplex 5 = ("), std::string::npos) << error.what();
  }
  const WhitneyStar<2, 1> star(space.K, space.g);
  EXPECT_THROW((void)star(PrimalForm<2, 1>(other.K)), InputError);
  std::vector<double> x(3);
  EXPECT_THROW(star.mass().apply(x, x), InputError);
  EXPECT_THROW(star.mass().apply_inverse(x, x, 0), InputError);
  EXPECT_THROW(MassInverse(Eigen::SparseMatrix<double, Eigen::RowMajor>(2, 3)), InputError);
  const SimplicialComplex<2> band(SimplexList{{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 0}, {4, 0, 1}});
  const auto g = Geometry<2>::from_squared_lengths(band, std::vector<double>(10, 1.0));
  EXPECT_THROW((WhitneyStar<2, 1>(band, g)), TopologyError);
  const SimplicialComplex<2> empty;
  const WhitneyStar<2, 1> none(empty, Geometry<2>::from_points(empty, {}, 2));
  EXPECT_EQ(none.inverse(none(PrimalForm<2, 1>(empty))).size(), 0);
}

}  // namespace
}  // namespace derham
