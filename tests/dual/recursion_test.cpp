// Degree by degree, many simplices at a time and on several threads, against top simplex by top simplex.
#include "derham/core/parallel.hpp"
#include "derham/dual/circumcentric.hpp"
#include "derham/dual/dual_report.hpp"
#include "derham/geometry/quality.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/lattices.hpp"
#include "derham/meshes/tori.hpp"
#include "geometry/mesh_kit.hpp"
#include "reference/slow_dual.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace derham {
namespace {

template <int n>
void expect_agrees(const SimplicialComplex<n>& K, const Geometry<n>& g, double tolerance, bool same_zeros = true) {
  const auto fast = circumcentric_dual(K, g);
  const reference::SlowDual<n> slow(K, g);
  EXPECT_EQ(fast.degenerate, slow.result.degenerate);
  EXPECT_EQ(fast.well_centered, slow.result.well_centered);
  for (int k = 0; k <= n; ++k) {
    const double largest = K.size(k) == 0 ? 0 : *std::ranges::max_element(slow.result.primal[k]);
    for (std::size_t i = 0; i < fast.dual[k].size(); ++i) {
      const double expected = slow.result.dual[k][i];
      EXPECT_NEAR(fast.primal[k][i], slow.result.primal[k][i], tolerance * largest);
      EXPECT_EQ(std::isnan(fast.dual[k][i]), std::isnan(expected)) << k << ' ' << i;
      if (std::isnan(expected)) continue;
      EXPECT_NEAR(fast.dual[k][i], expected, tolerance * slow.scale[k][i]) << k << ' ' << i;
      EXPECT_TRUE(!same_zeros || (fast.dual[k][i] == 0) == (expected == 0)) << k << ' ' << i;
    }
  }
}

template <int n>
void expect_agrees(const MeshData& mesh, double tolerance = 1e-13, bool same_zeros = true) {
  const SimplicialComplex<n> K(mesh.simplices);
  expect_agrees(K, Geometry<n>::from_mesh(K, mesh), tolerance, same_zeros);
}

template <class T>
struct DualRecursion : testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                                  std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(DualRecursion, Dimensions);

TYPED_TEST(DualRecursion, AgreesTopSimplexByTopSimplex) {
  constexpr int n = TypeParam::value;
  std::vector<Index> id;
  for (const double jitter : {0.0, 0.5 / n}) {
    const MeshData box = meshes::box(n, 4, {.jitter = jitter}), torus = meshes::periodic_box(n, 3, {.jitter = jitter});
    expect_agrees<n>(test::shuffled(box, 1, id));
    expect_agrees<n>(test::shuffled(torus, 2, id));
    for (const int m : {n, n + 1, n + 3}) expect_agrees<n>(test::moved(box, m, 1e-3, 1, 3), 1e-9);
    const SimplicialComplex<n> K(torus.simplices);
    const auto lengths = squared_lengths(K, Geometry<n>::from_mesh(K, torus));
    expect_agrees(K, Geometry<n>::from_squared_lengths(K, lengths), 1e-12);
  }
  expect_agrees<n>(meshes::a_star_lattice(n, 3));
}

// Inverted, thin and flat simplices: vertices far from where they should be, and boxes a million times wider than high.
TYPED_TEST(DualRecursion, AgreesOnBadlyShapedMeshes) {
  constexpr int n = TypeParam::value;
  std::vector<Index> id;
  for (const std::uint64_t seed : {1, 2, 3}) {
    MeshData mesh = test::shuffled(meshes::box(n, 4, {.jitter = 1, .seed = seed}), 1, id);
    expect_agrees<n>(mesh, 1e-10, false);
    for (std::size_t i = 0; i < mesh.points.size(); i += n) mesh.points[i] *= 1e-6;
    expect_agrees<n>(mesh, 1e-7, false);
    for (std::size_t i = 0; i < mesh.points.size(); i += n) mesh.points[i] = i < 20 * n ? 0 : mesh.points[i];
    expect_agrees<n>(mesh, 1e-7, false);
  }
}

std::vector<std::uint64_t> bits(const std::vector<double>& values) {
  std::vector<std::uint64_t> result;
  for (const double x : values) result.push_back(std::bit_cast<std::uint64_t>(x));
  return result;
}

void expect_same(const DualReport& a, const DualReport& b) {
  EXPECT_EQ(a.pairwise_delaunay, b.pairwise_delaunay);
  EXPECT_EQ(a.one_sided, b.one_sided);
  EXPECT_EQ(a.well_centered, b.well_centered);
  EXPECT_EQ(a.degenerate, b.degenerate);
  ASSERT_EQ(a.star.size(), b.star.size());
  for (std::size_t k = 0; k < a.star.size(); ++k) {
    EXPECT_EQ(bits({a.star[k].min}), bits({b.star[k].min}));
    EXPECT_EQ(a.star[k].zero, b.star[k].zero);
    EXPECT_EQ(a.star[k].negative, b.star[k].negative);
    EXPECT_EQ(a.star[k].undefined, b.star[k].undefined);
  }
}

class DualThreads : public testing::Test {
 protected:
  void TearDown() override { set_thread_count(before_); }

 private:
  int before_ = thread_count();
};

template <int n>
void expect_same_for_any_number_of_threads(MeshData mesh) {
  std::vector<Index> id;
  mesh = test::shuffled(mesh, 1, id);
  mesh.points[0] = mesh.points[n];  // some flat simplices, if the vertices share one
  SimplicialComplex<n> K(mesh.simplices);
  const auto g = Geometry<n>::from_mesh(K, mesh);
  set_thread_count(1);
  const auto dual = circumcentric_dual(K, g);
  const auto volumes = signed_volumes(K, g);
  const auto report = quality(K, g);
  const auto primal = primal_volumes(K, g);
  const auto verdicts = judged_dual(K, g).report;
  for (const int threads : {2, 4}) {
    set_thread_count(threads);
    const auto other = circumcentric_dual(K, g);
    const auto other_primal = primal_volumes(K, g);
    for (int k = 0; k <= n; ++k) {
      EXPECT_EQ(bits(dual.dual[k]), bits(other.dual[k]));
      EXPECT_EQ(bits(dual.primal[k]), bits(other.primal[k]));
      EXPECT_EQ(bits(primal[k]), bits(other_primal[k]));
    }
    EXPECT_EQ(dual.degenerate, other.degenerate);
    EXPECT_EQ(dual.well_centered, other.well_centered);
    expect_same(verdicts, judged_dual(K, g).report);
    EXPECT_EQ(bits(volumes), bits(signed_volumes(K, g)));
    EXPECT_EQ(report.total_volume, quality(K, g).total_volume);
    EXPECT_EQ(report.inverted, quality(K, g).inverted);
  }
}

TEST_F(DualThreads, DoNotChangeTheVolumes) {
  expect_same_for_any_number_of_threads<2>(meshes::box(2, 120, {.jitter = 0.6}));
  expect_same_for_any_number_of_threads<3>(meshes::box(3, 17, {.jitter = 0.6}));
  expect_same_for_any_number_of_threads<4>(meshes::box(4, 5, {.jitter = 0.6}));
}

// Judging on the way gives the same volumes and the same verdicts as judging at the end.
TYPED_TEST(DualRecursion, JudgesOnTheWay) {
  constexpr int n = TypeParam::value;
  for (const double jitter : {0.0, 0.2 / n, 1.0}) {
    const MeshData mesh = meshes::box(n, 5, {.jitter = jitter});
    const SimplicialComplex<n> K(mesh.simplices);
    const auto g = Geometry<n>::from_mesh(K, mesh);
    const auto [volumes, report] = judged_dual(K, g);
    const auto dual = circumcentric_dual(K, g);
    expect_same(report, dual_report(K, dual));
    for (int k = 0; k <= n; ++k) {
      EXPECT_EQ(bits(volumes.dual[k]), bits(dual.dual[k]));
      EXPECT_EQ(bits(volumes.primal[k]), bits(dual.primal[k]));
    }
  }
}

// More entries than the report looks at together, with every verdict among them.
TEST(DualReport, ListsEverySimplexOnce) {
  const MeshData mesh = meshes::box(2, 40, {.jitter = 0.9});
  const SimplicialComplex<2> K(mesh.simplices);
  auto dual = circumcentric_dual(K, Geometry<2>::from_mesh(K, mesh));
  for (std::size_t i = 0; i < dual.dual[1].size(); i += 3) dual.dual[1][i] = 0;
  dual.dual[1][7] = std::nan("");
  const auto report = dual_report(K, dual);
  std::vector<Index> zero, negative;
  double least = 1e300;
  for (Index e = 0; e < K.size(1); ++e) {
    if (e == 7) continue;
    const double volume = dual.dual[1][static_cast<std::size_t>(e)];
    if (volume == 0) zero.push_back(e);
    if (volume < 0) negative.push_back(e);
    least = std::min(least, volume / dual.primal[1][static_cast<std::size_t>(e)]);
  }
  EXPECT_GT(negative.size(), 100U);
  EXPECT_EQ(report.star[1].zero, zero);
  EXPECT_EQ(report.star[1].negative, negative);
  EXPECT_EQ(report.star[1].undefined, 1);
  EXPECT_EQ(report.star[1].min, least);
}

}  // namespace
}  // namespace derham
