#include "derham/dual/power.hpp"

#include "derham/boundary/boundary_complex.hpp"
#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/dual/dual_report.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/lattices.hpp"
#include "derham/meshes/tori.hpp"
#include "geometry/mesh_kit.hpp"
#include "support/random_values.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace derham {
namespace {

template <int n>
struct Mesh {
  explicit Mesh(const MeshData& mesh) : K(mesh.simplices), g(Geometry<n>::from_mesh(K, mesh)) {}
  SimplicialComplex<n> K;
  Geometry<n> g;
};

std::vector<double> random_weights(Index size, double scale, std::uint64_t seed = 1) {
  auto weights = support::random_values(size, seed);
  for (double& w : weights) w *= scale;
  return weights;
}

template <int n>
void expect_near(const ByDegree<n>& a, const ByDegree<n>& b, double tolerance) {
  for (int k = 0; k <= n; ++k)
    for (std::size_t i = 0; i < a[k].size(); ++i) {
      EXPECT_NEAR(a[k][i], b[k][i], tolerance) << k << ' ' << i;
      EXPECT_TRUE(a[k][i] != 0 || b[k][i] == 0) << k << ' ' << i;
    }
}

template <class T>
struct PowerDual : testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                                  std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(PowerDual, Dimensions);

TYPED_TEST(PowerDual, ZeroAndConstantWeightsGiveTheCircumcentricDual) {
  constexpr int n = TypeParam::value;
  for (const double jitter : {0.0, 0.5 / n})
    for (const int m : {n, n + 2}) {
      std::vector<Index> id;
      const Mesh<n> mesh(test::moved(test::shuffled(meshes::box(n, 3, {.jitter = jitter}), 1, id), m, 1, 1, 2));
      const auto expected = circumcentric_dual(mesh.K, mesh.g);
      expect_near<n>(power_dual(mesh.K, mesh.g, {}).dual, expected.dual, 1e-12);
      const std::vector<double> same(static_cast<std::size_t>(mesh.K.size(0)), 0.7);
      const auto power = power_dual(mesh.K, mesh.g, same);
      expect_near<n>(power.dual, expected.dual, 1e-12);
      EXPECT_EQ(power.well_centered, expected.well_centered);
      EXPECT_EQ(power.degenerate, expected.degenerate);
    }
  const Mesh<n> lattice(meshes::a_star_lattice(n, 3));
  EXPECT_TRUE(power_dual(lattice.K, lattice.g, {}).well_centered);
}

// Σ |σ| D(σ) = C(n,k) Σ a_T |T|, also with zeros and negative numbers.
TYPED_TEST(PowerDual, VolumeIdentityForAllWeightsAndMaterials) {
  constexpr int n = TypeParam::value;
  for (const MeshData& data : {meshes::box(n, 3, {.jitter = 0.8 / n}), meshes::periodic_box(n, 3, {.jitter = 0.8 / n}),
                               test::moved(meshes::box(n, 2, {.jitter = 0.2}), n + 1, 1e-3, 1e-3, 1)}) {
    const Mesh<n> mesh(data);
    const double length = std::pow(total_volume(mesh.K, mesh.g) / static_cast<double>(mesh.K.size(n)), 1.0 / n);
    const auto weights = random_weights(mesh.K.size(0), length * length / 5);
    const Material material{.values = support::random_values(mesh.K.size(n), 2)};
    const auto dual = power_dual(mesh.K, mesh.g, weights, material);
    double weighed = 0, size = 0;
    for (Index t = 0; t < mesh.K.size(n); ++t) weighed += *material.of(t) * dual.primal[n][t];
    for (int k = 0; k <= n; ++k) {
      double sum = 0;
      size = 0;
      for (Index i = 0; i < mesh.K.size(k); ++i) {
        sum += dual.primal[k][i] * dual.dual[k][i];
        size += std::abs(dual.primal[k][i] * dual.dual[k][i]);
      }
      EXPECT_NEAR(sum, static_cast<double>(binomial(n, k)) * weighed, 1e-11 * size) << "k = " << k;
    }
  }
}

// Weights 2<a, p> move all centres by -a: what is inside keeps its volumes.
TYPED_TEST(PowerDual, LinearWeightsMoveTheCells) {
  constexpr int n = TypeParam::value;
  const Mesh<n> mesh(meshes::box(n, 4, {.jitter = 0.5 / n}));
  std::vector<double> weights(static_cast<std::size_t>(mesh.K.size(0)));
  for (std::size_t v = 0; v < weights.size(); ++v)
    for (std::size_t c = 0; c < n; ++c)
      weights[v] += 2 * 0.03 * (static_cast<double>(c) + 1) * mesh.g.points()[v * n + c];
  const auto before = circumcentric_dual(mesh.K, mesh.g).dual, after = power_dual(mesh.K, mesh.g, weights).dual;
  const auto boundary = boundary_complex(mesh.K);
  for (int k = 0; k <= n; ++k) {
    std::vector<bool> inside(before[k].size(), true);
    if (k < n)
      for (Index i = 0; i < boundary.complex.size(k); ++i)
        inside[static_cast<std::size_t>(boundary.inclusion[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)])] =
            false;
    double moved = 0;
    for (std::size_t i = 0; i < before[k].size(); ++i) {
      const double difference = std::abs(after[k][i] - before[k][i]);
      EXPECT_TRUE(!inside[i] || difference < 1e-12) << k << ' ' << i;
      moved += difference;
    }
    EXPECT_TRUE(k == n || moved > 1e-3);
  }
}

TYPED_TEST(PowerDual, IsInvariantUnderRelabellingAndScales) {
  constexpr int n = TypeParam::value;
  const MeshData data = meshes::box(n, 3, {.jitter = 0.5 / n});
  std::vector<Index> id;
  for (const double s : {37.0, 1e-40}) {
    const Mesh<n> mesh(data), other(test::shuffled(test::moved(data, n + 1, s, 0, 2), 3, id));
    const auto weights = random_weights(mesh.K.size(0), 0.02);
    std::vector<double> moved(weights.size());
    for (std::size_t v = 0; v < weights.size(); ++v) moved[static_cast<std::size_t>(id[v])] = weights[v] * s * s;
    const auto a = power_dual(mesh.K, mesh.g, weights).dual, b = power_dual(other.K, other.g, moved).dual;
    for (int k = 0; k <= n; ++k)
      for (Index i = 0; i < mesh.K.size(k); ++i) {
        std::vector<Index> alias;
        for (const Index v : mesh.K.simplex(k, i)) alias.push_back(id[v]);
        EXPECT_NEAR(b[k][other.K.at(alias).index] / std::pow(s, n - k), a[k][i], 1e-10);
      }
  }
}

TEST(PowerDual, KnownAnswers) {
  const Mesh<1> edge(test::single({0, 1}, 1));
  const auto halves = power_dual(edge.K, edge.g, std::vector<double>{0.2, -0.1}).dual[0];
  EXPECT_NEAR(halves[0], 0.65, 1e-15) << "x² - 0.2 = (1-x)² + 0.1";
  EXPECT_NEAR(halves[1], 0.35, 1e-15);
  const Mesh<2> right(test::single({0, 0, 1, 0, 0, 1}, 2));
  const double w = 0.1;
  const auto dual = power_dual(right.K, right.g, std::vector<double>{w, 0, 0}).dual;
  EXPECT_NEAR(dual[1][0], (1 + w) / 2, 1e-15);
  EXPECT_NEAR(dual[1][1], (1 + w) / 2, 1e-15);
  EXPECT_NEAR(dual[1][2], -w / std::sqrt(2), 1e-15);
  EXPECT_NEAR(dual[0][0], (1 + w) * (1 + w) / 4, 1e-15);
}

TEST(PowerDual, MaterialsByTagWeighThePartsOfTheCells) {
  const Mesh<1> two(meshes::box(1, 2));
  const Material material{.values = {3, 5}, .row_of = {0, 1}};
  const auto dual = power_dual(two.K, two.g, {}, material).dual;
  EXPECT_EQ(dual[1], (std::vector<double>{3, 5}));
  EXPECT_NEAR(dual[0][1], 0.25 * 3 + 0.25 * 5, 1e-15);
  const auto barycentric = barycentric_dual_volumes(two.K, two.g, material);
  EXPECT_NEAR(barycentric[0][1], 2, 1e-15);
}

TEST(PowerDual, FlatSimplicesHaveNone) {
  const SimplicialComplex<3> K(SimplexList{{0, 1, 2, 3}, {3, 4, 5, 6}});
  const auto g = Geometry<3>::from_points(K, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0, 1, 2, 0, 1, 1, 1}, 3);
  const auto fast = circumcentric_dual(K, g), slow = power_dual(K, g, {});
  EXPECT_EQ(slow.degenerate, fast.degenerate);
  for (int k = 0; k <= 3; ++k)
    for (Index i = 0; i < K.size(k); ++i) EXPECT_EQ(std::isnan(slow.dual[k][i]), std::isnan(fast.dual[k][i]));
}

TEST(PowerDual, SameBitsForAnyNumberOfThreads) {
  const int before = thread_count();
  const Mesh<3> mesh(meshes::box(3, 8, {.jitter = 0.3}));
  const auto weights = random_weights(mesh.K.size(0), 1e-3);
  set_thread_count(1);
  const auto one = power_dual(mesh.K, mesh.g, weights).dual;
  for (const int threads : {2, 4}) {
    set_thread_count(threads);
    EXPECT_EQ(power_dual(mesh.K, mesh.g, weights).dual, one);
  }
  set_thread_count(before);
}

TEST(PowerDual, OfWeightsBeyondTheRangeIsUndefinedRatherThanZero) {
  const Mesh<2> mesh(meshes::box(2, 2, {.jitter = 0.2}));
  std::vector<double> weights(9);
  for (const double huge : {1e200, 1e307}) {
    weights[4] = huge;
    const auto dual = power_dual(mesh.K, mesh.g, weights).dual;
    EXPECT_TRUE(std::isnan(dual[0][4])) << dual[0][4];
  }
}

TEST(PowerDual, RefusesWhatDoesNotFit) {
  const Mesh<2> mesh(meshes::box(2, 2));
  EXPECT_THROW((void)power_dual(mesh.K, mesh.g, std::vector<double>{1, 2}), InputError);
  std::vector<double> weights(9);
  weights[4] = std::numeric_limits<double>::infinity();
  EXPECT_THROW((void)power_dual(mesh.K, mesh.g, weights), InputError);
  EXPECT_THROW((void)power_dual(mesh.K, mesh.g, {}, Material{.values = {1, 2}}), InputError);
  const Material tensor{.values = {1, 0, 0, 1}, .width = 2};
  EXPECT_THROW((void)power_dual(mesh.K, mesh.g, {}, tensor), InputError);
  EXPECT_THROW((void)barycentric_dual_volumes(mesh.K, mesh.g, tensor), InputError);
}

}  // namespace
}  // namespace derham
