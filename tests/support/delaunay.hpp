#pragma once

#include "reference/reference_geometry.hpp"
#include "support/random_rows.hpp"

#include <algorithm>
#include <random>
#include <vector>

namespace derham::support {

struct PointMesh {
  Rows rows;
  std::vector<double> points;  // (|V|, m) row-major
  int m = 0;

  [[nodiscard]] std::vector<reference::Point> exact_points() const {
    std::vector<reference::Point> result;
    for (std::size_t v = 0; v * static_cast<std::size_t>(m) < points.size(); ++v) {
      const double* p = points.data() + v * static_cast<std::size_t>(m);
      result.emplace_back(p, p + m);
    }
    return result;
  }
};

/// The Delaunay mesh of `count` random points of the unit cube in R^n by its definition: all n-simplices whose open
/// circumscribed ball holds no other point. Their hull makes slivers. Tuples and rows are shuffled.
inline PointMesh random_delaunay(int n, int count, Random& random) {
  PointMesh mesh;
  mesh.m = n;
  std::uniform_real_distribution<double> coordinate(0, 1);
  for (int i = 0; i < count * n; ++i) mesh.points.push_back(coordinate(random));
  const auto points = mesh.exact_points();

  std::vector<Index> tuple;
  for (Index v = 0; v <= n; ++v) tuple.push_back(v);
  const auto next_subset = [&] {  // in lexicographic order; false after the last
    for (int i = n; i >= 0; --i) {
      auto& v = tuple[static_cast<std::size_t>(i)];
      if (v == count - 1 - (n - i)) continue;
      for (Index w = ++v; ++i <= n;) tuple[static_cast<std::size_t>(i)] = ++w;
      return true;
    }
    return false;
  };
  do {
    std::vector<reference::Point> corners;
    for (const Index v : tuple) corners.push_back(points[static_cast<std::size_t>(v)]);
    const auto center = reference::SimplexGeometry(corners).circumcenter;
    const auto squared_distance = [&](const reference::Point& p) {
      const auto to_p = reference::difference(p, center);
      return reference::dot(to_p, to_p);
    };
    const reference::Real squared_radius = squared_distance(corners[0]);
    if (std::ranges::all_of(points, [&](const auto& p) {
          return std::ranges::find(corners, p) != corners.end() || squared_distance(p) > squared_radius;
        }))
      mesh.rows.push_back(tuple);
  } while (next_subset());
  mesh.rows = reordered(mesh.rows, random);
  return mesh;
}

}  // namespace derham::support
