#pragma once

#include "derham/complex/simplex_list.hpp"
#include "derham/core/types.hpp"

#include <cstdint>
#include <vector>

namespace derham {

/// A mesh as it came from a file or a generator: simplices and, if there are any, positions. Nothing is checked yet.
struct MeshData {
  SimplexList simplices;

  /// Number of vertices the source declares; at least simplices.vertex_bound() in a sound mesh.
  Index vertex_count = 0;

  /// Dimension m of space; 0 when the mesh is abstract (no positions at all).
  int ambient_dimension = 0;

  /// Positions, shape (vertex_count, m) row-major; empty for abstract meshes and for meshes given by `corners`.
  std::vector<double> points;

  /// Positions of the corners of every row on their own, shape (rows, n+1, m) row-major in the row's vertex order:
  /// for periodic meshes, where a vertex has no single position. Empty otherwise.
  std::vector<double> corners;

  /// The source's own ids of vertices and of rows (e.g. the node numbers of a Gmsh file); empty: they are positions.
  std::vector<std::int64_t> vertex_tags;
  std::vector<std::int64_t> row_tags;

  /// How many simplices of lower dimension the reader ignored.
  Offset ignored_lower = 0;

  [[nodiscard]] bool has_points() const noexcept { return !points.empty(); }
  [[nodiscard]] bool has_corners() const noexcept { return !corners.empty(); }
};

}  // namespace derham
