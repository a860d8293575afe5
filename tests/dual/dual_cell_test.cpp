#include "derham/dual/dual_cell.hpp"

#include "derham/core/error.hpp"
#include "derham/dual/circumcentric.hpp"
#include "derham/meshes/balls.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/lattices.hpp"
#include "geometry/mesh_kit.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

namespace derham {
namespace {

using Vector = std::array<double, 3>;

Vector point(const DualCell& cell, Index i, int d) {
  Vector p{};
  for (int c = 0; c < d; ++c) p[c] = cell.points[static_cast<std::size_t>(i * d + c)];
  return p;
}

// Twice the vector area of a loop in the plane or in space, seen from `origin`.
Vector twice_area(const DualCell& cell, const std::vector<Index>& loop, int d, const Vector& origin) {
  Vector sum{};
  for (std::size_t i = 0; i < loop.size(); ++i) {
    Vector a = point(cell, loop[i], d), b = point(cell, loop[(i + 1) % loop.size()], d);
    for (int c = 0; c < 3; ++c) {
      a[c] -= origin[c];
      b[c] -= origin[c];
    }
    for (int c = 0; c < 3; ++c) sum[c] += a[(c + 1) % 3] * b[(c + 2) % 3] - a[(c + 2) % 3] * b[(c + 1) % 3];
  }
  return sum;
}

double area(const DualCell& cell, const std::vector<Index>& loop, int d) {
  const Vector v = twice_area(cell, loop, d, {});
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / 2;
}

// Cells of Delaunay meshes are convex and contain `inside`: the pyramids from there to the faces fill them.
double volume(const DualCell& cell, const Vector& inside) {
  double sum = 0;
  for (const auto& loop : cell.polygons) {
    const Vector p = point(cell, loop[0], 3), normal = twice_area(cell, loop, 3, p);
    double dot = 0;
    for (int c = 0; c < 3; ++c) dot += normal[c] * (p[c] - inside[c]);
    sum += std::abs(dot) / 6;
  }
  return sum;
}

template <class T>
struct Flags : testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                                  std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(Flags, Dimensions);

TYPED_TEST(Flags, SignedVolumesSumToTheDualVolume) {
  constexpr int n = TypeParam::value;
  for (const bool periodic : {false, true}) {
    const meshes::BoxOptions options{.jitter = 0.4 / n};
    const MeshData mesh = periodic ? meshes::periodic_box(n, 3, options) : meshes::box(n, 2, options);
    const SimplicialComplex<n> K(mesh.simplices);
    const auto g = Geometry<n>::from_mesh(K, mesh);
    const auto dual = dual_volumes(K, g);
    for (int k = 0; k <= n; ++k) {
      const DualCells<n> cells(K, g, k);
      for (Index i = 0; i < std::min<Index>(K.size(k), 40); ++i) {
        double sum = 0;
        for (const DualFlag& flag : cells.flags(i)) sum += flag.signed_volume;
        EXPECT_NEAR(sum, dual[k][i], 1e-11) << k << " " << i;
      }
    }
  }
}

// The corners of a flag span right angles, so its volume is also that of its points.
TEST(Flags, PointsSpanTheVolume) {
  const MeshData mesh = meshes::box(2, 2, {.jitter = 0.3});
  const SimplicialComplex<2> K(mesh.simplices);
  const auto g = Geometry<2>::from_mesh(K, mesh);
  const DualCells<2> cells(K, g, 0);
  for (Index v = 0; v < K.size(0); ++v)
    for (const DualFlag& flag : cells.flags(v)) {
      const auto& p = flag.points;
      const double twice = (p[2] - p[0]) * (p[5] - p[1]) - (p[3] - p[1]) * (p[4] - p[0]);
      EXPECT_NEAR(std::abs(twice) / 2, std::abs(flag.signed_volume), 1e-14);
    }
}

TEST(DualCell, PolygonsOfADiskAreTheVertexCells) {
  const MeshData mesh = meshes::ball(2, 3);
  const SimplicialComplex<2> K(mesh.simplices);
  const auto g = Geometry<2>::from_mesh(K, mesh);
  const auto dual = dual_volumes(K, g);
  const DualCells<2> cells(K, g, 0);
  for (Index v = 0; v < K.size(0); ++v) {
    const DualCell cell = cells.cell(v);
    ASSERT_EQ(cell.polygons.size(), 1u);
    EXPECT_NEAR(area(cell, cell.polygons[0], 2), dual[0][v], 1e-13);
  }
}

TEST(DualCell, PolylinesAndPoints) {
  const MeshData mesh = meshes::a_star_lattice(2, 3);
  const SimplicialComplex<2> K(mesh.simplices);
  const auto g = Geometry<2>::from_mesh(K, mesh);
  const auto dual = dual_volumes(K, g);
  const DualCells<2> edges(K, g, 1), triangles(K, g, 2);
  for (Index e = 0; e < K.size(1); ++e) {
    const DualCell cell = edges.cell(e);
    ASSERT_EQ(cell.polylines.size(), 1u);
    const auto& path = cell.polylines[0];
    ASSERT_EQ(path.size(), 3u);
    double length = 0;
    for (int i = 0; i < 2; ++i) {
      const Vector a = point(cell, path[i], 2), b = point(cell, path[i + 1], 2);
      length += std::hypot(a[0] - b[0], a[1] - b[1]);
    }
    EXPECT_NEAR(length, dual[1][e], 1e-13);
  }
  EXPECT_EQ(triangles.cell(0).points.size(), 2u);
}

TEST(DualCell, PolyhedraAndPolygonsOfThePeriodicLattice) {
  const MeshData mesh = meshes::bcc_lattice(3);
  const SimplicialComplex<3> K(mesh.simplices);
  const auto g = Geometry<3>::from_mesh(K, mesh);
  const auto dual = dual_volumes(K, g);
  const DualCells<3> vertices(K, g, 0), edges(K, g, 1);
  for (Index e = 0; e < K.size(1); ++e) {
    const DualCell cell = edges.cell(e);
    ASSERT_EQ(cell.polygons.size(), 1u);
    EXPECT_NEAR(area(cell, cell.polygons[0], 3), dual[1][e], 1e-13);
  }
  for (Index v = 0; v < K.size(0); ++v) {
    const DualCell cell = vertices.cell(v);
    EXPECT_EQ(cell.polygons.size(), 14u);  // the truncated octahedron
    const auto p = g.simplex_corners(K, 0, v);
    // 24 corners, the middles of its 36 sides.
    EXPECT_EQ(cell.points.size(), 3u * (24 + 36));
    EXPECT_NEAR(volume(cell, point(cell, 0, 3)), 0.5, 1e-12);
    EXPECT_NEAR(volume(cell, {p[0], p[1], p[2]}), 0.5, 1e-12);
  }
}

TEST(DualCell, PolyhedraAreClosedAtTheBoundary) {
  const MeshData mesh = meshes::ball(3, 2);
  const SimplicialComplex<3> K(mesh.simplices);
  const auto g = Geometry<3>::from_mesh(K, mesh);
  const DualCells<3> cells(K, g, 0);
  for (Index v = 0; v < K.size(0); ++v) {
    const DualCell cell = cells.cell(v);
    // Every side belongs to two faces.
    std::map<std::pair<Index, Index>, int> sides;
    for (const auto& loop : cell.polygons)
      for (std::size_t i = 0; i < loop.size(); ++i) ++sides[std::minmax(loop[i], loop[(i + 1) % loop.size()])];
    for (const auto& [side, count] : sides) EXPECT_EQ(count, 2) << v;
  }
  const MeshData cube = meshes::box(3, 1);
  const SimplicialComplex<3> L(cube.simplices);
  const auto h = Geometry<3>::from_mesh(L, cube);
  const auto dual = dual_volumes(L, h);
  const DualCells<3> corners(L, h, 0);
  for (Index v = 0; v < 8; ++v) {
    const auto p = h.simplex_corners(L, 0, v);
    EXPECT_NEAR(volume(corners.cell(v), {p[0], p[1], p[2]}), dual[0][v], 1e-14);
  }
}

TEST(DualCell, Refusals) {
  const MeshData mesh = meshes::box(4, 1);
  const SimplicialComplex<4> K(mesh.simplices);
  const auto g = Geometry<4>::from_mesh(K, mesh);
  EXPECT_THROW((void)DualCells<4>(K, g, 0).cell(0), InputError);
  EXPECT_NO_THROW((void)DualCells<4>(K, g, 1).cell(0));
  EXPECT_THROW((void)DualCells<4>(K, g, 5), InputError);
  for (const Index i : {Index{-1}, K.size(2)}) {
    EXPECT_THROW((void)DualCells<4>(K, g, 2).cell(i), InputError);
    EXPECT_THROW((void)DualCells<4>(K, g, 2).flags(i), InputError);
  }
  const SimplicialComplex<2> three(SimplexList{{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
  const auto h = Geometry<2>::from_points(three, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0}, 3);
  EXPECT_THROW((void)DualCells<2>(three, h, 0).cell(0), TopologyError);
  const SimplicialComplex<2> flat(SimplexList{{0, 1, 2}});
  const auto f = Geometry<2>::from_points(flat, {0, 0, 1, 0, 2, 0}, 2);
  EXPECT_THROW((void)DualCells<2>(flat, f, 0).cell(0), GeometryError);
  EXPECT_THROW((void)DualCells<2>(flat, f, 0).flags(0), GeometryError);
}

}  // namespace
}  // namespace derham
