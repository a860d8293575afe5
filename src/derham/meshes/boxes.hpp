#pragma once

#include "derham/geometry/mesh_data.hpp"

#include <cstdint>
#include <vector>

namespace derham::meshes {

struct BoxOptions {
  /// Lengths of the sides, one per axis; empty: all 1.
  std::vector<double> lengths{};
  /// Every interior vertex moves along every axis by jitter * (length of a cell) * a random number of [-1/2, 1/2).
  /// Below 1/n no simplex is inverted.
  double jitter = 0;
  /// The same seed gives the same mesh everywhere.
  std::uint64_t seed = 1;
};

/// The box [0, lengths[0]] x … x [0, lengths[n-1]] of cells[0] x … x cells[n-1] cubes, each cut into n! simplices along
/// its main diagonal. n = cells.size(), 1 to 6. Vertices and cubes are numbered with axis 0 fastest; simplices are
/// positively oriented. Many dual volumes of an unjittered box are zero.
/// Cost     linear
/// Throws   InputError if a count is < 1, a length is not positive, jitter is not in [0, 1]; LimitError
/// Source   Freudenthal 1942; Kuhn 1960
[[nodiscard]] MeshData box(const std::vector<Index>& cells, const BoxOptions& options = {});

/// The box with the same number of cells along every axis.
[[nodiscard]] MeshData box(int n, Index cells, const BoxOptions& options = {});

/// The box with opposite sides identified: a flat n-torus. It has no `points` but `corners`: a simplex that crosses a
/// side has coordinates beyond it. Edge lengths follow from them (`squared_edge_lengths`). Jitter moves every vertex.
/// Throws   as `box`; and InputError if a count is < 3, for then different simplices have the same vertices
[[nodiscard]] MeshData periodic_box(const std::vector<Index>& cells, const BoxOptions& options = {});
[[nodiscard]] MeshData periodic_box(int n, Index cells, const BoxOptions& options = {});

/// Squared lengths of the edges of every row, from points or corners: shape (rows, n(n+1)/2), the pairs of a row's
/// vertices in lexicographic order of their places (0,1), (0,2), …, (n-1,n).
/// Units    length^2
/// Throws   InputError if the mesh is abstract or mixes dimensions
[[nodiscard]] std::vector<double> squared_edge_lengths(const MeshData& mesh);

}  // namespace derham::meshes
