#include "derham/operators/wedge_operator.hpp"

#include "derham/meshes/lattices.hpp"
#include "operators/own_matrix.hpp"
#include "operators/spaces.hpp"
#include "support/random_forms.hpp"

#include <gtest/gtest.h>

namespace derham {
namespace {

using support::distance;
using support::random_complex;
using support::random_form;
using test::expect_own_matrix;
using test::for_each_degree;
using test::Space;

template <class T>
struct WedgeOperators : testing::Test {};
TYPED_TEST_SUITE(WedgeOperators, test::Dimensions);

/// Its matrix, and its values beside those of the product.
template <int n, int p, Side side, class B, class Product>
void expect_product(const SimplicialComplex<n>& K, const B& b, Product&& product) {
  using F = Form<n, p, side>;
  const auto a = random_form<n, p, side>(K, 7);
  const auto expected = product(a, b);
  const Operator<F, std::decay_t<decltype(expected)>> A = WedgeWith(b);
  expect_own_matrix(A);
  EXPECT_LT(distance(A(a), expected), 1e-14) << p << "-forms";
  EXPECT_EQ(WedgeWith(b)(a), expected);
}

const auto in_order = [](const auto& a, const auto& b) { return wedge(a, b); };
const auto reversed = [](const auto& a, const auto& b) { return wedge(b, a); };

TYPED_TEST(WedgeOperators, OfPrimalForms) {
  constexpr int n = TypeParam::value;
  for (const std::uint64_t seed : {1, 2, 4}) {
    const auto K = random_complex<n>(seed);
    for_each_degree<n>([&]<int p>() {
      for_each_degree<n - p>(
          [&]<int q>() { expect_product<n, p, Side::primal>(K, random_form<n, q>(K, 2), in_order); });
    });
  }
}

TYPED_TEST(WedgeOperators, OfFunctionsAndDualForms) {
  constexpr int n = TypeParam::value;
  const Space<n> space(test::generic_mesh<n>(1, 2));
  const auto& K = space.K;
  const auto f = random_form<n, 0>(K, 1);
  const auto g = random_form<n, 0, Side::dual>(K, 2);
  for_each_degree<n>([&]<int q>() {
    const auto primal = random_form<n, q>(K, 3);
    const auto dual = random_form<n, q, Side::dual>(K, 4);
    expect_product<n, 0, Side::primal>(K, dual, in_order);
    expect_product<n, 0, Side::dual>(K, dual, in_order);
    expect_product<n, 0, Side::dual>(K, primal, in_order);
    if constexpr (q > 0) {
      expect_product<n, q, Side::dual>(K, f, reversed);
      expect_product<n, q, Side::dual>(K, g, reversed);
      expect_product<n, q, Side::primal>(K, g, reversed);
    }
  });
}

TEST(WedgeOperatorsOnSurfaces, OfDualOneForms) {
  const Space<2> space(test::generic_mesh<2>(3, 4));
  expect_product<2, 1, Side::dual>(space.K, random_form<2, 1, Side::dual>(space.K, 1), in_order);
}

TEST(WedgeOperatorsOfDualFunctions, NeedAPureComplexAlsoAsMatrices) {
  const SimplicialComplex<2> mixed(SimplexList{{0, 1, 2}, {2, 3}});
  const Operator<DualForm<2, 0>, PrimalForm<2, 1>> A = WedgeWith(PrimalForm<2, 1>(mixed));
  EXPECT_THROW((void)A(DualForm<2, 0>(mixed)), TopologyError);
  EXPECT_THROW((void)A.matrix(), TopologyError);
}

/// d(a ∧ b) = da ∧ b + (-1)^p a ∧ db, as an equation of operators on a.
TYPED_TEST(WedgeOperators, ObeyLeibniz) {
  constexpr int n = TypeParam::value;
  const auto K = random_complex<n>(3);
  const Derivative<n> d(K);
  for_each_degree<n - 1>([&]<int p>() {
    for_each_degree<n - 1 - p>([&]<int q>() {
      const auto b = random_form<n, q>(K, 2);
      const Operator<PrimalForm<n, p>, PrimalForm<n, p + q + 1>> defect =
          d * WedgeWith(b) - WedgeWith(b) * d - (p % 2 == 0 ? 1 : -1) * WedgeWith(derham::d(b));
      EXPECT_LT(defect.matrix().norm(), 1e-12) << p << ", " << q;
      const Operator<PrimalForm<n, p>, PrimalForm<n, p + q + 1>> term = WedgeWith(derham::d(b));
      EXPECT_GT(term.matrix().norm(), 0.1);
    });
  });
}

}  // namespace
}  // namespace derham
