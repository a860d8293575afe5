#include "derham/forms/dual_wedge.hpp"

#include "derham/complex/incidence.hpp"
#include "derham/core/parallel.hpp"
#include "derham/forms/exterior_derivative.hpp"
#include "derham/forms/wedge.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/classics.hpp"
#include "derham/meshes/constructions.hpp"

#include "support/random_forms.hpp"

#include <gtest/gtest.h>

namespace derham {
namespace {

using support::distance;
using support::for_degrees;
using support::random_form;
using support::random_integer_form;

template <class T>
class DualWedge : public testing::Test {};
template <int value>
using Constant = std::integral_constant<int, value>;
using Dimensions = testing::Types<Constant<1>, Constant<2>, Constant<3>, Constant<4>>;
TYPED_TEST_SUITE(DualWedge, Dimensions);

/// A box in n dimensions, and a closed complex.
template <int n, class F>
void for_two_complexes(F&& f) {
  f(SimplicialComplex<n>(meshes::box(n, 2).simplices));
  f(SimplicialComplex<n>(meshes::grid_torus(n)));
}

template <int n, Side side>
Form<n, 0, side> one(const SimplicialComplex<n>& K) {
  return Form<n, 0, side>(K, std::vector<double>(static_cast<std::size_t>(Form<n, 0, side>(K).size()), 1.0));
}

TYPED_TEST(DualWedge, PairingIsIntegrationByParts) {
  constexpr int n = TypeParam::value;
  for_two_complexes<n>([](const auto& K) {
    for_degrees<n - 1>([&]<int k>(Constant<k>) {
      const auto a = random_integer_form<n, k>(K, 1);
      const auto b = random_integer_form<n, n - k - 1, Side::dual>(K, 2);
      EXPECT_EQ(pair(d(a), b) + (k % 2 == 0 ? 1 : -1) * pair(a, d(b)), 0) << k;
    });
    for_degrees<n>([&]<int k>(Constant<k>) {
      const auto a = random_form<n, k>(K, 1);
      const auto b = random_form<n, n - k, Side::dual>(K, 2);
      EXPECT_EQ(pair(b, a), (k * (n - k) % 2 == 0 ? 1 : -1) * pair(a, b)) << k;
      EXPECT_NE(pair(a, b), 0);
    });
  });
}

TYPED_TEST(DualWedge, FunctionsMultiplyOnEitherSideOfThePairing) {
  constexpr int n = TypeParam::value;
  for_two_complexes<n>([](const auto& K) {
    for_degrees<n>([&]<int k>(Constant<k>) {
      const auto f = random_form<n, 0>(K, 1);
      const auto g = random_form<n, 0, Side::dual>(K, 2);
      const auto a = random_form<n, k>(K, 3);
      const auto b = random_form<n, n - k, Side::dual>(K, 4);
      EXPECT_NEAR(pair(a, wedge(f, b)), pair(wedge(f, a), b), 1e-10) << k;
      EXPECT_NEAR(pair(a, wedge(g, b)), pair(wedge(g, a), b), 1e-10) << k;
      EXPECT_EQ(wedge(one<n, Side::primal>(K), b), b);
      EXPECT_EQ(wedge(one<n, Side::dual>(K), b), b);
      EXPECT_EQ(wedge(one<n, Side::dual>(K), a), a);
    });
  });
}

TYPED_TEST(DualWedge, DualFunctionsAreMultipliedPointwise) {
  constexpr int n = TypeParam::value;
  for_two_complexes<n>([](const auto& K) {
    const auto g = random_form<n, 0, Side::dual>(K, 1), h = random_form<n, 0, Side::dual>(K, 2);
    const auto product = wedge(g, h);
    for (Index t = 0; t < K.size(n); ++t) EXPECT_EQ(product[t], g[t] * h[t]);
    const auto left = d(product), right = wedge(h, d(g)) + wedge(g, d(h));
    const auto tops = facet_cofaces(K);
    for (Index i = 0; i < K.size(n - 1); ++i)
      if (tops.count[static_cast<std::size_t>(i)] == 2) {
        EXPECT_NEAR(left[i], right[i], 1e-13) << "Leibniz";
      }
  });
}

TYPED_TEST(DualWedge, IsTheMeanOverTheCorners) {
  constexpr int n = TypeParam::value;
  const SimplicialComplex<n> K(meshes::sphere(n));
  const auto f = random_form<n, 0>(K, 1);
  const auto g = random_form<n, 0, Side::dual>(K, 2);
  for_degrees<n>([&]<int k>(Constant<k>) {
    const auto b = random_form<n, n - k, Side::dual>(K, 3);
    const auto vertices = wedge(f, b), tops = wedge(g, b);
    const Incidence cofaces = incidence(K, k, n);
    for (Index i = 0; i < K.size(k); ++i) {
      double of_vertices = 0, of_tops = 0;
      for (const Index v : K.simplex(k, i)) of_vertices += f[v] / (k + 1);
      for (const Index t : cofaces[i]) of_tops += g[t] / static_cast<double>(cofaces[i].size());
      EXPECT_NEAR(vertices[i], of_vertices * b[i], 1e-14);
      EXPECT_NEAR(tops[i], of_tops * b[i], 1e-14);
    }
  });
}

TYPED_TEST(DualWedge, HasTheSameBitsOnAnyNumberOfThreads) {
  constexpr int n = TypeParam::value;
  const SimplicialComplex<n> K(meshes::box(n, n == 1 ? 40000 : n == 2 ? 100 : n == 3 ? 20 : 7).simplices);
  const auto f = random_form<n, 0>(K, 1);
  const auto b = random_form<n, 1, Side::dual>(K, 2);
  const int before = thread_count();
  set_thread_count(1);
  const auto alone = wedge(f, b);
  for (const int threads : {2, 4}) {
    set_thread_count(threads);
    EXPECT_EQ(wedge(f, b), alone);
  }
  set_thread_count(before);
}

/// Closed surfaces whose vertices have 3 to many neighbours, numbered and oriented at random.
std::vector<SimplicialComplex<2>> closed_surfaces() {
  std::vector<SimplicialComplex<2>> surfaces;
  for (const SimplexList& rows : {meshes::sphere(2), meshes::csaszar_torus(), meshes::suspension(meshes::cycle(9))}) {
    support::Random random(3);
    support::Rows shuffled;
    for (Offset i = 0; i < rows.size(); ++i) shuffled.emplace_back(rows[i].begin(), rows[i].end());
    surfaces.emplace_back(support::simplex_list(support::shuffled(shuffled, random)));
  }
  return surfaces;
}

TEST(DualWedgeOnSurfaces, OneFormsAreAnticommutativeAndDIsADerivation) {
  for (const auto& K : closed_surfaces()) {
    const auto g = random_form<2, 0, Side::dual>(K, 1);
    const auto a = random_form<2, 1, Side::dual>(K, 2), b = random_form<2, 1, Side::dual>(K, 3);
    EXPECT_LT(distance(wedge(a, b), -wedge(b, a)), 1e-13);
    EXPECT_LT(distance(d(wedge(g, b)), wedge(d(g), b) + wedge(g, d(b))), 1e-13);
    EXPECT_GT(distance(wedge(a, b), 0.0 * wedge(a, b)), 1e-3) << "not zero";
  }
}

/// Closed dual 1-forms of the torus pair to the same number, up to the one sign of the class, as closed primal ones
/// do: on closed surfaces without boundary ∫ dg ∧ b = 0 for closed b.
TEST(DualWedgeOnSurfaces, TheIntegralOfAnExactTimesAClosedFormVanishes) {
  for (const auto& K : closed_surfaces()) {
    const auto b = d(random_form<2, 0, Side::dual>(K, 1)), c = d(random_form<2, 0, Side::dual>(K, 2));
    const auto product = wedge(b, c);
    double sum = 0;
    for (const double value : product.values()) sum += value;
    EXPECT_NEAR(sum, 0, 1e-12);
  }
}

TEST(DualWedgeOnSurfaces, IsZeroOnOpenCellsAndNeedsAnOrientation) {
  const SimplicialComplex<2> disk(meshes::box(2, 3).simplices);
  const auto product = wedge(random_form<2, 1, Side::dual>(disk, 1), random_form<2, 1, Side::dual>(disk, 2));
  Index zeros = 0;
  for (const double value : product.values()) zeros += value == 0;
  EXPECT_EQ(zeros, 12) << "the vertices on the boundary of 4 x 4";
  const SimplicialComplex<2> K(meshes::klein_bottle());
  EXPECT_THROW((void)wedge(Form<2, 1, Side::dual>(K), Form<2, 1, Side::dual>(K)), TopologyError);
}

TEST(DualWedgeErrors, OtherComplexesAndImpureOnes) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}}), L(SimplexList{{0, 1, 2}}),
      mixed(SimplexList{{0, 1, 2}, {2, 3}});
  EXPECT_THROW((void)wedge(Form<2, 0>(K), Form<2, 1, Side::dual>(L)), InputError);
  EXPECT_THROW((void)pair(Form<2, 1>(K), Form<2, 1, Side::dual>(L)), InputError);
  EXPECT_THROW((void)wedge(Form<2, 0, Side::dual>(mixed), Form<2, 1>(mixed)), TopologyError);
}

}  // namespace
}  // namespace derham
