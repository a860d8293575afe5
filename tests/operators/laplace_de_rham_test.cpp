#include "derham/operators/laplace_de_rham.hpp"

#include "derham/forms/dual_wedge.hpp"
#include "derham/hodge/laplacian.hpp"
#include "derham/operators/vector_calculus.hpp"
#include "operators/spaces.hpp"
#include "support/random_forms.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace derham {
namespace {

using support::distance;
using support::random_form;
using test::for_each_degree;
using test::for_each_space_of;
using test::Space;

template <class T>
struct LaplaceDeRham : testing::Test {};
TYPED_TEST_SUITE(LaplaceDeRham, test::Dimensions);

/// ⟨a, b⟩ = Σ ⋆_i a_i b_i, on dual forms Σ a_i b_i / ⋆_i: straight from the diagonal.
template <int n, int k, Side side>
double product(const HodgeStar<n>& star, const Form<n, k, side>& a, const Form<n, k, side>& b) {
  const auto diagonal = star.diagonal(Form<n, k, side>::simplex_degree);
  double sum = 0;
  for (Index i = 0; i < a.size(); ++i) {
    const double entry = diagonal[static_cast<std::size_t>(i)];
    sum += a[i] * b[i] * (side == Side::primal ? entry : 1 / entry);
  }
  return sum;
}

template <int n, int k, Side side>
double norm(const HodgeStar<n>& star, const Form<n, k, side>& a) {
  const auto diagonal = star.diagonal(Form<n, k, side>::simplex_degree);
  double sum = 0;
  for (Index i = 0; i < a.size(); ++i) {
    const double entry = std::abs(diagonal[static_cast<std::size_t>(i)]);
    sum += a[i] * a[i] * (side == Side::primal ? entry : 1 / entry);
  }
  return std::sqrt(sum);
}

/// To round-off of sums of |a_i b_i|, where dual volumes are near zero and stars have either sign.
template <int n, int k, Side side>
double scale(const HodgeStar<n>& star, const Form<n, k, side>& a, const Form<n, k, side>& b) {
  return 1e-12 * norm(star, a) * norm(star, b);
}

TYPED_TEST(LaplaceDeRham, CodifferentialIsAdjointToDOnEveryMesh) {
  constexpr int n = TypeParam::value;
  for_each_space_of<n>(test::generic_mesh<n>(1), [](const Space<n>& space) {
    const HodgeStar<n> star(space.K, space.g);
    for_each_degree<n - 1>([&]<int k>() {
      const auto a = random_form<n, k>(space.K, 1);
      const auto b = random_form<n, k + 1>(space.K, 2);
      const auto db = codifferential(star, b);
      EXPECT_NEAR(product(star, d(a), b), product(star, a, db), scale(star, d(a), b) + scale(star, a, db))
          << "degree " << k;
    });
  });
}

TYPED_TEST(LaplaceDeRham, CodifferentialOfDualFormsIsAdjointToDualD) {
  constexpr int n = TypeParam::value;
  for_each_space_of<n>(test::generic_mesh<n>(1), [](const Space<n>& space) {
    const HodgeStar<n> star(space.K, space.g);
    for_each_degree<n - 1>([&]<int k>() {
      const auto a = random_form<n, k, Side::dual>(space.K, 1);
      const auto b = random_form<n, k + 1, Side::dual>(space.K, 2);
      const auto db = codifferential(star, b);
      EXPECT_NEAR(product(star, d(a), b), product(star, a, db), scale(star, d(a), b) + scale(star, a, db))
          << "degree " << k;
    });
  });
}

TYPED_TEST(LaplaceDeRham, IsSelfAdjointOnEveryMeshAndBoundsItsEnergy) {
  constexpr int n = TypeParam::value;
  for_each_space_of<n>(test::generic_mesh<n>(1), [](const Space<n>& space) {
    const HodgeStar<n> star(space.K, space.g);
    for_each_degree<n>([&]<int k>() {
      const auto a = random_form<n, k>(space.K, 1), b = random_form<n, k>(space.K, 2);
      const auto La = laplace_de_rham(star, a), Lb = laplace_de_rham(star, b);
      const double tolerance = 100 * (scale(star, La, b) + scale(star, a, Lb));
      EXPECT_NEAR(product(star, La, b), product(star, a, Lb), tolerance) << "degree " << k;
      double energy = 0;
      if constexpr (k < n) energy += product(star, d(a), d(a));
      if constexpr (k > 0) energy += product(star, codifferential(star, a), codifferential(star, a));
      EXPECT_NEAR(product(star, La, a), energy, 100 * scale(star, La, a)) << "degree " << k;
    });
  });
}

/// ⋆Δ = Δ⋆: the Laplacian of dual forms is that of primal ones.
TYPED_TEST(LaplaceDeRham, CommutesWithTheStar) {
  constexpr int n = TypeParam::value;
  const Space<n> space(test::generic_mesh<n>(2));
  const HodgeStar<n> star(space.K, space.g);
  for_each_degree<n>([&]<int k>() {
    const auto a = random_form<n, k>(space.K, 1);
    const auto primal = star(laplace_de_rham(star, a)), dual = laplace_de_rham(star, star(a));
    EXPECT_LT(norm(star, primal - dual), 1e-9 * norm(star, primal)) << "degree " << k;
    const auto twice = star(star(a));
    EXPECT_LT(distance(twice, (k * (n - k) % 2 == 0 ? 1.0 : -1.0) * a), 1e-14) << "degree " << k;
  });
  const auto u = random_form<n, 0>(space.K, 3);
  const auto expected = laplacian(star, u);
  EXPECT_LT(norm(star, laplace_de_rham(star, u) - expected), 1e-12 * norm(star, expected));
}

TEST(VectorCalculus, HasTheLawsOfItsNames) {
  const Space<3> space(test::generic_mesh<3>(5));
  const HodgeStar<3> star(space.K, space.g);
  const auto u = support::random_integer_form<3, 0>(space.K, 1);
  const auto v = support::random_integer_form<3, 1>(space.K, 2);
  EXPECT_EQ(curl(grad(u)), (PrimalForm<3, 2>(space.K)));
  EXPECT_EQ(div(curl(v)), (PrimalForm<3, 3>(space.K)));
  const auto w = random_form<3, 2>(space.K, 3);
  const auto q = random_form<3, 3>(space.K, 4);
  const auto near = [&](double x, double y) { EXPECT_NEAR(x, y, 1e-9 * (std::abs(x) + std::abs(y))); };
  near(product(star, grad(u), v), -product(star, u, div(star, v)));
  near(product(star, curl(v), w), product(star, v, curl(star, w)));
  near(product(star, div(w), q), -product(star, w, grad(star, q)));
}

TEST(VectorCalculus, InThePlaneOnBothSides) {
  const Space<2> space(test::generic_mesh<2>(5));
  const HodgeStar<2> star(space.K, space.g);
  const auto u = support::random_integer_form<2, 0, Side::dual>(space.K, 1);
  EXPECT_EQ(curl(grad(u)), (DualForm<2, 2>(space.K)));
  const auto v = random_form<2, 1>(space.K, 2);
  EXPECT_EQ(div(v), d(v));
  const auto w = random_form<2, 0>(space.K, 3);
  EXPECT_NEAR(product(star, grad(w), v), -product(star, w, div(star, v)), 1e-10 * norm(star, grad(w)) * norm(star, v));
}

}  // namespace
}  // namespace derham
