#include "derham/forms/trace.hpp"

#include "derham/forms/wedge.hpp"
#include "operators/spaces.hpp"
#include "support/random_forms.hpp"

#include <gtest/gtest.h>

namespace derham {
namespace {

using support::random_integer_form;
using test::for_each_degree;

template <class T>
struct Trace : testing::Test {};
TYPED_TEST_SUITE(Trace, test::Dimensions);

template <int n>
SimplicialComplex<n> shuffled_box(std::uint32_t seed) {
  return SimplicialComplex<n>(test::random_mesh<n>(seed, 2).simplices);
}

TYPED_TEST(Trace, CommutesWithD) {
  constexpr int n = TypeParam::value;
  const auto K = shuffled_box<n>(1);
  const auto B = boundary_complex(K);
  for_each_degree<n - 1>([&]<int k>() {
    if constexpr (k + 1 < n) {
      const auto w = random_integer_form<n, k>(K, 1);
      EXPECT_EQ(trace(B, d(w)), d(trace(B, w))) << "degree " << k;
    }
  });
}

TYPED_TEST(Trace, OfTheFluxAddsUpToTheSources) {
  constexpr int n = TypeParam::value;
  if constexpr (n >= 2) {
    const auto K = shuffled_box<n>(2);
    const auto B = boundary_complex(K);
    const auto flux = random_integer_form<n, n - 1>(K, 1);
    EXPECT_EQ(integral(trace(B, flux)), integral(d(flux)));
    EXPECT_NE(integral(d(flux)), 0);
  }
}

TYPED_TEST(Trace, IsTheTransposeOfTheBoundaryTerm) {
  constexpr int n = TypeParam::value;
  const auto K = shuffled_box<n>(3);
  const auto B = boundary_complex(K);
  for_each_degree<n - 1>([&]<int k>() {
    const auto a = random_integer_form<n, k>(K, 1);
    const auto b = random_integer_form<n - 1, n - 1 - k, Side::dual>(B.complex, 2);
    const auto tr = trace(B, a);
    const auto term = boundary_term(K, B, b);
    double inside = 0, outside = 0;
    for (Index i = 0; i < a.size(); ++i) inside += a[i] * term[i];
    for (Index i = 0; i < b.size(); ++i) outside += tr[i] * b[i];
    EXPECT_EQ(inside, outside) << "degree " << k;
  });
}

TYPED_TEST(Trace, ClosesTheDualCells) {
  constexpr int n = TypeParam::value;
  const auto K = shuffled_box<n>(4);
  const auto B = boundary_complex(K);
  for_each_degree<n - 1>([&]<int j>() {
    const auto w = random_integer_form<n, j, Side::dual>(K, 1);
    EXPECT_EQ(d(w, B, DualForm<n - 1, j>(B.complex)), d(w));
    if constexpr (j + 1 < n) {
      const auto b = random_integer_form<n - 1, j, Side::dual>(B.complex, 2);
      EXPECT_EQ(d(d(w, B, b), B, d(b)), (DualForm<n, j + 2>(K))) << "degree " << j;
    }
  });
}

TEST(TraceErrors, AreNamed) {
  const auto K = shuffled_box<2>(5), other = shuffled_box<2>(5);
  const SimplicialComplex<2> small(SimplexList{{0, 1, 2}});
  const auto B = boundary_complex(K), C = boundary_complex(other);
  EXPECT_THROW((void)trace(B, PrimalForm<2, 1>(small)), InputError);
  EXPECT_THROW((void)boundary_term(small, B, DualForm<1, 0>(B.complex)), InputError);
  EXPECT_THROW((void)boundary_term(K, B, DualForm<1, 0>(C.complex)), InputError);
}

}  // namespace
}  // namespace derham
