#include "derham/complex/refinement.hpp"

#include "derham/boundary/boundary_complex.hpp"
#include "derham/boundary/manifold.hpp"
#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/classics.hpp"
#include "support/random_rows.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

namespace derham {
namespace {

template <class T>
class RefinementOf : public testing::Test {};
template <int value>
using Constant = std::integral_constant<int, value>;
using Dimensions = testing::Types<Constant<1>, Constant<2>, Constant<3>, Constant<4>>;
TYPED_TEST_SUITE(RefinementOf, Dimensions);

template <int n>
SimplicialComplex<n> random_complex(std::uint64_t seed) {
  support::Random random(seed);
  return SimplicialComplex<n>(
      support::simplex_list(seed % 3 == 0 ? support::random_mixed(n, random) : support::random_pure(n, random)));
}

/// The interior of a k-simplex holds as many fine j-simplices as a staircase count gives; summed by carriers.
TYPED_TEST(RefinementOf, CutsEverySimplexIntoTwoToTheKPieces) {
  constexpr int n = TypeParam::value;
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    const auto K = random_complex<n>(seed);
    const Refinement<n> refinement(K);
    const auto& fine = refinement.fine();
    EXPECT_EQ(fine.size(0), K.size(0) + K.size(1));
    EXPECT_EQ(fine.size(n), (1 << n) * K.size(n));
    EXPECT_EQ(fine.euler_characteristic(), K.euler_characteristic());
    EXPECT_EQ(fine.component_count(), K.component_count());
    EXPECT_EQ(fine.is_orientable(), K.is_orientable());
    EXPECT_EQ(fine.is_pure(), K.is_pure());
    for (int k = 0; k <= n; ++k) {
      std::vector<std::set<Index>> inside(static_cast<std::size_t>(K.size(k)));
      for (Index i = 0; i < fine.size(k); ++i) {
        const RowTarget carrier = refinement.carrier(k, i);
        ASSERT_GE(carrier.degree, k);
        ASSERT_GE(carrier.index, 0) << "the ends of the vertices of a fine simplex span a coarse one";
        if (carrier.degree == k) inside[static_cast<std::size_t>(carrier.index)].insert(i);
      }
      for (Index i = 0; i < K.size(k); ++i) {
        std::vector<Index> pieces;
        refinement.append_pieces(K.simplex(k, i), pieces);
        std::set<Index> found;
        const auto width = static_cast<std::size_t>(k) + 1;
        for (std::size_t p = 0; p < pieces.size(); p += width)
          found.insert(fine.at(std::span<const Index>(pieces).subspan(p, width)).index);
        EXPECT_EQ(found.size(), std::size_t{1} << k);
        EXPECT_EQ(found, inside[static_cast<std::size_t>(i)]) << "seed " << seed << ", degree " << k;
      }
    }
    for (Index t = 0; t < fine.size(n); ++t) EXPECT_EQ(refinement.carrier(n, t).index, t >> n);
  }
}

TYPED_TEST(RefinementOf, OrientsThePiecesAsTheirSimplices) {
  constexpr int n = TypeParam::value;
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    const auto K = random_complex<n>(seed);
    if (!K.is_orientable()) continue;
    const Refinement<n> refinement(K);
    for (Index t = 0; t < K.size(n); ++t) {
      std::vector<Index> pieces, tuple(K.simplex(n, t).begin(), K.simplex(n, t).end());
      refinement.append_pieces(tuple, pieces);
      for (std::size_t p = 0; p < pieces.size(); p += n + 1)
        EXPECT_EQ(refinement.fine().at(std::span<const Index>(pieces).subspan(p, n + 1)).sign, K.sign(n, t));
      pieces.clear();
      std::swap(tuple[0], tuple[1]);
      refinement.append_pieces(tuple, pieces);
      EXPECT_EQ(refinement.fine().at(std::span<const Index>(pieces).first(n + 1)).sign, -K.sign(n, t));
    }
  }
}

TEST(RefinedManifolds, StayManifoldsOfTheSameKind) {
  const SimplicialComplex<2> klein(meshes::klein_bottle()), strip(meshes::moebius_strip());
  const SimplicialComplex<3> sphere(meshes::sphere(3)), ball(meshes::box(3, 2).simplices);
  const auto expect_same = [](const auto& K) {
    constexpr int n = std::decay_t<decltype(K)>::dimension;
    const auto before = check_manifold(K);
    const Refinement<n> refinement(K);
    const auto after = check_manifold(refinement.fine());
    EXPECT_EQ(before.verdict, after.verdict);
    EXPECT_EQ(before.closed, after.closed);
    EXPECT_EQ(before.orientable, after.orientable);
    EXPECT_EQ(boundary_complex(K).complex.size(n - 1) << (n - 1),
              boundary_complex(refinement.fine()).complex.size(n - 1));
  };
  expect_same(klein);
  expect_same(strip);
  expect_same(sphere);
  expect_same(ball);
  expect_same(SimplicialComplex<4>(meshes::sphere(4)));
}

/// In dimension 2: three corners and the triangle of the midpoints.
TEST(RefinedTriangle, IsRed) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}});
  const Refinement<2> refinement(K);
  const auto& fine = refinement.fine();  // vertices 00, 01, 02, 11, 12, 22
  EXPECT_EQ(refinement.vertex(1), 3);
  EXPECT_EQ(refinement.ends(4), (std::array<Index, 2>{1, 2}));
  EXPECT_EQ(fine.size(2), 4);
  EXPECT_EQ(fine.at({0, 1, 2}).sign, 1);
  EXPECT_EQ(fine.at({1, 3, 4}).sign, 1);
  EXPECT_EQ(fine.at({2, 4, 5}).sign, 1);
  EXPECT_EQ(fine.at({1, 4, 2}).sign, 1);
}

TEST(RefinedComplex, NamesATupleThatIsNoSimplex) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}, {1, 2, 3}});
  const Refinement<2> refinement(K);
  std::vector<Index> out;
  EXPECT_THROW(refinement.append_pieces(std::vector<Index>{0, 3}, out), InputError);
  EXPECT_THROW(refinement.append_pieces(std::vector<Index>{0, 1, 2, 3}, out), InputError);
}

TEST(RefinedComplex, IsTheSameOnAnyNumberOfThreads) {
  const SimplicialComplex<3> K(meshes::box(3, 14).simplices);
  const int before = thread_count();
  set_thread_count(1);
  const Refinement<3> alone(K);
  for (const int threads : {2, 4}) {
    set_thread_count(threads);
    const Refinement<3> refinement(K);
    for (int k = 0; k <= 3; ++k)
      EXPECT_TRUE(std::ranges::equal(refinement.fine().simplices(k), alone.fine().simplices(k)));
    EXPECT_EQ(refinement.fine().orientation().sign, alone.fine().orientation().sign);
  }
  set_thread_count(before);
}

}  // namespace
}  // namespace derham
