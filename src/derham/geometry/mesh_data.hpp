#pragma once

#include "derham/complex/simplex_list.hpp"
#include "derham/core/types.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace derham {

/// A named set of simplices of one dimension: a physical group of Gmsh, a marker of TetGen, a reference of Medit.
struct MeshPart {
  std::string name;         ///< empty if the source has only a number
  std::int64_t number = 0;  ///< the source's number; unique among the parts of one degree
  int degree = 0;

  /// In increasing order: rows of the mesh if `degree` is its dimension, else vertices if `degree` is 0, else rows of
  /// `MeshData::lower[degree]`.
  std::vector<Index> members;

  friend bool operator==(const MeshPart&, const MeshPart&) = default;
};

/// Numbers on the vertices or on the rows of a mesh, as files carry them.
struct MeshField {
  enum class On : std::uint8_t { vertices, rows };
  std::string name;
  On on = On::vertices;
  int components = 1;
  std::vector<double> values;  ///< shape (vertices or rows, components) row-major

  friend bool operator==(const MeshField&, const MeshField&) = default;
};

/// The values of a discrete k-form as files carry them, by the index of the simplex (of the primal one, also for dual).
struct MeshForm {
  std::string name;
  int degree = 0;  ///< of the form: a dual k-form has one value per (n-k)-simplex
  bool is_dual = false;
  std::vector<double> values;

  friend bool operator==(const MeshForm&, const MeshForm&) = default;
};

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

  /// Squared length of every edge, by the index of the edge in the complex, where the source gives the metric so.
  std::vector<double> edge_lengths_squared;

  /// What the source lists of lower dimension than the rows: lower[k] are the k-simplices, k < n, in the source's
  /// order. They are not part of the complex but name its simplices (see `parts`); may be shorter than n.
  std::vector<SimplexList> lower;

  std::vector<MeshPart> parts;
  std::vector<MeshField> fields;
  std::vector<MeshForm> forms;

  /// What the reader did that the reader of its result should know, e.g. "welded 36 corners to 8 vertices".
  std::vector<std::string> notes;

  [[nodiscard]] bool has_points() const noexcept { return !points.empty(); }
  [[nodiscard]] bool has_corners() const noexcept { return !corners.empty(); }

  /// How many simplices `lower` holds.
  [[nodiscard]] Offset lower_count() const noexcept {
    Offset count = 0;
    for (const auto& list : lower) count += list.size();
    return count;
  }
};

}  // namespace derham
