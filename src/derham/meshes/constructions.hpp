#pragma once

#include "derham/complex/simplex_list.hpp"
#include "derham/geometry/mesh_data.hpp"

#include <span>

namespace derham::meshes {

// New complexes from old ones. All throw InputError on a negative vertex id and LimitError when the result does not
// fit. A coherently oriented argument gives a coherently oriented result, and positively oriented tuples stay so.

/// A and B side by side: the vertices of B follow those of A.
[[nodiscard]] SimplexList disjoint_union(const SimplexList& A, const SimplexList& B);
/// Throws   InputError also if one has points and the other has not, or they live in spaces of different dimension
[[nodiscard]] MeshData disjoint_union(const MeshData& A, const MeshData& B);

/// All simplices a ∪ b: the vertices of B follow those of A, row (i, j) is number i·|B| + j.
[[nodiscard]] SimplexList join(const SimplexList& A, const SimplexList& B);

/// The join with one new vertex, number A.vertex_bound().
[[nodiscard]] SimplexList cone(const SimplexList& A);

/// The join with two new vertices; first the cone with one, then with the other.
[[nodiscard]] SimplexList suspension(const SimplexList& A);

/// The product of two complexes whose vertices are ordered by their ids: every a x b is cut into C(p+q, p) simplices,
/// the monotone staircases from its first vertex pair to its last. Vertex (u, v) is number u·B.vertex_bound() + v.
/// Source   Eilenberg & Steenrod, "Foundations of algebraic topology", 1952, II.8
[[nodiscard]] SimplexList product(const SimplexList& A, const SimplexList& B);
/// Points of the product are those of A followed by those of B.
/// Throws   InputError also if only one of them has points, or either has corners
[[nodiscard]] MeshData product(const MeshData& A, const MeshData& B);

/// A vertex for every simplex, a simplex for every flag: each n-simplex is cut into (n+1)!. The vertices of A keep
/// their ids, then come the edges in the order of the complex, the triangles, … Rows of one input row stay together, in
/// order.
/// Throws   InputError also if the rows have different dimensions or are no simplicial complex (see SimplicialComplex)
[[nodiscard]] SimplexList barycentric_subdivision(const SimplexList& A);
/// Points and corners of the new vertices are the means of those of their simplices.
[[nodiscard]] MeshData barycentric_subdivision(const MeshData& A);

/// Vertex v becomes image[v] and thereby one with all others of the same image.
/// Throws   InputError naming the row if image is too short or negative, if a row loses a vertex, or if two rows become
///          one: the result would be no simplicial complex with as many top simplices. Subdivide first.
[[nodiscard]] SimplexList quotient(const SimplexList& A, std::span<const Index> image);
/// Points become corners: every row stays where it was.
[[nodiscard]] MeshData quotient(const MeshData& A, std::span<const Index> image);

}  // namespace derham::meshes
