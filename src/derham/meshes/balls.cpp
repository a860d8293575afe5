#include "derham/meshes/balls.hpp"

#include "derham/complex/simplicial_complex.hpp"
#include "derham/meshes/counts.hpp"
#include "derham/meshes/kuhn.hpp"
#include "derham/meshes/shells.hpp"

#include <numbers>

namespace derham::meshes {

MeshData ball(int n, Index layers, double radius) {
  detail::require_dimension(n, 1, max_dimension);
  detail::require_at_least("the number of layers", layers, 1);
  detail::require_positive("the radius", radius);
  const auto width = static_cast<std::size_t>(n);
  std::vector<Offset> factors(width, layers);
  factors.push_back(factorial(n + 1));
  const Offset rows = detail::checked_count("simplices", factors);
  detail::checked_count("lattice points", std::vector<Offset>(width, 2 * Offset{layers} + 1));

  MeshData mesh;
  mesh.ambient_dimension = n;
  std::vector<Index> ids;  // of the points of the cube of side 2 layers, -1 outside the ball
  const std::vector<Index> points_along(width, 2 * layers + 1), cubes_along(width, 2 * layers);
  detail::GridIndex at(points_along);
  std::array<Index, max_dimension> z{};
  do {
    for (std::size_t axis = 0; axis < width; ++axis) z[axis] = at[axis] - layers;
    const std::span<const Index> point(z.data(), width);
    const bool inside = detail::steps_from_origin(point) <= layers;
    ids.push_back(inside ? mesh.vertex_count++ : -1);
    if (inside) detail::append_shell_point(point, radius / static_cast<double>(layers), mesh.points);
  } while (at.advance());

  const detail::KuhnCutter cutter(n);
  std::vector<Index> corner_ids(std::size_t{1} << width), vertices;
  vertices.reserve(static_cast<std::size_t>(rows) * (width + 1));
  detail::GridIndex cube(cubes_along);
  do {
    for (std::size_t corner = 0; corner < corner_ids.size(); ++corner) {
      std::size_t place = 0;
      for (std::size_t axis = width; axis-- > 0;)
        place = place * static_cast<std::size_t>(points_along[axis]) + static_cast<std::size_t>(cube[axis]) +
                (corner >> axis & 1);
      corner_ids[corner] = ids[place];
    }
    cutter.cut(corner_ids, vertices);
  } while (cube.advance());
  mesh.simplices = SimplexList(n, std::move(vertices));
  return mesh;
}

namespace {

void append_on_sphere(std::array<double, 3> x, double radius, std::vector<double>& points) {
  const double factor = radius / std::hypot(x[0], x[1], x[2]);
  for (const double xi : x) points.push_back(factor * xi);
}

/// Every triangle cut into four; midpoints of edges are numbered after the vertices, in the order of the edges.
void refine(MeshData& mesh, double radius) {
  const SimplicialComplex<2> K(mesh.simplices);
  for (Index e = 0; e < K.size(1); ++e) {
    const auto edge = K.simplex<1>(e);
    const double *p = &mesh.points[static_cast<std::size_t>(edge[0]) * 3],
                 *q = &mesh.points[static_cast<std::size_t>(edge[1]) * 3];
    append_on_sphere({p[0] + q[0], p[1] + q[1], p[2] + q[2]}, radius, mesh.points);
  }
  std::vector<Index> vertices;
  vertices.reserve(static_cast<std::size_t>(K.size(2)) * 12);
  for (Offset t = 0; t < mesh.simplices.size(); ++t) {
    const auto row = mesh.simplices[t];
    const auto sorted = K.simplex<2>(static_cast<Index>(t));
    std::array<Index, 3> middle{};  // of the side opposite to each vertex of the row
    for (std::size_t i = 0; i < 3; ++i)
      for (int place = 0; place < 3; ++place)
        if (sorted[static_cast<std::size_t>(place)] == row[i])
          middle[i] = mesh.vertex_count + K.face_opposite(2, static_cast<Index>(t), place);
    for (const Index v : {row[0], middle[2], middle[1], row[1], middle[0], middle[2], row[2], middle[1], middle[0],  //
                          middle[0], middle[1], middle[2]})
      vertices.push_back(v);
  }
  mesh.vertex_count += K.size(1);
  mesh.simplices = SimplexList(2, std::move(vertices));
}

}  // namespace

MeshData icosphere(int level, double radius) {
  detail::require_at_least("the level", level, 0);
  detail::require_positive("the radius", radius);
  std::vector<Offset> factors(static_cast<std::size_t>(std::min(level, 40)), 4);  // 4^40 is beyond every limit
  factors.push_back(30);
  detail::checked_count("edges", factors);

  MeshData mesh;
  mesh.ambient_dimension = 3;
  mesh.vertex_count = 12;
  constexpr double phi = std::numbers::phi;
  for (const auto& x : std::to_array<std::array<double, 3>>({{-1, phi, 0},
                                                             {1, phi, 0},
                                                             {-1, -phi, 0},
                                                             {1, -phi, 0},  //
                                                             {0, -1, phi},
                                                             {0, 1, phi},
                                                             {0, -1, -phi},
                                                             {0, 1, -phi},  //
                                                             {phi, 0, -1},
                                                             {phi, 0, 1},
                                                             {-phi, 0, -1},
                                                             {-phi, 0, 1}}))
    append_on_sphere(x, radius, mesh.points);
  mesh.simplices = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int i = 0; i < level; ++i) refine(mesh, radius);
  return mesh;
}

}  // namespace derham::meshes
