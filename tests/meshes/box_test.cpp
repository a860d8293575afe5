#include "derham/core/error.hpp"
#include "derham/meshes/boxes.hpp"
#include "support/mesh_measures.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace derham {
namespace {

using test::f_vector;

TEST(Box, FillsTheUnitCubeInEveryDimension) {
  for (int n = 1; n <= 6; ++n) {
    const Index cells = n <= 3 ? 3 : n == 4 ? 2 : 1;
    const MeshData mesh = meshes::box(n, cells);
    EXPECT_EQ(mesh.simplices.size(), factorial(n) * static_cast<Offset>(std::pow(cells, n)));
    EXPECT_EQ(mesh.vertex_count, static_cast<Index>(std::pow(cells + 1, n)));
    EXPECT_EQ(mesh.simplices.vertex_bound(), mesh.vertex_count);
    EXPECT_NEAR(test::total_volume(mesh), 1, 1e-12);
    EXPECT_GT(test::smallest_volume(mesh), 0);
    EXPECT_EQ(test::euler_characteristic(mesh.simplices), 1);
    EXPECT_TRUE(test::facets_have_at_most_two_rows(mesh.simplices));
    EXPECT_TRUE(test::is_coherent(mesh.simplices));
    EXPECT_EQ(test::euler_characteristic(test::boundary_facets(mesh.simplices)), n % 2 ? 2 : 0);
  }
}

TEST(Box, HasTheKnownCounts) {
  EXPECT_EQ(f_vector(meshes::box(3, 2).simplices), (std::vector<Offset>{27, 98, 120, 48}));
  EXPECT_EQ(f_vector(meshes::box(2, 4).simplices), (std::vector<Offset>{25, 56, 32}));
}

TEST(Box, TakesCellsAndLengthsPerAxis) {
  const MeshData mesh = meshes::box({2, 3, 1}, {.lengths = {1, 0.3, 7}});
  EXPECT_EQ(mesh.simplices.size(), 36);
  EXPECT_NEAR(test::total_volume(mesh), 2.1, 1e-12);
  const std::vector<double> last(mesh.points.end() - 3, mesh.points.end());
  EXPECT_EQ(last, (std::vector<double>{1, 0.3, 7}));
  const std::vector<double> second(mesh.points.begin() + 3, mesh.points.begin() + 6);
  EXPECT_EQ(second, (std::vector<double>{0.5, 0, 0}));
}

TEST(Box, JitterMovesInteriorVerticesOnlyAndIsDeterministic) {
  const meshes::BoxOptions options{.jitter = 0.33, .seed = 7};
  const MeshData still = meshes::box(3, 6), moved = meshes::box(3, 6, options);
  EXPECT_EQ(moved.points, meshes::box(3, 6, options).points);
  EXPECT_NE(moved.points, meshes::box(3, 6, {.jitter = 0.33, .seed = 8}).points);
  EXPECT_EQ(moved.simplices, still.simplices);
  for (std::size_t v = 0; v < static_cast<std::size_t>(still.vertex_count); ++v) {
    bool inside = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
      inside = inside && still.points[3 * v + axis] > 0 && still.points[3 * v + axis] < 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double shift = std::abs(moved.points[3 * v + axis] - still.points[3 * v + axis]);
      if (inside) {
        EXPECT_GT(shift, 0);
        EXPECT_LE(shift, 0.33 / 12 + 1e-15);
      } else {
        EXPECT_EQ(shift, 0);
      }
    }
  }
  EXPECT_NEAR(test::total_volume(moved), 1, 1e-12);
  EXPECT_GT(test::smallest_volume(moved), 0);
}

TEST(Box, JitterGivesTheSameMeshOnEveryMachine) {
  // mt19937_64 is fixed by the standard: its first draw for seed 1 is 2469588189546311528.
  const MeshData mesh = meshes::box(1, 2, {.jitter = 0.5, .seed = 1});
  EXPECT_EQ(mesh.points[1], 0.5 + 0.25 * (static_cast<double>(2469588189546311528u >> 11) * 0x1p-53 - 0.5));
}

TEST(Box, KeepsVolumesPositiveBelowTheStatedJitter) {
  for (int n = 1; n <= 4; ++n)
    for (std::uint64_t seed = 0; seed < 5; ++seed)
      EXPECT_GT(test::smallest_volume(meshes::box(n, 4, {.jitter = 0.999 / n, .seed = seed})), 0) << n;
}

TEST(PeriodicBox, IsTheClosedFlatTorus) {
  EXPECT_EQ(f_vector(meshes::periodic_box(1, 3).simplices), (std::vector<Offset>{3, 3}));
  EXPECT_EQ(f_vector(meshes::periodic_box(3, 3).simplices), (std::vector<Offset>{27, 189, 324, 162}));
  EXPECT_EQ(f_vector(meshes::periodic_box(4, 3).simplices), (std::vector<Offset>{81, 1215, 4050, 4860, 1944}));
  for (int n = 1; n <= 4; ++n) {
    const MeshData mesh = meshes::periodic_box(n, 3, {.jitter = 0.2});
    EXPECT_TRUE(test::is_closed(mesh.simplices));
    EXPECT_TRUE(test::is_coherent(mesh.simplices));
    EXPECT_FALSE(mesh.has_points());
    EXPECT_NEAR(test::total_volume(mesh), 1, 1e-12);
    EXPECT_GT(test::smallest_volume(mesh), 0);
  }
}

TEST(PeriodicBox, CornersOfARowGiveEachEdgeOneLength) {
  const MeshData mesh = meshes::periodic_box({3, 4, 5}, {.lengths = {1, 2, 3}, .jitter = 0.3});
  EXPECT_EQ(mesh.vertex_count, 60);
  const auto squared = meshes::squared_edge_lengths(mesh);
  ASSERT_EQ(squared.size(), 360u * 6);
  std::map<test::Face, double> length;
  std::size_t next = 0;
  for (Offset t = 0; t < mesh.simplices.size(); ++t) {
    const auto row = mesh.simplices[t];
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j, ++next)
        EXPECT_NEAR(
            length.try_emplace({std::min(row[i], row[j]), std::max(row[i], row[j])}, squared[next]).first->second,
            squared[next], 1e-14);
  }
  EXPECT_EQ(length.size(), 60u * 7);
}

TEST(Box, RefusesSenselessArguments) {
  EXPECT_THROW((void)meshes::box(0, 3), InputError);
  EXPECT_THROW((void)meshes::box(7, 1), InputError);
  EXPECT_THROW((void)meshes::box(std::vector<Index>{}), InputError);
  EXPECT_THROW((void)meshes::box({2, 0}), InputError);
  EXPECT_THROW((void)meshes::box({2, -1}), InputError);
  EXPECT_THROW((void)meshes::box({2, 2}, {.lengths = {1}}), InputError);
  EXPECT_THROW((void)meshes::box({2, 2}, {.lengths = {1, 0}}), InputError);
  EXPECT_THROW((void)meshes::box({2, 2}, {.lengths = {1, std::numeric_limits<double>::infinity()}}), InputError);
  EXPECT_THROW((void)meshes::box(2, 3, {.jitter = std::numeric_limits<double>::quiet_NaN()}), InputError);
  EXPECT_THROW((void)meshes::box(2, 3, {.jitter = -0.1}), InputError);
  EXPECT_THROW((void)meshes::periodic_box(2, 2), InputError);
  EXPECT_THROW((void)meshes::periodic_box({4, 4, 1}), InputError);
  EXPECT_THROW((void)meshes::squared_edge_lengths(MeshData{}), InputError);
}

#ifndef DERHAM_INDEX64
TEST(Box, RefusesWhatTheIndexCannotNumber) {
  EXPECT_THROW((void)meshes::box(3, 1000), LimitError);
  EXPECT_THROW((void)meshes::box(6, 2147483647), LimitError);
  EXPECT_THROW((void)meshes::box(1, 2147483647), LimitError);
  EXPECT_THROW((void)meshes::periodic_box(4, 1000), LimitError);
}
#endif

}  // namespace
}  // namespace derham
