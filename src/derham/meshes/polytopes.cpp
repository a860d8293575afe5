#include "derham/meshes/polytopes.hpp"

#include "derham/meshes/counts.hpp"

#include <numbers>

namespace derham::meshes {
namespace {

/// The vertices of the regular d-simplex with circumcentre 0 and circumradius 1, positively oriented.
std::vector<double> regular_simplex_points(int d) {
  // The unit vectors e_0 … e_(d-1) and the point (a, …, a) at the same distance √2 from all, on the positive side of
  // them; centred and scaled.
  const auto width = static_cast<std::size_t>(d);
  const double a = (1 + (d % 2 ? 1 : -1) * std::sqrt(d + 1.0)) / d, centre = (1 + a) / (d + 1);
  const double radius = std::sqrt(static_cast<double>(d) / (d + 1));
  std::vector<double> points;
  for (std::size_t v = 0; v <= width; ++v)
    for (std::size_t axis = 0; axis < width; ++axis) points.push_back(((v == width ? a : v == axis) - centre) / radius);
  return points;
}

double determinant(std::vector<double> rows) {
  const auto n = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(rows.size()))));
  double value = 1;
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c; r < n; ++r)
      if (std::abs(rows[r * n + c]) > std::abs(rows[pivot * n + c])) pivot = r;
    if (pivot != c) value = -value;
    for (std::size_t j = 0; j < n; ++j) std::swap(rows[pivot * n + j], rows[c * n + j]);
    value *= rows[c * n + c];
    for (std::size_t r = c + 1; r < n; ++r) {
      const double factor = rows[r * n + c] / rows[c * n + c];
      for (std::size_t j = c; j < n; ++j) rows[r * n + j] -= factor * rows[c * n + j];
    }
  }
  return value;
}

/// Swaps two vertices of each facet that does not turn outward, seen from the origin inside.
void orient_outward(MeshData& mesh) {
  const auto width = static_cast<std::size_t>(mesh.ambient_dimension);
  const auto vertices = mesh.simplices.vertices();
  for (std::size_t row = 0; width > 1 && row < vertices.size(); row += width) {
    std::vector<double> rays;
    for (std::size_t i = row; i < row + width; ++i) {
      const double* point = &mesh.points[static_cast<std::size_t>(vertices[i]) * width];
      rays.insert(rays.end(), point, point + width);
    }
    if (determinant(std::move(rays)) < 0) std::swap(vertices[row + width - 2], vertices[row + width - 1]);
  }
}

/// All even permutations of ½(±φ, ±1, ±1/φ, 0).
void append_snub_icosians(std::vector<double>& points) {
  std::array<std::size_t, 4> order{0, 1, 2, 3};
  do {
    bool odd = false;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j) odd ^= order[j] > order[i];
    if (odd) continue;
    for (unsigned signs = 0; signs < 8; ++signs) {
      const std::array<double, 4> values{signs & 1 ? -std::numbers::phi : std::numbers::phi, signs & 2 ? -1.0 : 1.0,
                                         (signs & 4 ? -1 : 1) / std::numbers::phi, 0.0};
      for (const std::size_t place : order) points.push_back(values[place] / 2);
    }
  } while (std::ranges::next_permutation(order).found);
}

}  // namespace

MeshData regular_simplex(int n) {
  detail::require_dimension(n, 1, max_dimension);
  MeshData mesh;
  mesh.ambient_dimension = n;
  mesh.vertex_count = n + 1;
  mesh.points = regular_simplex_points(n);
  const double edge = std::sqrt(2.0 * (n + 1) / n);
  for (double& x : mesh.points) x /= edge;
  std::vector<Index> row;
  for (Index v = 0; v <= n; ++v) row.push_back(v);
  mesh.simplices.push_back(row);
  return mesh;
}

MeshData simplex_boundary(int n) {
  detail::require_dimension(n, 0, max_dimension);
  MeshData mesh;
  mesh.ambient_dimension = n + 1;
  mesh.vertex_count = n + 2;
  mesh.points = regular_simplex_points(n + 1);
  std::vector<Index> vertices;
  for (Index omitted = n + 1; omitted >= 0; --omitted)
    for (Index v = 0; v <= n + 1; ++v)
      if (v != omitted) vertices.push_back(v);
  mesh.simplices = SimplexList(n, std::move(vertices));
  orient_outward(mesh);
  return mesh;
}

MeshData cross_polytope(int n) {
  detail::require_dimension(n, 0, max_dimension);
  MeshData mesh;
  mesh.ambient_dimension = n + 1;
  mesh.vertex_count = 2 * (n + 1);
  for (Index v = 0; v < mesh.vertex_count; ++v)
    for (Index axis = 0; axis <= n; ++axis) mesh.points.push_back(axis != v / 2 ? 0 : v % 2 ? -1 : 1);
  std::vector<Index> vertices;
  for (Index signs = 0; signs < Index{1} << (n + 1); ++signs)
    for (Index axis = 0; axis <= n; ++axis) vertices.push_back(2 * axis + (signs >> axis & 1));
  mesh.simplices = SimplexList(n, std::move(vertices));
  orient_outward(mesh);
  return mesh;
}

MeshData cell_600() {
  MeshData mesh = cross_polytope(3);
  for (unsigned signs = 0; signs < 16; ++signs)
    for (unsigned axis = 0; axis < 4; ++axis) mesh.points.push_back(signs >> axis & 1 ? -0.5 : 0.5);
  append_snub_icosians(mesh.points);
  mesh.vertex_count = static_cast<Index>(mesh.points.size() / 4);

  const auto adjacent = [&](Index u, Index v) {
    double product = 0;
    for (std::size_t axis = 0; axis < 4; ++axis)
      product +=
          mesh.points[static_cast<std::size_t>(u) * 4 + axis] * mesh.points[static_cast<std::size_t>(v) * 4 + axis];
    return std::abs(product - std::numbers::phi / 2) < 1e-6;
  };
  std::vector<std::vector<Index>> above(static_cast<std::size_t>(mesh.vertex_count));
  for (Index u = 0; u < mesh.vertex_count; ++u)
    for (Index v = u + 1; v < mesh.vertex_count; ++v)
      if (adjacent(u, v)) above[static_cast<std::size_t>(u)].push_back(v);
  mesh.simplices = {};
  for (Index a = 0; a < mesh.vertex_count; ++a)
    for (const Index b : above[static_cast<std::size_t>(a)])
      for (const Index c : above[static_cast<std::size_t>(b)])
        for (const Index d : above[static_cast<std::size_t>(c)])
          if (adjacent(a, c) && adjacent(a, d) && adjacent(b, d)) mesh.simplices.push_back({a, b, c, d});
  orient_outward(mesh);
  return mesh;
}

}  // namespace derham::meshes
