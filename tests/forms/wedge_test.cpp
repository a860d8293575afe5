#include "derham/forms/wedge.hpp"

#include "derham/core/parallel.hpp"
#include "derham/forms/carried_form.hpp"
#include "derham/forms/exterior_derivative.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/classics.hpp"
#include "support/random_forms.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace derham {
namespace {

using support::distance;
using support::for_degrees;
using support::random_complex;
using support::random_form;
using support::random_integer_form;

/// The value of a form on any alias of a simplex.
template <int n, int k>
double value(const Form<n, k>& a, std::span<const Index> alias) {
  const SignedIndex found = a.complex().at(alias);
  return found.sign * a[found.index];
}

/// The definition: all permutations of the vertices.
template <int n, int p, int q>
Form<n, p + q> sum_over_permutations(const Form<n, p>& a, const Form<n, q>& b) {
  const auto& K = a.complex();
  Form<n, p + q> result(K);
  for (Index i = 0; i < result.size(); ++i) {
    std::array<Index, p + q + 1> order;
    std::iota(order.begin(), order.end(), Index{0});
    do {
      std::array<Index, p + q + 1> places = order, vertices;
      for (std::size_t v = 0; v < order.size(); ++v)
        vertices[v] = K.simplex(p + q, i)[static_cast<std::size_t>(order[v])];
      result[i] += sort_with_sign(places) * value(a, std::span(vertices).template first<p + 1>()) *
                   value(b, std::span(vertices).template last<q + 1>());
    } while (std::ranges::next_permutation(order).found);
    result[i] *= K.sign(p + q, i) / static_cast<double>(factorial(p + q + 1));
  }
  return result;
}

/// Calls f(K, p, q, seed) for random complexes and all degrees with p + q <= n.
template <int n, class F>
void for_random_pairs(F&& f) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const auto K = random_complex<n>(seed);
    for_degrees<n>([&](auto p) { for_degrees<n - decltype(p)::value>([&](auto q) { f(K, p, q, seed); }); });
  }
}

template <int n>
Form<n, 0> one(const SimplicialComplex<n>& K) {
  return Form<n, 0>(K, std::vector<double>(static_cast<std::size_t>(K.size(0)), 1.0));
}

template <class T>
class Wedge : public testing::Test {};
template <int value>
using Constant = std::integral_constant<int, value>;
using Dimensions = testing::Types<Constant<1>, Constant<2>, Constant<3>, Constant<4>>;
TYPED_TEST_SUITE(Wedge, Dimensions);

TYPED_TEST(Wedge, IsTheSumOverPermutations) {
  constexpr int n = TypeParam::value;
  for_random_pairs<n>([]<int p, int q>(const auto& K, Constant<p>, Constant<q>, std::uint64_t seed) {
    const auto a = random_form<n, p>(K, seed);
    const auto b = random_form<n, q>(K, seed + 100);
    EXPECT_LT(distance(wedge(a, b), sum_over_permutations(a, b)), 1e-14) << p << " " << q << ", seed " << seed;
  });
}

TYPED_TEST(Wedge, IsADerivationForD) {
  constexpr int n = TypeParam::value;
  for_random_pairs<n>([]<int p, int q>(const auto& K, Constant<p>, Constant<q>, std::uint64_t seed) {
    if constexpr (p + q < n) {
      const auto a = random_form<n, p>(K, seed);
      const auto b = random_form<n, q>(K, seed + 100);
      const auto right = wedge(d(a), b) + (p % 2 == 0 ? 1.0 : -1.0) * wedge(a, d(b));
      EXPECT_LT(distance(d(wedge(a, b)), right), 1e-13) << p << " " << q << ", seed " << seed;
    }
  });
}

TYPED_TEST(Wedge, IsGradedCommutative) {
  constexpr int n = TypeParam::value;
  for_random_pairs<n>([]<int p, int q>(const auto& K, Constant<p>, Constant<q>, std::uint64_t seed) {
    const auto a = random_integer_form<n, p>(K, seed);
    const auto b = random_integer_form<n, q>(K, seed + 100);
    EXPECT_EQ(wedge(b, a), (p * q % 2 == 0 ? 1.0 : -1.0) * wedge(a, b)) << p << " " << q << ", seed " << seed;
  });
}

TYPED_TEST(Wedge, HasTheUnitOne) {
  constexpr int n = TypeParam::value;
  for_random_pairs<n>([]<int p, int q>(const auto& K, Constant<p>, Constant<q>, std::uint64_t seed) {
    if constexpr (q == 0) {
      const auto a = random_integer_form<n, p>(K, seed);
      EXPECT_EQ(wedge(one(K), a), a);
      EXPECT_EQ(wedge(a, one(K)), a);
    }
  });
}

TYPED_TEST(Wedge, IsCarriedToRenumberedComplexes) {
  constexpr int n = TypeParam::value;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    support::Random random(seed);
    const auto rows = support::simplex_list(support::random_pure(n, random));
    const SimplicialComplex<n> K(rows);
    std::vector<Index> new_vertex(static_cast<std::size_t>(K.size(0)));
    std::iota(new_vertex.begin(), new_vertex.end(), Index{0});
    std::ranges::shuffle(new_vertex, random);
    const Renumbering renumbering = with_rows_in_order(new_vertex, rows);
    const SimplicialComplex<n> L(renumbered(rows, renumbering));
    for_degrees<n>([&]<int p>(Constant<p>) {
      for_degrees<n - p>([&]<int q>(Constant<q>) {
        const auto a = random_integer_form<n, p>(K, seed);
        const auto b = random_integer_form<n, q>(K, seed + 100);
        EXPECT_EQ(wedge(carried(a, L, renumbering), carried(b, L, renumbering)), carried(wedge(a, b), L, renumbering))
            << p << " " << q << ", seed " << seed;
      });
    });
  }
}

/// Closed forms: differentials of random forms, and constants in degree 0.
template <int n, int p>
Form<n, p> closed_form(const SimplicialComplex<n>& K, std::uint64_t seed) {
  if constexpr (p == 0)
    return 2.5 * one(K);
  else
    return d(random_form<n, p - 1>(K, seed));
}

TYPED_TEST(Wedge, IsAssociativeOnClosedForms) {
  constexpr int n = TypeParam::value;
  for_random_pairs<n>([]<int p, int q>(const auto& K, Constant<p>, Constant<q>, std::uint64_t seed) {
    const auto a = closed_form<n, p>(K, seed);
    const auto b = closed_form<n, q>(K, seed + 100);
    for_degrees<n - p - q>([&]<int r>(Constant<r>) {
      const auto c = closed_form<n, r>(K, seed + 200);
      EXPECT_LT(distance(wedge(wedge(a, b), c), wedge(a, wedge(b, c))), 1e-13) << p << " " << q << " " << r;
    });
  });
}

TYPED_TEST(Wedge, IsNotAssociativeInGeneral) {
  constexpr int n = TypeParam::value;
  const auto K = random_complex<n>(1);
  const auto f = random_form<n, 0>(K, 1), g = random_form<n, 0>(K, 2);
  const auto a = random_form<n, 1>(K, 3);
  EXPECT_GT(distance(wedge(wedge(f, g), a), wedge(f, wedge(g, a))), 1e-3);
}

/// The form with constant coefficients c_{i0…ik} dx_i0 ∧ … on a box: sums of determinants of the edges.
template <int n, int k>
Form<n, k> constant_form(const SimplicialComplex<n>& K, const Geometry<n>& geometry,
                         const std::array<std::array<double, n>, k>& covectors) {
  Form<n, k> result(K);
  std::array<int, k> order;
  for (Index i = 0; i < result.size(); ++i) {
    const auto corner = geometry.template corners<k>(K, i);
    std::iota(order.begin(), order.end(), 0);
    do {  // the determinant of (covector j on edge l), over k!
      auto sorted = order;
      int sign = 1;
      for (std::size_t j = 0; j < k; ++j)
        for (std::size_t l = 0; l < j; ++l)
          if (sorted[l] > sorted[j]) sign = -sign;
      double term = sign;
      for (std::size_t j = 0; j < k; ++j) {
        double on_edge = 0;
        for (std::size_t x = 0; x < n; ++x)
          on_edge += covectors[j][x] * (corner[static_cast<std::size_t>(order[j]) + 1][x] - corner[0][x]);
        term *= on_edge;
      }
      result[i] += term;
    } while (std::ranges::next_permutation(order).found);
    result[i] *= K.sign(k, i) / static_cast<double>(factorial(k));
  }
  return result;
}

TYPED_TEST(Wedge, IsExactOnConstantForms) {
  constexpr int n = TypeParam::value;
  const MeshData mesh = meshes::box(n, 2, {.jitter = 0.2});
  const SimplicialComplex<n> K(mesh.simplices);
  const auto geometry = Geometry<n>::from_mesh(K, mesh);
  const auto numbers = support::random_values(n * n, 7);
  for_degrees<n>([&]<int p>(Constant<p>) {
    for_degrees<n - p>([&]<int q>(Constant<q>) {
      std::array<std::array<double, n>, p + q> all;
      for (std::size_t j = 0; j < p + q; ++j) std::copy_n(numbers.begin() + static_cast<int>(j) * n, n, all[j].begin());
      std::array<std::array<double, n>, p> first;
      std::array<std::array<double, n>, q> second;
      std::copy_n(all.begin(), p, first.begin());
      std::copy_n(all.begin() + p, q, second.begin());
      const auto product = wedge(constant_form<n, p>(K, geometry, first), constant_form<n, q>(K, geometry, second));
      EXPECT_LT(distance(product, constant_form<n, p + q>(K, geometry, all)), 1e-15) << p << " " << q;
    });
  });
}

TYPED_TEST(Wedge, HasTheSameBitsOnAnyNumberOfThreads) {
  constexpr int n = TypeParam::value;
  const SimplicialComplex<n> K(meshes::box(n, n == 1 ? 40000 : n == 2 ? 100 : n == 3 ? 20 : 7).simplices);
  const int before = thread_count();
  for_degrees<n>([&]<int p>(Constant<p>) {
    const auto a = random_form<n, p>(K, 1);
    const auto b = random_form<n, n - p>(K, 2);
    set_thread_count(1);
    const auto one_thread = wedge(a, b);
    for (const int threads : {2, 4}) {
      set_thread_count(threads);
      EXPECT_EQ(wedge(a, b), one_thread) << threads << " threads";
    }
  });
  set_thread_count(before);
}

TEST(WedgeAtRunTime, RefusesWrongDegreesAndLengths) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}, {1, 2, 3}});
  const std::vector<double> vertices(4), edges(5);
  std::vector<double> triangles(2);
  EXPECT_NO_THROW(apply_wedge(K, 1, edges, 1, edges, triangles));
  EXPECT_THROW(apply_wedge(K, 2, triangles, 1, edges, triangles), InputError);
  EXPECT_THROW(apply_wedge(K, -1, edges, 1, edges, triangles), InputError);
  EXPECT_THROW(apply_wedge(K, 1, vertices, 1, edges, triangles), InputError);
  EXPECT_THROW(apply_wedge(K, 1, edges, 1, vertices, triangles), InputError);
  std::vector<double> too_many(3);
  EXPECT_THROW(apply_wedge(K, 1, edges, 1, edges, too_many), InputError);
}

TEST(WedgeOfForms, RefusesFormsOfDifferentComplexes) {
  const SimplicialComplex<1> K(meshes::cycle(3)), L(meshes::cycle(3));
  EXPECT_THROW((void)wedge(Form<1, 0>(K), Form<1, 1>(L)), InputError);
}

TEST(Integral, OfADifferentialVanishesOnClosedManifoldsAndNotOnOthers) {
  const SimplicialComplex<3> sphere(meshes::sphere(3));
  EXPECT_EQ(integral(d(random_integer_form<3, 2>(sphere, 1))), 0);
  const SimplicialComplex<2> disk(SimplexList{{0, 1, 2}, {1, 3, 2}});
  EXPECT_EQ(integral(Form<2, 2>(disk, {1, 2})), 3);
  EXPECT_NE(integral(d(random_integer_form<2, 1>(disk, 1))), 0);
}

TEST(Integral, NeedsAFundamentalClass) {
  const SimplicialComplex<2> K(meshes::klein_bottle());
  EXPECT_THROW((void)integral(Form<2, 2>(K)), TopologyError);
  const auto a = random_integer_form<2, 1>(K, 1), b = random_integer_form<2, 1>(K, 2);
  EXPECT_LT(distance(wedge(a, b), sum_over_permutations(a, b)), 1e-9) << "the product itself needs no orientation";
}

}  // namespace
}  // namespace derham
