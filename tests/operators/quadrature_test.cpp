#include "derham/operators/quadrature.hpp"

#include "derham/core/error.hpp"
#include "derham/core/types.hpp"
#include "operators/polynomial.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>

namespace derham {
namespace {

/// The mean of λ^e over a k-simplex: k! Π e_i! / (k + Σ e_i)!.
double mean_of(const std::vector<int>& exponents) {
  double logarithm = std::lgamma(static_cast<double>(exponents.size()));
  int sum = static_cast<int>(exponents.size()) - 1;
  for (const int e : exponents) {
    logarithm += std::lgamma(e + 1.0);
    sum += e;
  }
  return std::exp(logarithm - std::lgamma(sum + 1.0));
}

template <int k>
double mean_by(const SimplexRule<k>& rule, const std::vector<int>& exponents) {
  double mean = 0;
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    double value = rule.weights[q];
    for (std::size_t v = 0; v <= k; ++v) value *= std::pow(rule.points[q][v], exponents[v]);
    mean += value;
  }
  return mean;
}

template <class T>
struct Quadrature : testing::Test {};
using Degrees =
    testing::Types<std::integral_constant<int, 0>, std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                   std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(Quadrature, Degrees);

TYPED_TEST(Quadrature, IsExactOnMonomialsInBarycentricCoordinatesUpToItsOrder) {
  constexpr int k = TypeParam::value;
  for (int order = 0; order <= (k <= 2 ? 15 : 9); ++order) {
    const auto rule = simplex_rule<k>(order);
    test::for_each_monomial(k + 1, order, [&](const std::vector<int>& exponents) {
      const double exact = mean_of(exponents);
      EXPECT_NEAR(mean_by(rule, exponents), exact, 1e-13 * exact) << "order " << order;
    });
  }
}

TYPED_TEST(Quadrature, HasPositiveWeightsAndPointsInside) {
  constexpr int k = TypeParam::value;
  for (const int order : {0, 1, 2, 7, 20}) {
    const auto rule = simplex_rule<k>(order);
    double sum = 0;
    std::size_t count = 1;
    for (int i = 0; i < k; ++i) count *= static_cast<std::size_t>(order) / 2 + 1;
    EXPECT_EQ(rule.points.size(), count);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      EXPECT_GT(rule.weights[q], 0);
      sum += rule.weights[q];
      double total = 0;
      for (const double x : rule.points[q]) {
        EXPECT_GT(x, 0);
        total += x;
      }
      EXPECT_NEAR(total, 1, 1e-15 * (k + 1));
    }
    EXPECT_NEAR(sum, 1, 1e-13);
  }
}

TEST(Quadrature, IsNotExactOneDegreeAboveAnOddOrder) {
  for (const int order : {1, 3, 5}) {
    const std::vector<int> exponents{0, order + 1};
    EXPECT_GT(std::abs(mean_by(simplex_rule<1>(order), exponents) - mean_of(exponents)), 1e-5);
  }
}

// Legendre's rule of three points, known since Gauss.
TEST(Quadrature, KnowsGaussOfThreePoints) {
  const GaussRule rule = gauss_jacobi(3, 0);
  EXPECT_NEAR(rule.nodes[0], (1 - std::sqrt(0.6)) / 2, 1e-15);
  EXPECT_NEAR(rule.nodes[1], 0.5, 1e-15);
  EXPECT_NEAR(rule.weights[0], 5.0 / 18, 1e-15);
  EXPECT_NEAR(rule.weights[1], 8.0 / 18, 1e-15);
}

TEST(Quadrature, OfHighOrderStaysAccurate) {
  for (const int a : {0, 1, 2, 3}) {
    const GaussRule rule = gauss_jacobi(100, a);
    double mean = 0;  // of e^(x-1) for the weight (a+1)(1-x)^a: integrate by parts a times
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) mean += rule.weights[i] * std::exp(rule.nodes[i] - 1);
    double exact = 1 - std::exp(-1.0);
    for (int j = 1; j <= a; ++j) exact = (j + 1) * (exact - std::exp(-1.0));
    EXPECT_NEAR(mean, exact, 1e-13) << a;
  }
}

TEST(Quadrature, RefusesWhatIsNotThere) {
  EXPECT_THROW((void)simplex_rule<2>(-1), InputError);
  EXPECT_THROW((void)simplex_rule<4>(200), LimitError);
  EXPECT_THROW((void)gauss_jacobi(0, 0), InputError);
  EXPECT_THROW((void)gauss_jacobi(1, -1), InputError);
}

}  // namespace
}  // namespace derham
