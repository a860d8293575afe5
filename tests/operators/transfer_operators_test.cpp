#include "derham/operators/transfer_operators.hpp"

#include "derham/meshes/classics.hpp"
#include "derham/operators/expression.hpp"
#include "support/random_forms.hpp"

#include <gtest/gtest.h>

namespace derham {
namespace {

using support::for_degrees;
using support::random_complex;
using support::random_integer_form;

template <int value>
using Constant = std::integral_constant<int, value>;

/// The assembled matrix is what the identity gives, and the operator what the function gives.
template <class From, class To>
void expect_own_matrix(const Operator<From, To>& A) {
  EXPECT_EQ((A.matrix() - detail::fed_with_identity(*A.map())).norm(), 0);
}

template <int n>
void expect_transfer(std::uint64_t seed) {
  const auto K = random_complex<n>(seed);
  const Refinement<n> refinement(K);
  const Derivative<n> d(K), d_fine(refinement.fine());
  for_degrees<n>([&]<int k>(Constant<k>) {
    const auto P = prolongation_operator<k>(refinement);
    const auto R = restriction_operator<k>(refinement);
    expect_own_matrix(P);
    expect_own_matrix(R);
    EXPECT_EQ(((R * P).matrix() - identity<PrimalForm<n, k>>(K).matrix()).norm(), 0);
    if constexpr (k < n) {
      using From = PrimalForm<n, k>;
      using To = PrimalForm<n, k + 1>;
      const Operator<From, To> coarse_first = d_fine * P;
      const Operator<From, To> fine_first = prolongation_operator<k + 1>(refinement) * d;
      EXPECT_EQ((coarse_first.matrix() - fine_first.matrix()).norm(), 0) << "d P = P d, degree " << k;
      const auto w = random_integer_form<n, k>(K, seed);
      EXPECT_EQ(coarse_first(w), fine_first(w));
    }
  });
}

TEST(TransferOperators, HaveMatricesWithTheLaws) {
  for (const std::uint64_t seed : {1U, 4U, 5U}) {
    expect_transfer<1>(seed);
    expect_transfer<2>(seed);
    expect_transfer<3>(seed);
  }
}

TEST(TransferOperators, OfSimplicialMapsCommuteWithD) {
  const SimplicialComplex<3> K(meshes::sphere(3));
  const SimplicialComplex<2> L(meshes::sphere(2));
  EXPECT_THROW((SimplicialMap<3, 2>(K, L, {0, 1, 2, 3, 3})), InputError) << "(0, 1, 2, 3) has no room";
  const SimplicialMap<3, 2> phi(K, L, {0, 1, 2, 2, 1});
  const Derivative<3> d(K);
  const Derivative<2> d_below(L);
  for_degrees<1>([&]<int k>(Constant<k>) {
    const auto pull = pullback_operator<k>(phi);
    expect_own_matrix(pull);
    const Operator<PrimalForm<2, k>, PrimalForm<3, k + 1>> above = d * pull;
    const Operator<PrimalForm<2, k>, PrimalForm<3, k + 1>> below = pullback_operator<k + 1>(phi) * d_below;
    EXPECT_EQ((above.matrix() - below.matrix()).norm(), 0);
    EXPECT_GT(above.matrix().norm(), 0);
  });
}

}  // namespace
}  // namespace derham
