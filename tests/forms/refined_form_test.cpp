#include "derham/forms/refined_form.hpp"

#include "derham/core/parallel.hpp"
#include "derham/forms/exterior_derivative.hpp"
#include "derham/forms/wedge.hpp"
#include "derham/meshes/boxes.hpp"
#include "support/random_forms.hpp"

#include <gtest/gtest.h>

namespace derham {
namespace {

using support::distance;
using support::for_degrees;
using support::random_complex;
using support::random_form;
using support::random_integer_form;

template <class T>
class RefinedForm : public testing::Test {};
template <int value>
using Constant = std::integral_constant<int, value>;
using Dimensions = testing::Types<Constant<1>, Constant<2>, Constant<3>, Constant<4>>;
TYPED_TEST_SUITE(RefinedForm, Dimensions);

TYPED_TEST(RefinedForm, ProlongationAndRestrictionCommuteWithDExactly) {
  constexpr int n = TypeParam::value;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const auto K = random_complex<n>(seed);
    const Refinement<n> refinement(K);
    for_degrees<n>([&]<int k>(Constant<k>) {
      const auto w = random_integer_form<n, k>(K, seed);
      const auto v = random_integer_form<n, k>(refinement.fine(), seed);
      EXPECT_EQ(restriction(refinement, prolongation(refinement, w)), w) << k << ", seed " << seed;
      EXPECT_EQ(restriction(refinement, prolongation(refinement, random_form<n, k>(K, seed))),
                (random_form<n, k>(K, seed)))
          << "of any numbers";
      if constexpr (k < n) {
        EXPECT_EQ(d(prolongation(refinement, w)), prolongation(refinement, d(w))) << k << ", seed " << seed;
        EXPECT_EQ(d(restriction(refinement, v)), restriction(refinement, d(v))) << k << ", seed " << seed;
      } else if (K.is_orientable()) {
        EXPECT_EQ(integral(prolongation(refinement, w)), integral(w));
        EXPECT_EQ(integral(restriction(refinement, v)), integral(v));
      }
    });
  }
}

/// The barycentric coordinate of coarse vertex v, on the fine complex.
template <int n>
PrimalForm<n, 0> hat(const Refinement<n>& refinement, Index v) {
  PrimalForm<n, 0> result(refinement.fine());
  for (Index i = 0; i < result.size(); ++i)
    for (const Index end : refinement.ends(i)) result[i] += end == v ? 0.5 : 0;
  return result;
}

/// dλ_{face[1]} ∧ … ∧ dλ_{face[j]}: constant on every fine simplex, where the product is exact and associative.
template <int j, int n, std::size_t size>
PrimalForm<n, j> differentials(const Refinement<n>& refinement, const std::array<Index, size>& face) {
  if constexpr (j == 1)
    return d(hat(refinement, face[1]));
  else
    return wedge(differentials<j - 1>(refinement, face), d(hat(refinement, face[j])));
}

/// λ_{face[0]} dλ_{face[1]} ∧ … ∧ dλ_{face[k]}: the product of a linear and a constant form is exact, too.
template <int k, int n>
PrimalForm<n, k> whitney_term(const Refinement<n>& refinement, const std::array<Index, k + 1>& face) {
  if constexpr (k == 0)
    return hat(refinement, face[0]);
  else
    return wedge(hat(refinement, face[0]), differentials<k>(refinement, face));
}

/// The prolongation from the definition of the Whitney form k! Σ_i (-1)^i λ_i dλ_0 ∧ … (without i) … ∧ dλ_k.
template <int n, int k>
PrimalForm<n, k> whitney(const Refinement<n>& refinement, const PrimalForm<n, k>& w) {
  const auto& K = refinement.coarse();
  PrimalForm<n, k> sum(refinement.fine());
  for (Index s = 0; s < K.size(k); ++s)
    for (std::size_t i = 0; i <= k; ++i) {
      std::array<Index, k + 1> face{};
      std::ranges::copy(K.simplex(k, s), face.begin());
      const auto chosen = face.begin() + static_cast<int>(i);
      std::rotate(face.begin(), chosen, chosen + 1);  // brought to the front, the others in order
      const double factor = (i % 2 == 0 ? 1.0 : -1.0) * static_cast<double>(factorial(k)) * K.sign(k, s) * w[s];
      sum += factor * whitney_term<k>(refinement, face);
    }
  return sum;
}

TYPED_TEST(RefinedForm, ProlongationIntegratesTheWhitneyForm) {
  constexpr int n = TypeParam::value;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto K = random_complex<n>(seed);
    const Refinement<n> refinement(K);
    for_degrees<n>([&]<int k>(Constant<k>) {
      const auto w = random_form<n, k>(K, seed);
      EXPECT_LT(distance(prolongation(refinement, w), whitney(refinement, w)), 1e-13) << k << ", seed " << seed;
    });
  }
}

TYPED_TEST(RefinedForm, RowsAreThoseOfTheProlongation) {
  constexpr int n = TypeParam::value;
  const auto K = random_complex<n>(4);
  const Refinement<n> refinement(K);
  for_degrees<n>([&]<int k>(Constant<k>) {
    const auto w = random_integer_form<n, k>(K, 3);
    const auto fine = prolongation(refinement, w);
    for (Index i = 0; i < fine.size(); ++i) {
      const auto row = prolongation_row(refinement, k, i);
      double sum = 0;
      for (std::size_t j = 0; j < row.size; ++j) sum += row.weight[j] * w[row.simplex[j]];
      EXPECT_EQ(sum, fine[i]);
    }
  });
}

TYPED_TEST(RefinedForm, HasTheSameBitsOnAnyNumberOfThreads) {
  constexpr int n = TypeParam::value;
  const SimplicialComplex<n> K(meshes::box(n, n == 1 ? 9000 : n == 2 ? 50 : n == 3 ? 10 : 3).simplices);
  const Refinement<n> refinement(K);
  const auto w = random_form<n, 1>(K, 1);
  const auto v = random_form<n, 1>(refinement.fine(), 1);
  const int before = thread_count();
  set_thread_count(1);
  const auto up = prolongation(refinement, w);
  const auto down = restriction(refinement, v);
  for (const int threads : {2, 4}) {
    set_thread_count(threads);
    EXPECT_EQ(prolongation(refinement, w), up);
    EXPECT_EQ(restriction(refinement, v), down);
  }
  set_thread_count(before);
}

TEST(RefinedForms, BelongToTheRightComplexes) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}});
  const Refinement<2> refinement(K);
  EXPECT_THROW((void)prolongation(refinement, Form<2, 1>(refinement.fine())), InputError);
  EXPECT_THROW((void)restriction(refinement, Form<2, 1>(K)), InputError);
  std::vector<double> three(3), nine(9);
  EXPECT_THROW(apply_prolongation(refinement, 3, three, nine), InputError);
  EXPECT_THROW(apply_prolongation(refinement, 1, nine, three), InputError);
  EXPECT_THROW(apply_restriction(refinement, -1, nine, three), InputError);
}

}  // namespace
}  // namespace derham
