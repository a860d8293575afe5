#include "derham/meshes/lattices.hpp"

#include "derham/meshes/boxes.hpp"
#include "derham/meshes/counts.hpp"
#include "derham/meshes/kuhn.hpp"

#include <numeric>

namespace derham::meshes {

MeshData a_star_lattice(int n, Index cells, double scale) {
  detail::require_dimension(n, 1, max_dimension);
  detail::require_positive("the scale", scale);
  detail::require_at_least("the number of cells along an axis", cells, 3);
  const std::vector<double> unit_cells(static_cast<std::size_t>(n), static_cast<double>(cells));
  MeshData mesh = periodic_box(n, cells, {.lengths = unit_cells});
  const double share = (1 - 1 / std::sqrt(n + 1.0)) / n;
  for (auto z = mesh.corners.begin(); z != mesh.corners.end(); z += n) {
    const double sum = std::accumulate(z, z + n, 0.0);
    std::transform(z, z + n, z, [&](double zi) { return scale * (zi - share * sum); });
  }
  return mesh;
}

MeshData bcc_lattice(Index cells, double cell_length) {
  detail::require_positive("the cell length", cell_length);
  detail::require_at_least("the number of cells along an axis", cells, 3);
  const std::size_t rows = static_cast<std::size_t>(detail::checked_count("simplices", {12, cells, cells, cells}));

  // Points in half cells; a tetrahedron is the segment between the centres of two cubes and one edge of their common
  // face, walked counter-clockwise about the segment.
  struct Point {
    std::array<Offset, 3> at;
  };
  MeshData mesh;
  mesh.ambient_dimension = 3;
  mesh.vertex_count = static_cast<Index>(rows / 6);
  mesh.corners.reserve(rows * 12);
  std::vector<Index> vertices;
  vertices.reserve(rows * 4);
  const auto add = [&](const Point& point) {
    Offset cube = 0;
    for (std::size_t axis = 3; axis-- > 0;) cube = cube * cells + point.at[axis] / 2 % cells;
    vertices.push_back(static_cast<Index>(2 * cube + point.at[0] % 2));
    for (const Offset half : point.at) mesh.corners.push_back(cell_length * static_cast<double>(half) / 2);
  };
  const std::array<Index, 3> counts{cells, cells, cells};
  detail::GridIndex cube(counts);
  do {
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
      constexpr std::array<std::array<Offset, 2>, 4> square{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}};
      for (std::size_t side = 0; side < 4; ++side) {
        const Point corner{{2 * Offset{cube[0]}, 2 * Offset{cube[1]}, 2 * Offset{cube[2]}}};
        Point below{{corner.at[0] + 1, corner.at[1] + 1, corner.at[2] + 1}}, above = below, from = corner, to = corner;
        above.at[a] += 2;
        for (Point* end : {&from, &to}) {
          const auto& place = square[(side + (end == &to)) % 4];
          end->at[a] += 2;
          end->at[b] += place[0];
          end->at[c] += place[1];
        }
        for (const Point& point : {below, above, from, to}) add(point);
      }
    }
  } while (cube.advance());
  mesh.simplices = SimplexList(3, std::move(vertices));
  return mesh;
}

}  // namespace derham::meshes
