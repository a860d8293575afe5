#include "derham/operators/de_rham_map.hpp"

#include "derham/core/parallel.hpp"
#include "derham/forms/exterior_derivative.hpp"
#include "derham/geometry/volumes.hpp"
#include "derham/meshes/balls.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/tori.hpp"
#include "geometry/mesh_kit.hpp"
#include "operators/polynomial.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <vector>

namespace derham {
namespace {

using Point = std::span<const double>;

template <int n>
struct Space {
  explicit Space(const MeshData& mesh) : K(mesh.simplices), g(Geometry<n>::from_mesh(K, mesh)) {}
  SimplicialComplex<n> K;
  Geometry<n> g;
};

template <class F>
void expect_near(const F& a, const F& b, double tolerance) {
  for (Index i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], tolerance) << i;
}

template <class T>
struct DeRham : testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                                  std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(DeRham, Dimensions);

template <int n>
MeshData random_mesh(std::uint32_t seed) {
  std::vector<Index> id;
  return test::shuffled(meshes::box(n, n < 4 ? 3 : 2, {.jitter = 0.4 / n, .seed = seed}), seed, id);
}

/// R(dω) = d(Rω) for polynomial ω of every degree k < n, in space of any dimension.
template <int n>
void expect_stokes(const Space<n>& space, std::uint32_t seed) {
  const int m = space.g.ambient_dimension();
  [&]<int... k>(std::integer_sequence<int, k...>) {
    (
        [&] {
          constexpr int degree = 3;
          const auto w = test::random_form<k>(m, degree, seed);
          const DeRhamMap<n> R(space.K, space.g, degree);
          expect_near(d(R.template components<k>(w)), R.template components<k + 1>(test::d(w)), 1e-13);
        }(),
        ...);
  }(std::make_integer_sequence<int, n>{});
}

TYPED_TEST(DeRham, CommutesWithTheExteriorDerivativeOnPolynomials) {
  constexpr int n = TypeParam::value;
  for (const std::uint32_t seed : {1, 2, 3}) {
    const MeshData mesh = random_mesh<n>(seed);
    expect_stokes(Space<n>(mesh), seed);
    expect_stokes(Space<n>(test::moved(mesh, n + 1, 1, 0.5, seed)), seed);
  }
}

TYPED_TEST(DeRham, GivesDensitiesAndFluxesTheirSigns) {
  constexpr int n = TypeParam::value;
  const Space<n> space(random_mesh<n>(5));
  const auto field = test::random_form<1>(n, 2, 7);
  const auto divergence = [&](Point x) {
    double sum = 0;
    for (int c = 0; c < n; ++c) sum += field.component[static_cast<std::size_t>(c)].derivative(c)(x);
    return sum;
  };
  const DeRhamMap<n> R(space.K, space.g, 2);
  expect_near(d(R.flux(field)), R.density(divergence), 1e-14);
  const auto one = R.density([](Point) { return 1.0; });
  const auto signed_volume = signed_volumes(space.K, space.g);
  for (Index t = 0; t < space.K.size(n); ++t)
    EXPECT_NEAR(one[t], space.K.sign(n, t) * signed_volume[static_cast<std::size_t>(t)], 1e-15);
}

/// Values at the nodes instead of a function: the same bits, in the space of the complex and in a larger one.
template <int n>
void expect_same_of_nodes(const Space<n>& space) {
  const int m = space.g.ambient_dimension();
  const DeRhamMap<n> R(space.K, space.g, 3);
  [&]<int... k>(std::integer_sequence<int, k...>) {
    (
        [&] {
          const auto w = test::random_form<k>(m, 2, 11);
          const std::vector<double> nodes = R.template nodes<k>();
          std::vector<double> values;
          for (std::size_t i = 0; i < nodes.size(); i += static_cast<std::size_t>(m)) {
            const auto value = w(Point(nodes).subspan(i, static_cast<std::size_t>(m)));
            values.insert(values.end(), value.begin(), value.end());
          }
          EXPECT_EQ(R.template components_at_nodes<k>(values), R.template components<k>(w)) << k;
          values.push_back(0);
          EXPECT_THROW((void)R.template components_at_nodes<k>(values), InputError);
        }(),
        ...);
  }(std::make_integer_sequence<int, n + 1>{});
}

TYPED_TEST(DeRham, TakesValuesAtItsNodes) {
  constexpr int n = TypeParam::value;
  expect_same_of_nodes(Space<n>(random_mesh<n>(4)));
  expect_same_of_nodes(Space<n>(test::moved(random_mesh<n>(4), n + 1, 1, 0.5, 6)));
}

TYPED_TEST(DeRham, CirculationIsTheGradientTheoremAndFormsAgreeWithComponents) {
  constexpr int n = TypeParam::value;
  const Space<n> space(test::moved(random_mesh<n>(2), n + 2, 1, 1, 3));
  const int m = n + 2;
  const auto f = test::random_form<0>(m, 4, 3);
  const DeRhamMap<n> R(space.K, space.g, 3);
  const auto values = R.function(f.component[0]);
  expect_near(R.circulation(test::d(f)), d(values), 1e-12);
  [&]<int... k>(std::integer_sequence<int, k...>) {
    (
        [&] {
          const auto w = test::random_form<k>(m, 2, 9);
          const auto evaluate = [&](Point x, std::span<const double> edges) {
            std::array<const double*, static_cast<std::size_t>(k)> rows{};
            for (std::size_t i = 0; i < k; ++i) rows[i] = edges.data() + i * static_cast<std::size_t>(m);
            double sum = 0;
            const auto columns = subsets<k>(m);
            for (std::size_t i = 0; i < columns.size(); ++i) sum += w(x)[i] * minor_of<k>(rows, columns[i]);
            return sum;
          };
          expect_near(R.template form<k>(evaluate), R.template components<k>(w), 1e-14);
        }(),
        ...);
  }(std::make_integer_sequence<int, n + 1>{});
}

TYPED_TEST(DeRham, HasTheSameBitsOnAnyNumberOfThreads) {
  constexpr int n = TypeParam::value;
  const Space<n> space(meshes::box(n, n == 1 ? 2000 : n == 2 ? 30 : n == 3 ? 8 : 4, {.jitter = 0.2 / n}));
  const DeRhamMap<n> R(space.K, space.g, 2);
  const auto w = test::random_form<1>(n, 2, 1);
  const int before = thread_count();
  set_thread_count(1);
  const auto expected = R.circulation(w);
  ASSERT_GT(expected.size(), 1024);
  for (const int threads : {2, 4}) {
    set_thread_count(threads);
    EXPECT_EQ(R.circulation(w), expected);
  }
  set_thread_count(before);
}

TEST(DeRham, DensityOnASurfaceIsItsArea) {
  const Space<2> space(meshes::torus(12, 9));
  const DeRhamMap<2> R(space.K, space.g, 0);
  const auto area = primal_volumes(space.K, space.g)[2];
  const auto one = R.density([](Point) { return 1.0; });
  for (Index t = 0; t < one.size(); ++t) EXPECT_NEAR(one[t], area[static_cast<std::size_t>(t)], 1e-15);
}

TEST(DeRham, DensityOnACurveOfAnyScale) {
  for (const double scale : {5e-170, 1.0, 5e160}) {
    const SimplicialComplex<1> K(SimplexList{{0, 1}});
    const auto geometry = Geometry<1>::from_points(K, {0, 0, 3 * scale, 4 * scale}, 2);
    EXPECT_NEAR(DeRhamMap<1>(K, geometry, 0).density([](Point) { return 1.0; })[0] / scale, 5, 1e-14);
  }
}

// 4π through any surface about the origin: Gauss's law.
TEST(DeRham, ConvergesForSmoothFieldsWithTheOrder) {
  const Space<2> space(meshes::icosphere(2));
  const auto angle = [](Point x, std::span<const double> e) {
    const double r = std::hypot(x[0], x[1], x[2]);
    return (x[0] * (e[1] * e[5] - e[2] * e[4]) + x[1] * (e[2] * e[3] - e[0] * e[5]) +
            x[2] * (e[0] * e[4] - e[1] * e[3])) /
           (r * r * r);
  };
  double before = 1;
  for (const int order : {2, 6, 10, 16}) {
    const auto w = DeRhamMap<2>(space.K, space.g, order).form<2>(angle);
    double sum = 0;
    for (const double x : w.values()) sum += x;
    const double error = std::abs(sum - 4 * std::numbers::pi);
    EXPECT_LT(error, before / 10);
    before = std::max(error, 1e-12);
  }
  EXPECT_LT(before, 2e-12);
}

TEST(DeRham, TakesPeriodicFieldsOnPeriodicMeshes) {
  const Space<2> space(meshes::periodic_box(2, 6));
  const auto f = [](Point x) { return std::sin(2 * std::numbers::pi * x[0]); };
  const auto gradient = [](Point x) {
    return std::array{2 * std::numbers::pi * std::cos(2 * std::numbers::pi * x[0]), 0.0};
  };
  const DeRhamMap<2> R(space.K, space.g, 20);
  expect_near(d(R.function(f)), R.circulation(gradient), 1e-13);
}

TEST(DeRham, RefusesWhatDoesNotFit) {
  const Space<2> flat(meshes::box(2, 2)), curved(meshes::icosphere(0));
  EXPECT_THROW(DeRhamMap<2>(flat.K, flat.g, -1), InputError);
  EXPECT_THROW(DeRhamMap<2>(curved.K, flat.g, 1), InputError);
  const auto lengths = Geometry<2>::from_squared_lengths(flat.K, squared_lengths(flat.K, flat.g));
  EXPECT_THROW(DeRhamMap<2>(flat.K, lengths, 1), GeometryError);
  const DeRhamMap<2> R(curved.K, curved.g, 1);
  EXPECT_THROW((void)R.flux([](Point) { return std::array{1.0, 0.0, 0.0}; }), GeometryError);
  EXPECT_THROW((void)R.circulation([](Point) { return std::array{1.0, 0.0}; }), InputError);
  EXPECT_THROW((void)R.components<2>([](Point) { return std::vector<double>(2); }), InputError);
  const SimplicialComplex<2> moebius(SimplexList{{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 0}, {4, 0, 1}});
  const auto g = Geometry<2>::from_points(moebius, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}, 3);
  EXPECT_THROW((void)DeRhamMap<2>(moebius, g, 1).density([](Point) { return 1.0; }), TopologyError);
}

}  // namespace
}  // namespace derham
