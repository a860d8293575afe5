#include "derham/forms/form.hpp"

#include "derham/core/error.hpp"
#include "derham/forms/exterior_derivative.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace derham {
namespace {

/// A pure n-complex with many shared faces: random facets on few vertices, every vertex used.
template <int n>
SimplicialComplex<n> random_complex(std::uint64_t seed, int facets) {
  std::mt19937_64 random(seed);
  SimplexList rows;
  std::vector<std::vector<Index>> seen;
  const Index vertices = n + 4;
  std::vector<Index> ids(static_cast<std::size_t>(vertices));
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<Index>(i);
  std::vector<Index> used;
  for (int f = 0; f < facets; ++f) {
    std::ranges::shuffle(ids, random);
    std::vector<Index> row(ids.begin(), ids.begin() + n + 1), sorted = row;
    std::ranges::sort(sorted);
    if (std::ranges::find(seen, sorted) != seen.end()) continue;
    seen.push_back(sorted);
    used.insert(used.end(), row.begin(), row.end());
  }
  std::ranges::sort(used);
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (auto row : seen) {
    for (Index& v : row) v = static_cast<Index>(std::ranges::lower_bound(used, v) - used.begin());
    std::ranges::shuffle(row, random);
    rows.push_back(row);
  }
  return SimplicialComplex<n>(rows);
}

template <int n, int k, Side side>
Form<n, k, side> random_form(const SimplicialComplex<n>& K, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<int> integers(-1000, 1000);  // integers: every law below is exact
  Form<n, k, side> form(K);
  for (double& value : form.values()) value = integers(random);
  return form;
}

template <int n, int k>
Chain<n, k> random_chain(const SimplicialComplex<n>& K, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<typename Chain<n, k>::Term> terms;
  for (int i = 0; i < 10; ++i)
    terms.push_back(
        {static_cast<Index>(random() % static_cast<std::uint64_t>(K.size(k))), static_cast<int>(random() % 7) - 3});
  return Chain<n, k>(K, terms);
}

template <int n, int k>
void expect_laws_of_degree(const SimplicialComplex<n>& K, std::uint64_t seed) {
  const auto w = random_form<n, k, Side::primal>(K, seed);
  if constexpr (k + 1 <= n) {
    const auto c = random_chain<n, k + 1>(K, seed + 1);
    EXPECT_EQ(pair(d(w), c), pair(w, boundary(c))) << "Stokes, n = " << n << ", k = " << k << ", seed " << seed;
    if constexpr (k + 2 <= n) {
      const auto ddw = d(d(w));
      for (const double value : ddw.values()) EXPECT_EQ(value, 0) << "dd, n = " << n << ", k = " << k;
      EXPECT_TRUE(boundary(boundary(random_chain<n, k + 2>(K, seed + 2))).is_zero());
    }
    if (K.is_orientable()) {
      const auto dual = random_form<n, k, Side::dual>(K, seed + 3);
      if constexpr (k + 2 <= n) {
        const auto dd_dual = d(d(dual));
        for (const double value : dd_dual.values()) EXPECT_EQ(value, 0);
      }
      // the dual derivative is (-1)^(p+1) times the transpose of d_p, p = n-k-1
      const auto test = random_form<n, n - k - 1, Side::primal>(K, seed + 4);
      double left = 0, right = 0;
      const auto d_dual = d(dual);
      const auto d_test = d(test);
      for (Index i = 0; i < test.size(); ++i) left += test[i] * d_dual[i];
      for (Index i = 0; i < dual.size(); ++i) right += d_test[i] * dual[i];
      EXPECT_EQ(left, ((n - k) % 2 == 0 ? 1 : -1) * right);
      EXPECT_EQ(d(dual, Cofaces(K, n - k - 1)), d_dual);
    }
    expect_laws_of_degree<n, k + 1>(K, seed);
  }
}

template <class T>
class FormLaws : public testing::Test {};
template <int value>
using Constant = std::integral_constant<int, value>;
using Dimensions = testing::Types<Constant<1>, Constant<2>, Constant<3>, Constant<4>, Constant<5>, Constant<6>>;
TYPED_TEST_SUITE(FormLaws, Dimensions);

TYPED_TEST(FormLaws, StokesAndDerivativesOnRandomComplexes) {
  constexpr int n = TypeParam::value;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    expect_laws_of_degree<n, 0>(random_complex<n>(seed, static_cast<int>(seed)), seed);
}

TEST(Form, ValueOnAnAliasCarriesItsSign) {
  const SimplicialComplex<2> K(SimplexList{{0, 2, 1}, {1, 2, 3}});
  Form<2, 1> w(K);
  w[K.at({1, 2}).index] = 5;
  EXPECT_EQ(w({1, 2}), 5);
  EXPECT_EQ(w({2, 1}), -5);
  EXPECT_THROW((void)w({0, 3}), InputError);
  EXPECT_THROW((void)w({0, 1, 2}), InputError);
  Form<2, 2> area(K, {1.5, 2.5});
  EXPECT_EQ(area({0, 2, 1}), 1.5);  // the first input tuple of a component is positive
  EXPECT_EQ(area({0, 1, 2}), -1.5);
  EXPECT_EQ(area({1, 2, 3}), -area({2, 1, 3}));
}

TEST(Form, HasSumsMultiplesAndQuotients) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}});
  const Form<2, 1> w(K, {1, 2, 3}), u(K, {4, 0, -1});
  EXPECT_EQ(w + u, (Form<2, 1>(K, {5, 2, 2})));
  EXPECT_EQ(w - u, (Form<2, 1>(K, {-3, 2, 4})));
  EXPECT_EQ(2 * w, (Form<2, 1>(K, {2, 4, 6})));
  EXPECT_EQ(w * 2, 2 * w);
  EXPECT_EQ(w / 2, (Form<2, 1>(K, {0.5, 1, 1.5})));
  EXPECT_EQ(-w, -1 * w);
}

TEST(Form, RefusesWrongLengthsAndForeignComplexes) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}}), L(SimplexList{{0, 1, 2}});
  EXPECT_THROW((Form<2, 1>(K, {1, 2})), InputError);
  EXPECT_THROW((Form<2, 1>(K) += Form<2, 1>(L)), InputError);
  EXPECT_THROW((void)pair(Form<2, 1>(K), Chain<2, 1>(L)), InputError);
}

TEST(DualDerivative, RefusesCofacesOfAnotherDegreeOrComplex) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}}), L(SimplexList{{0, 1, 2}, {1, 2, 3}});
  const DualForm<2, 0> w(K);
  EXPECT_NO_THROW((void)d(w, Cofaces(K, 1)));
  EXPECT_THROW((void)d(w, Cofaces(K, 0)), InputError);
  EXPECT_THROW((void)d(w, Cofaces(L, 1)), InputError);
}

TEST(FundamentalChain, HasTheOrientedRimAsBoundaryBecauseInteriorFacetsCancel) {
  // dd = 0 would hold with any signs in the top degree; that each interior facet cancels needs the orientation of the
  // tops
  const SimplicialComplex<2> K(SimplexList{{0, 1, 4}, {4, 2, 1}, {2, 3, 4}, {4, 0, 3}});
  const auto fundamental = fundamental_chain(K);
  const auto rim = boundary(fundamental);
  EXPECT_EQ(rim.terms().size(), 4u);
  EXPECT_EQ(rim({0, 1}), 1);
  EXPECT_EQ(rim({1, 2}), 1);
  EXPECT_EQ(rim({2, 3}), 1);
  EXPECT_EQ(rim({3, 0}), 1);
}

}  // namespace
}  // namespace derham
