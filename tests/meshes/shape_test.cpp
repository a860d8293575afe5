#include "derham/core/error.hpp"
#include "derham/meshes/balls.hpp"
#include "derham/meshes/example.hpp"
#include "derham/meshes/polytopes.hpp"
#include "derham/meshes/tori.hpp"
#include "support/mesh_measures.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace derham {
namespace {

using std::numbers::pi;
using test::f_vector;

double norm(const MeshData& mesh, Index v) {
  double sum = 0;
  for (int axis = 0; axis < mesh.ambient_dimension; ++axis) {
    const double x = mesh.points[static_cast<std::size_t>(v * mesh.ambient_dimension + axis)];
    sum += x * x;
  }
  return std::sqrt(sum);
}

/// The volume that a closed oriented hypersurface encloses.
double enclosed_volume(const MeshData& surface) {
  double sum = 0;
  for (Offset i = 0; i < surface.simplices.size(); ++i) sum += test::row_positions(surface, i).determinant();
  return sum / static_cast<double>(factorial(surface.ambient_dimension));
}

TEST(Ball, IsABallOfPositiveSimplicesInEveryDimension) {
  for (int n = 1; n <= 5; ++n)
    for (Index layers = 1; layers <= (n <= 3 ? 5 : n == 4 ? 2 : 1); ++layers) {
      const MeshData mesh = meshes::ball(n, layers, 2);
      EXPECT_EQ(mesh.simplices.size(), factorial(n + 1) * static_cast<Offset>(std::pow(layers, n)));
      EXPECT_EQ(mesh.vertex_count, static_cast<Index>(std::pow(layers + 1, n + 1) - std::pow(layers, n + 1)));
      EXPECT_GT(test::smallest_volume(mesh), 0) << n << " " << layers;
      EXPECT_EQ(test::euler_characteristic(mesh.simplices), 1);
      EXPECT_TRUE(test::facets_have_at_most_two_rows(mesh.simplices));
      const SimplexList boundary = test::boundary_facets(mesh.simplices);
      EXPECT_EQ(test::euler_characteristic(boundary), n % 2 ? 2 : 0);
      for (const Index v : boundary.vertices()) EXPECT_NEAR(norm(mesh, v), 2, 1e-12);
    }
}

TEST(Ball, VolumeConvergesWithSecondOrder) {
  const double coarse = 4 * pi / 3 - test::total_volume(meshes::ball(3, 5));
  const double fine = 4 * pi / 3 - test::total_volume(meshes::ball(3, 10));
  EXPECT_GT(coarse, 0);
  EXPECT_NEAR(coarse / fine, 4, 0.3);
  EXPECT_NEAR(test::total_volume(meshes::ball(2, 40)), pi, 1e-3);
}

TEST(Icosphere, IsARoundClosedSurface) {
  for (int level = 0; level <= 3; ++level) {
    const MeshData mesh = meshes::icosphere(level, 3);
    const Offset p = Offset{1} << 2 * level;
    EXPECT_EQ(f_vector(mesh.simplices), (std::vector<Offset>{10 * p + 2, 30 * p, 20 * p}));
    EXPECT_TRUE(test::is_closed(mesh.simplices));
    EXPECT_TRUE(test::is_coherent(mesh.simplices));
    EXPECT_GT(enclosed_volume(mesh), 0);
    for (Index v = 0; v < mesh.vertex_count; ++v) EXPECT_NEAR(norm(mesh, v), 3, 1e-14);
  }
  EXPECT_NEAR(test::total_volume(meshes::icosphere(4)), 4 * pi, 0.02);
  EXPECT_EQ(test::measures(meshes::icosphere(0)).at({0, 1}).primal,
            test::measures(meshes::icosphere(0)).at({0, 11}).primal);
}

TEST(Torus, IsAClosedOrientedSurface) {
  const MeshData mesh = meshes::torus(5, 3);
  EXPECT_EQ(f_vector(mesh.simplices), (std::vector<Offset>{15, 45, 30}));
  EXPECT_TRUE(test::is_closed(mesh.simplices));
  EXPECT_TRUE(test::is_coherent(mesh.simplices));
  EXPECT_GT(enclosed_volume(mesh), 0);
  const MeshData fine = meshes::torus(100, 60, 2, 0.5);
  EXPECT_NEAR(enclosed_volume(fine), 2 * pi * pi * 2 * 0.25, 0.05);
  EXPECT_NEAR(test::total_volume(fine), 4 * pi * pi * 2 * 0.5, 0.05);
}

TEST(CliffordTorus, IsFlat) {
  const MeshData mesh = meshes::clifford_torus(12, 8, 2);
  EXPECT_EQ(f_vector(mesh.simplices), (std::vector<Offset>{96, 288, 192}));
  EXPECT_TRUE(test::is_closed(mesh.simplices));
  EXPECT_TRUE(test::is_coherent(mesh.simplices));
  const auto volumes = test::row_volumes(mesh);
  EXPECT_NEAR(std::ranges::max(volumes), std::ranges::min(volumes), 1e-13);
  EXPECT_NEAR(volumes[0], 8 * std::sin(pi / 12) * std::sin(pi / 8), 1e-13);
}

TEST(SolidTorus, IsASolidTorusOfPositiveTetrahedra) {
  for (const Index rings : {1, 2, 4})
    for (const Index segments : {3, 4, 7, 30}) {
      const MeshData mesh = meshes::solid_torus(rings, segments);
      EXPECT_EQ(mesh.simplices.size(), 18 * rings * rings * segments);
      EXPECT_EQ(mesh.vertex_count, (3 * rings * rings + 3 * rings + 1) * segments);
      EXPECT_GT(test::smallest_volume(mesh), 0) << rings << " " << segments;
      EXPECT_EQ(test::euler_characteristic(mesh.simplices), 0);
      EXPECT_TRUE(test::facets_have_at_most_two_rows(mesh.simplices));
      const SimplexList boundary = test::boundary_facets(mesh.simplices);
      EXPECT_TRUE(test::is_closed(boundary));
      EXPECT_EQ(test::euler_characteristic(boundary), 0);
    }
  EXPECT_NEAR(test::total_volume(meshes::solid_torus(10, 157)), 2 * pi * pi * 0.16, 0.02);
}

TEST(RegularSimplex, HasUnitEdges) {
  for (int n = 1; n <= 6; ++n) {
    const MeshData mesh = meshes::regular_simplex(n);
    EXPECT_NEAR(test::total_volume(mesh), std::sqrt(n + 1) / (static_cast<double>(factorial(n)) * std::pow(2, n / 2.0)),
                1e-12);
    for (const auto& [face, measure] : test::measures(mesh))
      if (face.size() == 2) {
        EXPECT_NEAR(measure.primal, 1, 1e-13);
      }
  }
}

TEST(SimplexBoundary, IsTheSphere) {
  for (int n = 0; n <= 6; ++n) {
    const MeshData mesh = meshes::simplex_boundary(n);
    const auto f = f_vector(mesh.simplices);
    for (int k = 0; k <= n; ++k) EXPECT_EQ(f[static_cast<std::size_t>(k)], binomial(n + 2, k + 1));
    for (Index v = 0; v < mesh.vertex_count; ++v) EXPECT_NEAR(norm(mesh, v), 1, 1e-13);
    if (n == 0) continue;
    EXPECT_TRUE(test::is_closed(mesh.simplices));
    EXPECT_TRUE(test::is_coherent(mesh.simplices));
    EXPECT_GT(enclosed_volume(mesh), 0);
  }
}

TEST(CrossPolytope, IsTheSphere) {
  for (int n = 0; n <= 6; ++n) {
    const MeshData mesh = meshes::cross_polytope(n);
    const auto f = f_vector(mesh.simplices);
    for (int k = 0; k <= n; ++k) EXPECT_EQ(f[static_cast<std::size_t>(k)], binomial(n + 1, k + 1) << (k + 1));
    if (n == 0) continue;
    EXPECT_TRUE(test::is_closed(mesh.simplices));
    EXPECT_TRUE(test::is_coherent(mesh.simplices));
    EXPECT_NEAR(enclosed_volume(mesh), std::pow(2, n + 1) / static_cast<double>(factorial(n + 1)), 1e-13);
  }
}

TEST(Cell600, HasTheKnownCountsAndDualVolumes) {
  const MeshData mesh = meshes::cell_600();
  EXPECT_EQ(f_vector(mesh.simplices), (std::vector<Offset>{120, 720, 1200, 600}));
  EXPECT_TRUE(test::is_closed(mesh.simplices));
  EXPECT_TRUE(test::is_coherent(mesh.simplices));
  EXPECT_GT(enclosed_volume(mesh), 0);
  constexpr std::array<double, 4> dual{0.13910439, 0.11253781, 0.25231132, 1};
  for (const auto& [face, measure] : test::measures(mesh)) {
    EXPECT_NEAR(measure.dual, dual[face.size() - 1], 1e-8);
    if (face.size() == 2) {
      EXPECT_NEAR(measure.primal, 1 / std::numbers::phi, 1e-12);
    }
  }
}

TEST(Example, ShowsBothSigns) {
  const MeshData mesh = meshes::example();
  EXPECT_EQ(f_vector(mesh.simplices), (std::vector<Offset>{5, 9, 7, 2}));
  EXPECT_TRUE(test::is_coherent(mesh.simplices));
  EXPECT_NEAR(test::smallest_volume(mesh), 9, 1e-12);
  EXPECT_NEAR(test::total_volume(mesh), 18, 1e-12);
  for (const auto& [face, measure] : test::measures(mesh)) {
    EXPECT_GT(measure.smallest_part, 0);
    if (face.size() == 2) {
      EXPECT_NEAR(measure.primal, 3 * std::sqrt(2), 1e-13);
    }
  }
  Tuple<3> first{}, second{};
  std::ranges::copy(mesh.simplices[0], first.begin());
  std::ranges::copy(mesh.simplices[1], second.begin());
  EXPECT_EQ(sort_with_sign(first), 1);
  EXPECT_EQ(sort_with_sign(second), -1);
}

TEST(Shapes, RefuseSenselessArguments) {
  EXPECT_THROW((void)meshes::ball(0, 1), InputError);
  EXPECT_THROW((void)meshes::ball(7, 1), InputError);
  EXPECT_THROW((void)meshes::ball(3, 0), InputError);
  EXPECT_THROW((void)meshes::ball(3, 2, 0), InputError);
  EXPECT_THROW((void)meshes::icosphere(-1), InputError);
  EXPECT_THROW((void)meshes::torus(2, 3), InputError);
  EXPECT_THROW((void)meshes::torus(3, 3, 1, 1), InputError);
  EXPECT_THROW((void)meshes::clifford_torus(3, 2), InputError);
  EXPECT_THROW((void)meshes::solid_torus(0, 5), InputError);
  EXPECT_THROW((void)meshes::solid_torus(1, 2), InputError);
  EXPECT_THROW((void)meshes::solid_torus(1, 3, 1, 2), InputError);
  EXPECT_THROW((void)meshes::simplex_boundary(7), InputError);
  EXPECT_THROW((void)meshes::cross_polytope(-1), InputError);
  EXPECT_THROW((void)meshes::regular_simplex(0), InputError);
#ifndef DERHAM_INDEX64
  EXPECT_THROW((void)meshes::ball(3, 2147483647), LimitError);
  EXPECT_THROW((void)meshes::icosphere(14), LimitError);
  EXPECT_THROW((void)meshes::icosphere(2147483647), LimitError);
  EXPECT_THROW((void)meshes::torus(100000, 100000), LimitError);
  EXPECT_THROW((void)meshes::solid_torus(10000, 10000), LimitError);
#endif
}

}  // namespace
}  // namespace derham
