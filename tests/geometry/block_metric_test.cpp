// The closed formulas, and the choice between them and orthogonalisation, against SimplexMetric on every simplex.
#include "derham/geometry/block_metric.hpp"

#include "derham/geometry/quality.hpp"
#include "derham/geometry/volumes.hpp"
#include "derham/meshes/boxes.hpp"
#include "geometry/mesh_kit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <random>
#include <vector>

namespace derham {
namespace {

// Single simplices, each with vertices of its own: random ones, and flattened, stretched and shrunk ones.
template <int n>
MeshData shapes(int count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<int> exponent(-16, 0), axis(0, n - 1), kind(0, 3);
  MeshData mesh;
  mesh.ambient_dimension = n;
  std::vector<Index> row(n + 1);
  for (int s = 0; s < count; ++s) {
    std::vector<double> scale(n, 1.0);
    const int how = kind(random);
    if (how >= 1) scale[static_cast<std::size_t>(axis(random))] = std::pow(10.0, exponent(random));
    if (how == 2)
      for (double& x : scale) x *= 1e-6;
    for (Index& v : row) {
      v = mesh.vertex_count++;
      for (const double x : scale) mesh.points.push_back(x * normal(random));
    }
    mesh.simplices.push_back(row);
  }
  return mesh;
}

template <int n, int k>
void measure(const BlockMetric<n>& metric, Index begin, Index end, MetricBlock<k>& block) {
  std::vector<Index> simplices(static_cast<std::size_t>(end - begin));
  std::iota(simplices.begin(), simplices.end(), begin);
  metric.template measure<k>(simplices, block);
}

// Volume, heights over circumradius, and whether it is degenerate.
template <int k>
void expect_agrees(const MetricBlock<k>& block, std::size_t i, double unit, const SimplexMetric<k>& exact,
                   double condition) {
  const double tolerance = 64 * std::numeric_limits<double>::epsilon() * condition;
  const double volume = exact.volume[full_mask<k>], radius = exact.radius[full_mask<k>] * exact.unit;
  EXPECT_NEAR(block.volume[i] / volume, 1, tolerance);
  for (std::size_t v = 0; v <= k; ++v) {
    const double h = exact.height[full_mask<k>][v] * exact.unit;
    const double given = block.height[v][i] * unit, rounding = block.rounding[i] * unit;
    const double zeroed = given == 0 ? (1e-10 * radius + rounding) * (1 + 1e-12) : 0;
    EXPECT_NEAR(given, h, tolerance * radius + zeroed) << "corner " << v << ", condition " << condition;
  }
}

template <int n>
void expect_top_simplices_agree(const MeshData& mesh) {
  const SimplicialComplex<n> K(mesh.simplices);
  const auto g = Geometry<n>::from_mesh(K, mesh);
  const int d = g.coordinate_dimension();
  const BlockMetric<n> metric(K, g);
  const auto block = std::make_unique<MetricBlock<n>>();
  std::vector<double> volumes(static_cast<std::size_t>(K.size(n))), scratch(static_cast<std::size_t>(n * d));
  std::vector<Index> degenerate, expected;
  for (Index begin = 0; begin < K.size(n); begin += 101) {
    const Index end = std::min<Index>(begin + 101, K.size(n));
    measure(metric, begin, end, *block);
    metric.template measure_volumes<n>(begin, end, volumes.data() + begin, degenerate);
    for (Index t = begin; t < end; ++t) {
      const auto corners = g.corners(K, t);
      const auto i = static_cast<std::size_t>(t - begin);
      const SimplexMetric<n> exact(corners, d, g.relative_flatness(), g.roundoff(corners), scratch.data());
      EXPECT_EQ(std::ranges::count(block->degenerate, t), exact.degenerate ? 1 : 0);
      const int sign = g.has_signed_volume() ? orientation_sign<n>(corners) : 1;
      EXPECT_EQ(volumes[static_cast<std::size_t>(t)], sign * block->volume[i]);
      EXPECT_DOUBLE_EQ(block->rounding[i] * metric.unit(), g.roundoff(corners));
      if (exact.degenerate) {
        expected.push_back(t);
        EXPECT_TRUE(std::isnan(block->height[0][i]));
        continue;
      }
      double longest = 0;
      for (unsigned mask = 1; mask <= full_mask<n>; ++mask)
        if (mask_degree(mask) == 1) longest = std::max(longest, exact.volume[mask]);
      const double condition =
          std::pow(longest / exact.unit, n) /
          (static_cast<double>(factorial(n)) * exact.volume[full_mask<n>] / std::pow(exact.unit, n));
      expect_agrees<n>(*block, i, metric.unit(), exact, condition);
    }
  }
  EXPECT_EQ(degenerate, expected);
}

template <class T>
struct BlockMetrics : testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                                  std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(BlockMetrics, Dimensions);

TYPED_TEST(BlockMetrics, AgreeOnShapesOfEveryKind) {
  constexpr int n = TypeParam::value;
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    const MeshData mesh = shapes<n>(777, seed);
    expect_top_simplices_agree<n>(mesh);
    for (const double scale : {1e-60, 1.0, 1e40})
      for (const int m : {n, n + 1, n + 2}) expect_top_simplices_agree<n>(test::moved(mesh, m, scale, scale, seed));
  }
}

TYPED_TEST(BlockMetrics, AgreeOnLengthsAndOnCharts) {
  constexpr int n = TypeParam::value;
  const MeshData mesh = meshes::periodic_box(n, 3, {.jitter = 0.6 / n});
  expect_top_simplices_agree<n>(mesh);
  const SimplicialComplex<n> K(mesh.simplices);
  const auto charts = Geometry<n>::from_mesh(K, mesh);
  const auto lengths = Geometry<n>::from_squared_lengths(K, squared_lengths(K, charts));
  const BlockMetric<n> a(K, charts), b(K, lengths);
  [&]<int... i>(std::integer_sequence<int, i...>) {
    (
        [&] {
          constexpr int k = i + 1;
          const auto x = std::make_unique<MetricBlock<k>>(), y = std::make_unique<MetricBlock<k>>();
          const Index size = std::min<Index>(K.size(k), MetricBlock<k>::capacity);
          measure(a, 0, size, *x);
          measure(b, 0, size, *y);
          for (std::size_t s = 0; s < static_cast<std::size_t>(size); ++s) {
            EXPECT_NEAR(x->volume[s], y->volume[s], 1e-12);
            EXPECT_EQ(y->rounding[s], 0);
            for (std::size_t v = 0; v <= k; ++v) EXPECT_NEAR(x->height[v][s], y->height[v][s], 1e-10);
          }
        }(),
        ...);
  }(std::make_integer_sequence<int, n>{});
}

// The volume of a tetrahedron with edges of 2^-400 is no double, its sign is.
TEST(BlockMetrics, SignsOutliveTheRangeOfDoubles) {
  MeshData mesh = meshes::box(3, 3);
  mesh.points[3 * (1 + 4 * (1 + 4 * 1))] += 0.9;
  SimplicialComplex<3> K(mesh.simplices);
  const auto plain = oriented_quality(K, Geometry<3>::from_points(K, mesh.points, 3));
  EXPECT_GT(plain.inverted.size(), 0U);
  for (double& x : mesh.points) x = std::ldexp(x, -400);
  const auto tiny = oriented_quality(K, Geometry<3>::from_points(K, mesh.points, 3));
  EXPECT_EQ(tiny.largest_volume, 0);
  EXPECT_EQ(tiny.inverted, plain.inverted);
  EXPECT_TRUE(tiny.degenerate.empty());
}

// A small sound simplex beside a large one is measured in its own units.
TEST(BlockMetrics, SimplicesOfAnySizeSideBySide) {
  const double s = 0x1p-150, b = 0x1p90;
  MeshData mesh;
  mesh.ambient_dimension = 3;
  mesh.vertex_count = 7;
  mesh.simplices = SimplexList{{0, 1, 2, 3}, {0, 4, 5, 6}};
  mesh.points = {0, 0, 0, b, 0, 0, 0, b, 0, 0, 0, b, s, 0, 0, 0, s, 0, 0, 0, s};
  const SimplicialComplex<3> K(mesh.simplices);
  const auto g = Geometry<3>::from_mesh(K, mesh);
  const BlockMetric<3> metric(K, g);
  MetricBlock<3> block;
  measure(metric, 0, 2, block);
  EXPECT_TRUE(block.degenerate.empty());
  for (std::size_t v = 1; v <= 3; ++v) EXPECT_NEAR(block.height[v][1] / s, 0.5, 1e-15);
  EXPECT_NEAR(block.volume[1] / (s * s * s), 1. / 6, 1e-15);
}

}  // namespace
}  // namespace derham
