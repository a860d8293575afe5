#include "derham/hodge/hodge_star.hpp"

#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/dual/circumcentric.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/lattices.hpp"
#include "geometry/mesh_kit.hpp"
#include "support/random_values.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace derham {
namespace {

template <int n>
struct Space {
  explicit Space(const MeshData& mesh) : K(mesh.simplices), g(Geometry<n>::from_mesh(K, mesh)), star(K, g) {}
  SimplicialComplex<n> K;
  Geometry<n> g;
  HodgeStar<n> star;
};

template <class F>
F random_form(const SimplicialComplex<F::dimension>& K) {
  F form(K);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (double& x : form.values()) x = normal(random);
  return form;
}

template <class F>
double distance(const F& a, const F& b) {
  double largest = 0;
  for (Index i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

template <class T>
struct Hodge : testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                                  std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(Hodge, Dimensions);

TYPED_TEST(Hodge, InverseUndoesItAndStarStarHasItsSign) {
  constexpr int n = TypeParam::value;
  const Space<n> space(meshes::a_star_lattice(n, 3));
  [&]<int... k>(std::integer_sequence<int, k...>) {
    (
        [&] {
          const auto w = random_form<PrimalForm<n, k>>(space.K);
          const auto dual = space.star(w);
          static_assert(std::is_same_v<decltype(dual), const DualForm<n, n - k>>);
          EXPECT_LT(distance(space.star.inverse(dual), w), 1e-13);
          EXPECT_LT(distance(space.star(dual), (k * (n - k) % 2 == 0 ? 1.0 : -1.0) * w), 1e-13);
        }(),
        ...);
  }(std::make_integer_sequence<int, n + 1>{});
}

TYPED_TEST(Hodge, ScalesWithLengthToTheNMinusTwoK) {
  constexpr int n = TypeParam::value;
  const MeshData mesh = meshes::box(n, 2, {.jitter = 0.4 / n});
  const double s = 1e-3;
  const Space<n> a(mesh), b(test::moved(mesh, n + 1, s, s, 3));
  for (int k = 0; k <= n; ++k)
    for (std::size_t i = 0; i < a.star.diagonal(k).size(); ++i)
      EXPECT_NEAR(b.star.diagonal(k)[i] * std::pow(s, 2 * k - n), a.star.diagonal(k)[i],
                  1e-9 * (1 + std::abs(a.star.diagonal(k)[i])));
}

// The star of the top degree takes volumes to ones, whatever the orientation of the tuples.
TEST(Hodge, OfTheVolumeFormIsOne) {
  std::vector<Index> id;
  const Space<3> space(test::shuffled(meshes::box(3, 2, {.jitter = 0.2}), 1, id));
  const auto volume = primal_volumes(space.K, space.g);
  const PrimalForm<3, 3> form(space.K, volume[3]);
  const auto one = space.star(form);
  for (const double x : one.values()) EXPECT_NEAR(x, 1, 1e-14);
}

TEST(Hodge, ZeroEntriesHaveNoInverse) {
  const Space<2> space(meshes::box(2, 2));
  EXPECT_NO_THROW((void)space.star.inverse_diagonal(0));
  EXPECT_NO_THROW((void)space.star(random_form<PrimalForm<2, 1>>(space.K)));
  try {
    (void)space.star.inverse(DualForm<2, 1>(space.K));
    FAIL();
  } catch (const GeometryError& error) {
    EXPECT_NE(std::string(error.what()).find("4 dual volumes are zero"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("(0, 4)"), std::string::npos) << error.what();
  }
}

TEST(Hodge, RefusesWhatIsNotOrientable) {
  const SimplicialComplex<2> moebius(SimplexList{{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 0}, {4, 0, 1}});
  const auto g = Geometry<2>::from_points(moebius, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}, 3);
  try {
    (void)HodgeStar<2>(moebius, g);
    FAIL();
  } catch (const TopologyError& error) {
    EXPECT_NE(std::string(error.what()).find("(0, 1, 2)"), std::string::npos) << error.what();
  }
}

TEST(Hodge, RefusesFlatSimplicesByName) {
  const SimplicialComplex<3> K(SimplexList{{0, 1, 2, 3}});
  const auto g = Geometry<3>::from_points(K, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, 3);
  try {
    (void)HodgeStar<3>(K, g);
    FAIL();
  } catch (const GeometryError& error) {
    EXPECT_NE(std::string(error.what()).find("(0, 1, 2, 3)"), std::string::npos) << error.what();
  }
}

TEST(Hodge, RefusesEntriesOutOfTheRangeOfDoublesByName) {
  const SimplicialComplex<3> K(SimplexList{{0, 1, 2, 3}});
  for (const double s : {1e-110, 1e120}) {
    try {
      (void)HodgeStar<3>(K, Geometry<3>::from_points(K, {0, 0, 0, s, 0, 0, 0, s, 0, 0, 0, s}, 3));
      FAIL() << s;
    } catch (const GeometryError& error) {
      EXPECT_NE(std::string(error.what()).find("0-simplex 0"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("range of doubles"), std::string::npos) << error.what();
    }
  }
}

TEST(Hodge, RefusesFormsOfOtherComplexesAndWrongDegrees) {
  const Space<2> a(meshes::box(2, 2)), b(meshes::box(2, 2));
  EXPECT_THROW((void)a.star(PrimalForm<2, 1>(b.K)), InputError);
  EXPECT_THROW((void)a.star.diagonal(3), InputError);
  EXPECT_THROW((void)a.star.diagonal(-1), InputError);
}

// The entries are dual volumes over volumes, and the same bits for any number of threads, in any order of the vertices.
TEST(HodgeStar, EntriesDoNotDependOnThreads) {
  const int before = thread_count();
  std::vector<Index> id;
  for (const bool in_order : {true, false}) {
    const MeshData box = meshes::box(3, 17, {.jitter = 0.1});
    const MeshData mesh = in_order ? box : test::shuffled(box, 1, id);
    set_thread_count(1);
    const Space<3> space(mesh);
    const auto volumes = circumcentric_dual(space.K, space.g);
    for (const int threads : {1, 2, 4}) {
      set_thread_count(threads);
      const HodgeStar<3> star(space.K, space.g);
      for (int k = 0; k <= 3; ++k) {
        const auto entries = star.diagonal(k);
        ASSERT_EQ(entries.size(), volumes.dual[k].size());
        for (std::size_t i = 0; i < entries.size(); ++i)
          ASSERT_EQ(entries[i], volumes.dual[k][i] / volumes.primal[k][i]) << k << ' ' << i << ' ' << threads;
      }
    }
  }
  set_thread_count(before);
}

TEST(HodgeStar, AppliesItselfAndItsInverseToSeveralVectorsOnAnyNumberOfThreads) {
  const int before = thread_count();
  const Space<3> space(meshes::a_star_lattice(3, 9));
  for (int k = 0; k <= 3; ++k) {
    const auto star = space.star.diagonal(k);
    const auto inverse = space.star.inverse_diagonal(k);
    for (const std::size_t columns : {1u, 3u}) {
      const auto x = support::random_values(static_cast<Offset>(star.size() * columns), 1);
      std::vector<double> times = x, over = x, y(x.size());
      for (std::size_t i = 0; i < x.size(); ++i) {
        times[i] *= star[i / columns];
        over[i] *= inverse[i / columns];
      }
      for (const int threads : {1, 2, 4}) {
        set_thread_count(threads);
        space.star.apply(k, x, y, static_cast<Index>(columns));
        EXPECT_EQ(y, times);
        space.star.apply_inverse(k, x, y, static_cast<Index>(columns));
        EXPECT_EQ(y, over);
      }
      y = x;
      space.star.apply(k, y, y, static_cast<Index>(columns));
      EXPECT_EQ(y, times) << "in place";
    }
  }
  std::vector<double> x(static_cast<std::size_t>(space.K.size(1))), short_one(3);
  EXPECT_THROW(space.star.apply(4, x, x), InputError);
  EXPECT_THROW(space.star.apply(0, x, x), InputError);
  EXPECT_THROW(space.star.apply(1, x, short_one), InputError);
  EXPECT_THROW(space.star.apply_inverse(1, short_one, x), InputError);
  set_thread_count(before);
}

}  // namespace
}  // namespace derham
