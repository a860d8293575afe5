#include "derham/geometry/predicates.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace derham {
namespace {

template <int n>
using Corners = std::array<std::array<double, n>, n + 1>;

// Gaussian elimination in rationals: nothing in common with the expansion under test.
template <int n>
int rational_sign(const Corners<n>& p) {
  std::vector<std::vector<mpq_class>> a(n, std::vector<mpq_class>(n));
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) a[i][j] = mpq_class(p[i + 1][j]) - mpq_class(p[0][j]);
  int sign = 1;
  for (int c = 0; c < n; ++c) {
    int pivot = c;
    while (pivot < n && a[pivot][c] == 0) ++pivot;
    if (pivot == n) return 0;
    if (pivot != c) {
      std::swap(a[pivot], a[c]);
      sign = -sign;
    }
    sign *= sgn(a[c][c]);
    for (int i = c + 1; i < n; ++i) {
      const mpq_class factor = a[i][c] / a[c][c];
      for (int j = c; j < n; ++j) a[i][j] -= factor * a[c][j];
    }
  }
  return sign;
}

template <int n>
Sign sign_of(const Corners<n>& p) {
  std::array<const double*, n + 1> pointers;
  for (int i = 0; i <= n; ++i) pointers[i] = p[i].data();
  return orientation_sign<n>(pointers);
}

template <class T>
struct Predicates : testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                                  std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(Predicates, Dimensions);

TYPED_TEST(Predicates, UnitSimplexIsPositiveAndASwapReverses) {
  constexpr int n = TypeParam::value;
  Corners<n> p{};
  for (int i = 0; i < n; ++i) p[i + 1][i] = 1;
  EXPECT_EQ(sign_of<n>(p), 1);
  std::swap(p[0], p[n]);
  EXPECT_EQ(sign_of<n>(p), -1);
}

TYPED_TEST(Predicates, RandomPointsAgreeWithRationals) {
  constexpr int n = TypeParam::value;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 500; ++trial) {
    Corners<n> p;
    for (auto& point : p)
      for (double& x : point) x = uniform(random);
    EXPECT_EQ(sign_of<n>(p), rational_sign<n>(p));
  }
}

// The last point is an affine combination of the others, rounded, and then moved by at most one ulp per coordinate.
TYPED_TEST(Predicates, NearlyFlatSimplicesAgreeWithRationals) {
  constexpr int n = TypeParam::value;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::uniform_int_distribution<int> step(-1, 1), exponent(-30, 30);
  int decided_by_an_ulp = 0, flat = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    Corners<n> p;
    for (auto& point : p)
      for (double& x : point) x = std::ldexp(uniform(random), trial % 2 ? exponent(random) : 0);
    std::array<double, n> weight{};
    double sum = 0;
    for (int i = 1; i < n; ++i) sum += weight[i] = uniform(random);
    weight[0] = 1 - sum;
    for (int j = 0; j < n; ++j) {
      double x = 0;
      for (int i = 0; i < n; ++i) x += weight[i] * p[i][j];
      const int s = step(random);
      p[n][j] = s == 0 ? x : std::nextafter(x, s * std::numeric_limits<double>::infinity());
    }
    const int expected = rational_sign<n>(p);
    EXPECT_EQ(sign_of<n>(p), expected) << "trial " << trial;
    decided_by_an_ulp += expected != 0;
    flat += expected == 0;
  }
  EXPECT_GT(decided_by_an_ulp, 100);
  EXPECT_GT(flat, n == 1 ? 100 : -1);
}

TYPED_TEST(Predicates, ExactlyFlatIsZero) {
  constexpr int n = TypeParam::value;
  std::mt19937 random(3);
  std::uniform_int_distribution<int> integer(-1000, 1000);
  for (int trial = 0; trial < 200; ++trial) {
    Corners<n> p;
    for (auto& point : p)
      for (double& x : point) x = integer(random);
    const int a = integer(random);
    for (int j = 0; j < n; ++j) p[n][j] = n == 1 ? p[0][j] : p[0][j] + a * (p[n - 1][j] - p[0][j]);
    EXPECT_EQ(sign_of<n>(p), 0);
  }
}

// Overflow of products, of differences, and underflow of everything must not show.
TYPED_TEST(Predicates, ExtremeExponents) {
  constexpr int n = TypeParam::value;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::uniform_int_distribution<int> exponent(-1074, 1023);
  for (int trial = 0; trial < 300; ++trial) {
    Corners<n> p;
    const int common = exponent(random);
    for (auto& point : p)
      for (double& x : point) x = std::ldexp(uniform(random), trial % 2 ? exponent(random) : common);
    EXPECT_EQ(sign_of<n>(p), rational_sign<n>(p)) << "trial " << trial;
  }
  const double tiny = std::numeric_limits<double>::denorm_min(), huge = std::numeric_limits<double>::max();
  Corners<n> p{};
  for (int i = 0; i < n; ++i) p[i + 1][i] = tiny;
  EXPECT_EQ(sign_of<n>(p), 1);
  for (int i = 0; i < n; ++i) p[i + 1][i] = huge;
  EXPECT_EQ(sign_of<n>(p), 1);
  for (int i = 0; i < n; ++i) p[0][i] = -huge;
  EXPECT_EQ(sign_of<n>(p), rational_sign<n>(p));
}

}  // namespace
}  // namespace derham
