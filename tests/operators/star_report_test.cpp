#include "derham/operators/star_report.hpp"

#include "derham/core/error.hpp"
#include "derham/meshes/balls.hpp"
#include "derham/meshes/lattices.hpp"
#include "derham/operators/whitney_mass.hpp"
#include "operators/spaces.hpp"
#include "support/random_values.hpp"

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <string>

namespace derham {
namespace {

using test::Space;

template <class T>
struct StarReports : testing::Test {};
TYPED_TEST_SUITE(StarReports, test::Dimensions);

TYPED_TEST(StarReports, WellCenteredLatticesHaveNothingAgainstEitherStar) {
  constexpr int n = TypeParam::value;
  const Space<n> space(meshes::a_star_lattice(n, 3));
  const HodgeStar<n> star(space.K, space.g);
  for (int k = 0; k <= n; ++k) {
    const auto diagonal = star_report(star, space.g, k);
    EXPECT_EQ(diagonal.definiteness, Definiteness::positive);
    EXPECT_TRUE(diagonal.zero.empty() && diagonal.negative.empty() && diagonal.advice.empty());
    EXPECT_EQ(diagonal.smallest, std::ranges::min(star.diagonal(k)));
    EXPECT_EQ(diagonal.condition, std::ranges::max(star.diagonal(k)) / std::ranges::min(star.diagonal(k)));
    EXPECT_LT(diagonal.constant_error, 1e-12) << "no boundary: exact";
    const auto whitney = star_report(whitney_mass(space.K, space.g, k), space.K, space.g, k);
    EXPECT_EQ(whitney.definiteness, Definiteness::positive);
    EXPECT_LT(whitney.constant_error, 1e-12);
    EXPECT_TRUE(whitney.advice.empty());
  }
}

// From below, and sharp on a small mesh.
TYPED_TEST(StarReports, TheConditionOfTheWhitneyMassIsThatOfItsEigenvalues) {
  constexpr int n = TypeParam::value;
  const Space<n> space(test::random_mesh<n>(1, n < 3 ? 3 : 1));
  for (int k = 0; k <= n; ++k) {
    const auto M = whitney_mass(space.K, space.g, k);
    const Eigen::MatrixXd dense = M;
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense).eigenvalues();
    const double condition = values[values.size() - 1] / values[0];
    const auto report = star_report(M, space.K, space.g, k);
    EXPECT_LE(report.condition, condition * (1 + 1e-9));
    EXPECT_GE(report.condition, condition * 0.8);
  }
}

TEST(StarReports, NameZeroAndNegativeEntriesAndWhatToUseInstead) {
  const Space<3> kuhn(meshes::box(3, 4));
  const auto edges = star_report(HodgeStar<3>(kuhn.K, kuhn.g), kuhn.g, 1);
  EXPECT_EQ(edges.definiteness, Definiteness::not_positive);
  EXPECT_EQ(edges.zero.size(), 304U);
  EXPECT_TRUE(edges.negative.empty());
  EXPECT_TRUE(std::isinf(edges.condition));
  EXPECT_NE(edges.advice.find("304 dual volumes are zero"), std::string::npos) << edges.advice;
  EXPECT_NE(edges.advice.find("whitney_mass"), std::string::npos);
  const Space<2> kite(test::single({0, 0, 1, 0, 0.5, 0.1}, 2));
  const auto obtuse = star_report(HodgeStar<2>(kite.K, kite.g), kite.g, 1);
  EXPECT_EQ(obtuse.negative, (std::vector<Index>{0}));
  EXPECT_NE(obtuse.advice.find("1-simplex 0 = (0, 1)"), std::string::npos) << obtuse.advice;
  EXPECT_EQ(star_report(whitney_mass(kite.K, kite.g, 1), kite.K, kite.g, 1).definiteness, Definiteness::positive);
}

// The boundary of a solid: exact in the plane, not in space.
TEST(StarReports, MeasureConstantForms) {
  const Space<2> plane(meshes::box(2, 3, {.jitter = 0.2}));
  EXPECT_LT(star_report(HodgeStar<2>(plane.K, plane.g), plane.g, 1).constant_error, 1e-12);
  MeshData ball = meshes::ball(3, 2);
  for (std::size_t i = 0; i < ball.points.size(); i += 3) ball.points[i] += 0.5 * ball.points[i + 1];
  const Space<3> space(ball);
  EXPECT_GT(star_report(HodgeStar<3>(space.K, space.g), space.g, 1).constant_error, 1e-3);
  EXPECT_LT(star_report(whitney_mass(space.K, space.g, 1), space.K, space.g, 1).constant_error, 1e-12);
  const Space<2> raised(test::moved(meshes::box(2, 2), 3, 1, 1, 1));
  EXPECT_TRUE(std::isnan(star_report(HodgeStar<2>(raised.K, raised.g), raised.g, 1).constant_error));
}

// No boundary: exact for all weights. Cells that are not orthogonal to their simplices are not, and are warned about.
TYPED_TEST(StarReports, PowerStarsAreConsistentAndBarycentricOnesAreWarnedAbout) {
  constexpr int n = TypeParam::value;
  const Space<n> torus(meshes::periodic_box(n, 3, {.jitter = 0.4 / n}));
  auto weights = support::random_values(torus.K.size(0), 1);
  for (double& w : weights) w *= 0.01;
  const Material twice{.values = {2}};
  const HodgeStar<n> power(torus.K, torus.g, PowerCircumcentric{weights}, twice),
      barycentric(torus.K, torus.g, Barycentric{}), lumped(torus.K, torus.g, Lumped{});
  for (int k = 0; k <= n; ++k) {
    EXPECT_LT(star_report(power, torus.g, k).constant_error, 1e-12) << "with its material";
    const auto report = star_report(barycentric, torus.g, k);
    EXPECT_EQ(report.definiteness, Definiteness::positive);
    const bool ends = k == 0 || k == n;
    EXPECT_EQ(report.advice.find("not consistent") != std::string::npos, !ends) << report.advice;
    EXPECT_EQ(report.constant_error > 0.01, !ends) << report.constant_error;
    if (ends)
      EXPECT_LT(star_report(lumped, torus.g, k).constant_error, 1e-12);
    else
      EXPECT_THROW((void)star_report(lumped, torus.g, k), InputError);
  }
}

TEST(StarReports, DoNotCallIndefiniteMaterialsPositive) {
  const Space<2> space(meshes::box(2, 2));
  Material material{.values = std::vector<double>(8, 1.0)};
  material.values[3] = -50;
  const auto indefinite = star_report(whitney_mass(space.K, space.g, 1, material), space.K, space.g, 1, material);
  EXPECT_EQ(indefinite.definiteness, Definiteness::not_positive);
  EXPECT_FALSE(indefinite.advice.empty());
  material.values[3] = 0;
  const auto unknown = star_report(whitney_mass(space.K, space.g, 0, material), space.K, space.g, 0, material);
  EXPECT_NE(unknown.definiteness, Definiteness::positive);
  const Material tensor{.values = {1, 0, 0, -1}, .width = 2};
  EXPECT_NE(star_report(whitney_mass(space.K, space.g, 1, tensor), space.K, space.g, 1, tensor).definiteness,
            Definiteness::positive);
}

TEST(StarReports, BlameTheMaterialWhereItIsNotPositive) {
  const Space<2> space(meshes::box(2, 2));
  for (const double number : {-1.0, 0.0}) {
    const HodgeStar<2> star(space.K, space.g, Circumcentric{}, {.values = {number}});
    const auto report = star_report(star, space.g, 0);
    EXPECT_EQ(report.definiteness, Definiteness::not_positive);
    EXPECT_NE(report.advice.find("the material is not positive"), std::string::npos) << report.advice;
  }
}

// Triangles that halve thirty times: rounding in Lanczos' method must not make a positive mass look otherwise.
TEST(StarReports, OfGradedMeshesAreNotFooledByRounding) {
  MeshData strip;
  strip.ambient_dimension = 2;
  std::vector<Index> rows;
  double x = 0, step = 1;
  for (Index i = 0; i < 30; ++i, x += step, step /= 2) {
    strip.points.insert(strip.points.end(), {x, 0.0, x, step});
    if (i < 29) rows.insert(rows.end(), {2 * i, 2 * i + 2, 2 * i + 1, 2 * i + 1, 2 * i + 2, 2 * i + 3});
  }
  strip.vertex_count = 60;
  strip.simplices = SimplexList(2, rows);
  const Space<2> space(strip);
  for (int k = 0; k <= 2; ++k) {
    const auto M = whitney_mass(space.K, space.g, k);
    const auto report = star_report(M, space.K, space.g, k);
    EXPECT_EQ(report.definiteness, Definiteness::positive) << k;
    EXPECT_GE(report.condition, (1 - 1e-12) * report.largest / report.smallest) << k;
    EXPECT_EQ(report.advice.find("material"), std::string::npos) << report.advice;
    if (k == 2) {  // diagonal
      EXPECT_NEAR(report.condition * report.smallest / report.largest, 1, 1e-12);
    }
  }
}

TEST(StarReports, OfTheEmptyComplexAreEmpty) {
  const SimplicialComplex<2> K(SimplexList(2, {}));
  const auto g = Geometry<2>::from_points(K, {}, 2);
  const auto report = star_report(HodgeStar<2>(K, g), g, 1);
  EXPECT_TRUE(std::isinf(report.condition));
  EXPECT_TRUE(report.advice.empty());
}

TEST(StarReports, RefuseWhatDoesNotFit) {
  const Space<2> space(meshes::box(2, 2)), other(meshes::box(2, 3));
  const HodgeStar<2> star(space.K, space.g);
  EXPECT_THROW((void)star_report(star, space.g, 3), InputError);
  EXPECT_THROW((void)star_report(star, other.g, 1), InputError);
  EXPECT_THROW((void)star_report(whitney_mass(space.K, space.g, 1), space.K, space.g, 0), InputError);
}

}  // namespace
}  // namespace derham
