#pragma once

#include "derham/complex/simplicial_complex.hpp"

#include <span>
#include <vector>

namespace derham {

/// Other numbers for the vertices and another order of the rows of a list of simplices, with the way back. In a good one
/// what is near has near numbers, and tables are read from the cache: see ARCHITECTURE.md. Two ways to find one:
///   `reverse_cuthill_mckee`  needs no positions: any complex of any dimension
///   `hilbert_order`          (geometry) needs positions, costs about half and is nearly as good
struct Renumbering {
  std::vector<Index> new_vertex;  ///< (vertices,) the new number of each vertex
  std::vector<Index> old_row;     ///< (rows,) the row that moves to each place
};

/// Vertices breadth first from one that is far away from others, neighbours of few rows first, reversed; rows by their
/// lowest new vertex. Vertices in no row come last. The vertices of neighbours differ by about the size of two layers.
/// Cost     linear (but for the sorting of the neighbours of each vertex)
/// Throws   InputError if a vertex id is outside [0, vertex_count)
/// Source   Cuthill & McKee, "Reducing the bandwidth of sparse symmetric matrices", 1969; George, 1971 (reversed); the
///          first vertex after George & Liu, 1979, one step
[[nodiscard]] Renumbering reverse_cuthill_mckee(const SimplexList& rows, Index vertex_count);

/// The rows in the order of their lowest new vertex, those with the same one in the order in which they were.
/// `new_vertex` is a permutation.
/// Cost     linear
[[nodiscard]] Renumbering with_rows_in_order(std::vector<Index> new_vertex, const SimplexList& rows);

/// The rows with their new vertices in their new order. The order of the vertices within a row stays, and so does its
/// orientation.
[[nodiscard]] SimplexList renumbered(const SimplexList& rows, const Renumbering& renumbering);

/// How far apart the vertices of a row are: highest minus lowest number. 0 for an empty list.
struct VertexGaps {
  double mean = 0;
  Index largest = 0;  ///< the bandwidth of the graph of vertices
};
[[nodiscard]] VertexGaps vertex_gaps(const SimplexList& rows);

/// Where every k-simplex of K is in L, the complex of the renumbered rows, and the sign that its value takes there: the
/// renumbering changes which order of its vertices is the representative. Top simplices are compared as they are oriented.
/// Shape    (|K_k|,)
/// Cost     a search for every simplex
/// Throws   InputError unless 0 <= k <= n, or if L is not the renumbered K
template <int n>
[[nodiscard]] std::vector<SignedIndex> simplex_map(const SimplicialComplex<n>& K, const SimplicialComplex<n>& L,
                                                   const Renumbering& renumbering, int k);

/// Orients every component of L, the complex of the renumbered rows of K, as it is oriented in K. Only then do the signs
/// of `simplex_map` hold for dual forms, too. Does nothing when K is not orientable.
template <int n>
void orient_as(SimplicialComplex<n>& L, const SimplicialComplex<n>& K, const Renumbering& renumbering);

/// Values on the k-simplices of K as values on those of L, and back; `map` is the simplex_map of degree k.
/// Throws   InputError if there are not as many values as simplices
[[nodiscard]] std::vector<double> carried(std::span<const double> values, std::span<const SignedIndex> map);
[[nodiscard]] std::vector<double> carried_back(std::span<const double> values, std::span<const SignedIndex> map);

}  // namespace derham
