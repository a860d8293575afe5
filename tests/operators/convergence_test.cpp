// The orders of convergence that docs/operators/convergence.md states. The orders are those of the last halving of the cells.
#include "examples/convergence_studies.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>
#include <utility>

namespace derham::studies {
namespace {

double order(double coarse, double fine) { return std::log2(coarse / fine); }

template <int n>
constexpr Index half = n == 2 ? 16 : 6;  // cells of the coarser mesh

template <class T>
struct Convergence : testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Convergence, Dimensions);

TYPED_TEST(Convergence, PoissonIsOfSecondOrderWithCircumcentricAndWhitneyStars) {
  constexpr int n = TypeParam::value;
  for (const Family family : {Family::cut_cubes, Family::delaunay})
    for (const Star star : {Star::circumcentric, Star::whitney}) {
      const auto coarse = poisson<n>(family, star, half<n>), fine = poisson<n>(family, star, 2 * half<n>);
      EXPECT_NEAR(order(coarse.l2, fine.l2), 2, 0.2);
      EXPECT_NEAR(order(coarse.max, fine.max), 2, 0.35);
      EXPECT_NEAR(order(coarse.grad, fine.grad), 1, 0.1);
    }
}

TYPED_TEST(Convergence, PoissonStallsWithABarycentricDiagonal) {
  constexpr int n = TypeParam::value;
  const auto coarse = poisson<n>(Family::cut_cubes, Star::barycentric, half<n>),
             fine = poisson<n>(Family::cut_cubes, Star::barycentric, 2 * half<n>);
  EXPECT_LT(order(coarse.l2, fine.l2), 0.2);
  EXPECT_GT(fine.l2, 0.03);
}

TYPED_TEST(Convergence, PoissonMeshesAreWhatTheyAreCalled) {
  constexpr int n = TypeParam::value;
  const auto smallest = [](Family family) {
    const Space<n> space(poisson_mesh<n>(family, 8));
    const auto star = HodgeStar<n>(space.K, space.g);
    return std::ranges::min(star.diagonal(1));
  };
  EXPECT_LT(smallest(Family::cut_cubes), 0);
  EXPECT_GT(smallest(Family::delaunay), 0);
}

template <int n, class Body, int... k>
void for_each_degree(Body&& body, std::integer_sequence<int, k...>) {
  (body.template operator()<k>(), ...);
}

template <int n>
void expect_interpolation(Index cells) {
  for_each_degree<n>(
      [cells]<int k>() {
        EXPECT_NEAR(order(interpolation<n, k>(cells), interpolation<n, k>(2 * cells)), k == 0 ? 2 : 1, 0.1)
            << "n = " << n << ", k = " << k;
      },
      std::make_integer_sequence<int, n + 1>());
}

TEST(Interpolation, IsOfSecondOrderForFunctionsAndOfFirstForOtherForms) {
  expect_interpolation<1>(64);
  expect_interpolation<2>(16);
  expect_interpolation<3>(6);
}

template <int n>
void expect_transport(Index cells) {
  for_each_degree<n>(
      [cells]<int k>() {
        const auto coarse = transport<n, k>(cells), fine = transport<n, k>(2 * cells);
        EXPECT_NEAR(order(coarse.error, fine.error), 1, 0.25) << "n = " << n << ", k = " << k;
        EXPECT_NEAR(order(coarse.cfl_bound, fine.cfl_bound), 1, 0.3);
        EXPECT_LT(fine.lost, 1e-13);
      },
      std::make_integer_sequence<int, n + 1>());
}

TEST(Transport, IsOfFirstOrderAndConservesIntegrals) {
  expect_transport<1>(16);
  expect_transport<2>(12);
  expect_transport<3>(4);
}

}  // namespace
}  // namespace derham::studies
