#include "support/delaunay.hpp"
#include "derham/complex/incidence.hpp"
#include "derham/dual/dual_cell.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace derham {
namespace {

template <int n>
struct Delaunay {
  explicit Delaunay(std::uint64_t seed, int count)
      : random(seed), mesh(support::random_delaunay(n, count, random)), K(support::simplex_list(mesh.rows)),
        g(Geometry<n>::from_points(K, mesh.points, n)) {}
  [[nodiscard]] std::vector<double> vertex(Index v) const { return g.simplex_corners(K, 0, v); }
  support::Random random;
  support::PointMesh mesh;
  SimplicialComplex<n> K;
  Geometry<n> g;
};

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t c = 0; c < a.size(); ++c) sum += a[c] * b[c];
  return sum;
}

std::vector<double> difference(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t c = 0; c < a.size(); ++c) a[c] -= b[c];
  return a;
}

std::vector<double> point(const DualCell& cell, Index i, int d) {
  const double* p = cell.points.data() + static_cast<std::size_t>(i) * static_cast<std::size_t>(d);
  return {p, p + d};
}

// The dual cell of a k-simplex is orthogonal to all its edges: x·e is the same for all points x of the cell. So dual
// edges are orthogonal to triangles, and dual polygons planar and orthogonal to edges.
template <int n>
void expect_orthogonal(const Delaunay<n>& m) {
  for (int k = 1; k < n; ++k) {
    const DualCells<n> cells(m.K, m.g, k);
    for (Index i = 0; i < m.K.size(k); ++i) {
      const DualCell cell = cells.cell(i);
      const auto vertices = m.K.simplex(k, i);
      for (std::size_t j = 1; j < vertices.size(); ++j) {
        const auto edge = difference(m.vertex(vertices[j]), m.vertex(vertices[0]));
        const auto first = point(cell, 0, n);
        for (Index q = 1; q * n < static_cast<Index>(cell.points.size()); ++q) {
          const auto along = difference(point(cell, q, n), first);
          EXPECT_NEAR(dot(along, edge), 0, 1e-9 * (1 + std::sqrt(dot(along, along)))) << k << ' ' << i;
        }
      }
    }
  }
}

// The dual cell of an interior vertex is its Voronoi cell: no corner of it is closer to another vertex.
template <int n>
int expect_voronoi(const Delaunay<n>& m) {
  std::vector<bool> boundary(static_cast<std::size_t>(m.K.size(0)), false);
  const auto cofaces = facet_cofaces(m.K);
  for (Index f = 0; f < m.K.size(n - 1); ++f)
    if (cofaces.count[static_cast<std::size_t>(f)] == 1)
      for (const Index v : m.K.simplex(n - 1, f)) boundary[static_cast<std::size_t>(v)] = true;
  const DualCells<n> cells(m.K, m.g, 0);
  int interior = 0;
  for (Index v = 0; v < m.K.size(0); ++v) {
    if (boundary[static_cast<std::size_t>(v)]) continue;
    ++interior;
    for (const DualFlag& flag : cells.flags(v)) {
      const std::vector<double> x(flag.points.end() - n,
                                  flag.points.end());  // the corner of the cell in one top simplex
      const auto own = difference(x, m.vertex(v));
      for (Index w = 0; w < m.K.size(0); ++w) {
        const auto other = difference(x, m.vertex(w));
        EXPECT_LE(dot(own, own), dot(other, other) + 1e-9 * (1 + dot(own, own))) << v << ' ' << w;
      }
    }
  }
  return interior;
}

TEST(DelaunayDual, CellsAreOrthogonalToTheirSimplices) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    expect_orthogonal(Delaunay<2>(seed, 20));
    expect_orthogonal(Delaunay<3>(seed, 14));
  }
}

TEST(DelaunayDual, CellsOfInteriorVerticesAreOnTheirSideOfEveryBisector) {
  int plane = 0, space = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    plane += expect_voronoi(Delaunay<2>(seed, 20));
    space += expect_voronoi(Delaunay<3>(seed, 14));
  }
  EXPECT_GT(plane, 0);
  EXPECT_GT(space, 0);
}

}  // namespace
}  // namespace derham
