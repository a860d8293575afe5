#include "derham/forms/pullback.hpp"

#include "derham/boundary/pushforward.hpp"
#include "derham/forms/exterior_derivative.hpp"
#include "derham/forms/wedge.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/classics.hpp"
#include "derham/meshes/constructions.hpp"
#include "support/random_forms.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace derham {
namespace {

using support::for_degrees;
using support::random_complex;
using support::random_integer_form;

std::vector<Index> random_images(Index vertices, Index bound, std::uint64_t seed) {
  support::Random random(seed);
  std::vector<Index> images(static_cast<std::size_t>(vertices));
  for (Index& v : images) v = static_cast<Index>(random() % static_cast<std::uint64_t>(bound));
  return images;
}

/// A random n-complex mapped at random to the boundary of the (m+1)-simplex, m >= n, where every n+1 vertices are those
/// of a simplex; for m < n to the m-simplex.
template <int n, int m>
struct RandomMap {
  explicit RandomMap(std::uint64_t seed)
      : K(random_complex<n>(seed)), L(m < n ? SimplexList(m, vertices()) : meshes::sphere(m)),
        phi(K, L, random_images(K.size(0), L.size(0), seed)) {}
  static std::vector<Index> vertices() {
    std::vector<Index> all(m + 1);
    std::iota(all.begin(), all.end(), Index{0});
    return all;
  }
  SimplicialComplex<n> K;
  SimplicialComplex<m> L;
  SimplicialMap<n, m> phi;
};

template <int n, int k>
Chain<n, k> random_chain(const SimplicialComplex<n>& K, std::uint64_t seed) {
  support::Random random(seed);
  std::vector<typename Chain<n, k>::Term> terms;
  for (Index i = 0; i < K.size(k); ++i) terms.push_back({i, static_cast<int>(random() % 9) - 4});
  return Chain<n, k>(K, terms);
}

template <class T>
class Pullback : public testing::Test {};
template <int value>
using Constant = std::integral_constant<int, value>;
template <int n, int m>
struct Pair {};
using Dimensions = testing::Types<Pair<1, 1>, Pair<2, 1>, Pair<2, 2>, Pair<2, 3>, Pair<3, 2>, Pair<3, 3>, Pair<4, 3>,
                                  Pair<3, 4>, Pair<4, 4>>;
TYPED_TEST_SUITE(Pullback, Dimensions);

template <int n, int m>
void expect_laws(Pair<n, m>, std::uint64_t seed) {
  const RandomMap<n, m> f(seed);
  constexpr int low = std::min(n, m);
  for_degrees<low>([&]<int k>(Constant<k>) {
    const auto w = random_integer_form<m, k>(f.L, seed);
    const auto c = random_chain<n, k>(f.K, seed + 1);
    EXPECT_EQ(pair(pullback(f.phi, w), c), pair(w, pushforward(f.phi, c))) << k << ", seed " << seed;
    if constexpr (k < low) {
      EXPECT_EQ(d(pullback(f.phi, w)), pullback(f.phi, d(w))) << k << ", seed " << seed;
    }
    if constexpr (k > 0) {
      EXPECT_EQ(boundary(pushforward(f.phi, c)), pushforward(f.phi, boundary(c))) << k << ", seed " << seed;
    }
    for_degrees<low - k>([&]<int q>(Constant<q>) {
      const auto v = random_integer_form<m, q>(f.L, seed + 2);
      EXPECT_EQ(wedge(pullback(f.phi, w), pullback(f.phi, v)), pullback(f.phi, wedge(w, v))) << k << " " << q;
    });
  });
}

TYPED_TEST(Pullback, CommutesWithDAndWedgeAndIsAdjointToThePushforward) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) expect_laws(TypeParam(), seed);
}

template <int n, int m>
void expect_functorial(Pair<n, m>, std::uint64_t seed) {
  const RandomMap<n, m> f(seed);
  const SimplicialComplex<m> M(meshes::sphere(m));
  const SimplicialMap<m, m> psi(f.L, M, random_images(f.L.size(0), M.size(0), seed + 5));
  const auto both = composition(psi, f.phi);
  for_degrees<std::min(n, m)>([&]<int k>(Constant<k>) {
    const auto w = random_integer_form<m, k>(M, seed);
    EXPECT_EQ(pullback(both, w), pullback(f.phi, pullback(psi, w))) << k << ", seed " << seed;
    const auto c = random_chain<n, k>(f.K, seed);
    EXPECT_EQ(pushforward(both, c), pushforward(psi, pushforward(f.phi, c))) << k << ", seed " << seed;
  });
}

TYPED_TEST(Pullback, IsFunctorial) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) expect_functorial(TypeParam(), seed);
}

/// The circle wrapped about a triangle, and a sphere turned, mirrored and folded.
TEST(PullbackOfVolume, MultipliesItByTheDegree) {
  const SimplicialComplex<1> circle(meshes::cycle(12)), triangle(meshes::cycle(3));
  const Form<1, 1> volume(triangle, {1, 2, 4});
  for (const int degree : {-4, -2, -1, 0, 1, 2, 4}) {
    std::vector<Index> images;
    for (Index v = 0; v < 12; ++v) {
      const Index steps = std::abs(degree) * v / 4 % 3;
      images.push_back(degree < 0 ? (3 - steps) % 3 : steps);
    }
    const SimplicialMap<1, 1> phi(circle, triangle, images);
    EXPECT_EQ(integral(pullback(phi, volume)), degree * integral(volume));
    EXPECT_EQ(pushforward(phi, fundamental_chain(circle)), degree * fundamental_chain(triangle));
  }
  const SimplicialComplex<3> sphere(meshes::sphere(3));
  const auto w = random_integer_form<3, 3>(sphere, 1);
  const SimplicialMap<3, 3> odd(sphere, sphere, {1, 0, 2, 3, 4}), even(sphere, sphere, {1, 2, 0, 3, 4}),
      folded(sphere, sphere, {0, 0, 2, 3, 4});
  EXPECT_EQ(integral(pullback(odd, w)), -integral(w));
  EXPECT_EQ(integral(pullback(even, w)), integral(w));
  EXPECT_EQ(integral(pullback(folded, w)), 0);
}

/// The intersection form of S^2 x S^2 from the two projections: the classes of the factors, each of volume 1.
TEST(PullbackOfVolume, GivesTheHyperbolicPlane) {
  const SimplicialComplex<2> sphere(meshes::sphere(2));
  const SimplicialComplex<4> K(meshes::product(meshes::sphere(2), meshes::sphere(2)));
  std::vector<Index> first, second;
  for (Index v = 0; v < K.size(0); ++v) {
    first.push_back(v / 4);
    second.push_back(v % 4);
  }
  const Form<2, 2> unit(sphere, {1, 0, 0, 0});
  const auto a = pullback(SimplicialMap<4, 2>(K, sphere, first), unit);
  const auto b = pullback(SimplicialMap<4, 2>(K, sphere, second), unit);
  EXPECT_NEAR(std::abs(integral(wedge(a, b))), 1, 1e-14);
  EXPECT_NEAR(integral(wedge(b, a)), integral(wedge(a, b)), 1e-14);
  EXPECT_EQ(integral(wedge(a, a)), 0);
  EXPECT_EQ(integral(wedge(b, b)), 0);
}

TEST(SimplicialMaps, AreChecked) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}, {1, 2, 3}, {3, 4}}), L(SimplexList{{0, 1, 2}, {1, 2, 3}});
  EXPECT_NO_THROW((SimplicialMap<2, 2>(K, L, {0, 1, 2, 3, 3})));
  EXPECT_NO_THROW((SimplicialMap<2, 2>(K, L, {0, 1, 2, 0, 0})));
  EXPECT_THROW((SimplicialMap<2, 2>(K, L, {0, 1, 3, 0, 0})), InputError) << "(0, 1, 3) is no triangle";
  EXPECT_THROW((SimplicialMap<2, 2>(K, L, {0, 1, 2, 3, 0})), InputError) << "the lone edge goes to (0, 3)";
  EXPECT_THROW((SimplicialMap<2, 2>(K, L, {0, 1, 2, 3, 4})), InputError);
  EXPECT_THROW((SimplicialMap<2, 2>(K, L, {0, 1, 2, 3})), InputError);
  EXPECT_THROW((SimplicialMap<2, 2>(K, L, {0, 1, 2, 3, -1})), InputError);
}

}  // namespace
}  // namespace derham
