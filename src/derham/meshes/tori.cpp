#include "derham/meshes/tori.hpp"

#include "derham/meshes/counts.hpp"
#include "derham/meshes/kuhn.hpp"
#include "derham/meshes/shells.hpp"

#include <numbers>

namespace derham::meshes {
namespace {

void check_radii(double major, double minor) {
  detail::require_positive("the minor radius", minor);
  detail::require_positive("the major radius", major);
  if (!(minor < major))
    throw InputError(
        text("the minor radius ", minor, " is not below the major radius ", major, "; the torus would meet itself"));
}

double angle(Index i, Index count) {
  return 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
}

/// a x b squares with opposite sides identified, each cut in two; vertex (i, j) is number i + a j.
MeshData square_torus(Index a, Index b, int ambient_dimension) {
  detail::require_at_least("the number of segments", a, 3);
  detail::require_at_least("the number of sides", b, 3);
  const auto rows = static_cast<std::size_t>(detail::checked_count("triangles", {2, a, b}));
  MeshData mesh;
  mesh.ambient_dimension = ambient_dimension;
  mesh.vertex_count = static_cast<Index>(rows / 2);
  mesh.points.reserve(rows / 2 * static_cast<std::size_t>(ambient_dimension));
  std::vector<Index> vertices;
  vertices.reserve(rows * 3);
  for (Index j = 0; j < b; ++j)
    for (Index i = 0; i < a; ++i) {
      const Index east = i + 1 == a ? 0 : i + 1, row = a * j, north = a * (j + 1 == b ? 0 : j + 1);
      for (const Index v : {row + i, row + east, north + east, row + i, north + east, north + i}) vertices.push_back(v);
    }
  mesh.simplices = SimplexList(2, std::move(vertices));
  return mesh;
}

}  // namespace

MeshData torus(Index segments, Index sides, double major, double minor) {
  check_radii(major, minor);
  MeshData mesh = square_torus(segments, sides, 3);
  for (Index j = 0; j < sides; ++j)
    for (Index i = 0; i < segments; ++i) {
      const double s = angle(i, segments), t = angle(j, sides), distance = major + minor * std::cos(t);
      for (const double x : {distance * std::cos(s), distance * std::sin(s), minor * std::sin(t)})
        mesh.points.push_back(x);
    }
  return mesh;
}

MeshData clifford_torus(Index a, Index b, double radius) {
  detail::require_positive("the radius", radius);
  MeshData mesh = square_torus(a, b, 4);
  for (Index j = 0; j < b; ++j)
    for (Index i = 0; i < a; ++i) {
      const double s = angle(i, a), t = angle(j, b);
      for (const double x : {std::cos(s), std::sin(s), std::cos(t), std::sin(t)}) mesh.points.push_back(radius * x);
    }
  return mesh;
}

MeshData solid_torus(Index rings, Index segments, double major, double minor) {
  check_radii(major, minor);
  detail::require_at_least("the number of rings", rings, 1);
  detail::require_at_least("the number of segments", segments, 3);
  const auto rows = static_cast<std::size_t>(detail::checked_count("simplices", {18, rings, rings, segments}));

  // The disk: points of the hexagonal lattice, its hexagonal shells made round.
  const Index side = 2 * rings + 1;
  std::vector<Index> disk_ids;
  std::vector<double> disk;
  for (Index y = -rings; y <= rings; ++y)
    for (Index x = -rings; x <= rings; ++x) {
      const std::array<Index, 2> z{x, y};
      const bool inside = detail::steps_from_origin(z) <= rings;
      disk_ids.push_back(inside ? static_cast<Index>(disk.size() / 2) : -1);
      if (inside) detail::append_shell_point(z, minor / static_cast<double>(rings), disk);
    }

  MeshData mesh;
  mesh.ambient_dimension = 3;
  const auto disk_size = static_cast<Index>(disk.size() / 2);
  mesh.vertex_count = static_cast<Index>(detail::checked_count("vertices", {disk_size, segments}));
  mesh.points.reserve(static_cast<std::size_t>(mesh.vertex_count) * 3);
  for (Index k = 0; k < segments; ++k) {
    const double cosine = std::cos(angle(k, segments)), sine = std::sin(angle(k, segments));
    for (std::size_t v = 0; v < disk.size(); v += 2) {
      const double distance = major + disk[v];
      for (const double x : {distance * cosine, distance * sine, -disk[v + 1]}) mesh.points.push_back(x);
    }
  }

  const detail::KuhnCutter cutter(3);
  const std::array<Index, 3> counts{side - 1, side - 1, segments};
  std::vector<Index> vertices;
  vertices.reserve(rows * 4);
  std::array<Index, 8> ids{};
  detail::GridIndex cube(counts);
  do {
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const Index x = cube[0] + static_cast<Index>(corner & 1), y = cube[1] + static_cast<Index>(corner >> 1 & 1);
      const Index k = cube[2] + static_cast<Index>(corner >> 2 & 1);
      const Index id = disk_ids[static_cast<std::size_t>(x + side * y)];
      ids[corner] = id < 0 ? -1 : id + disk_size * (k == segments ? 0 : k);
    }
    cutter.cut(ids, vertices);
  } while (cube.advance());
  mesh.simplices = SimplexList(3, std::move(vertices));
  return mesh;
}

}  // namespace derham::meshes
