#pragma once

#include "derham/complex/renumbering.hpp"
#include "derham/geometry/mesh_data.hpp"

namespace derham {

/// Vertices along a Hilbert curve through their positions (of a mesh given by corners: through the first corner of each),
/// rows by their lowest new vertex. Vertices of equal position keep their order, and such in no row of a mesh given by
/// corners count as at the first one.
/// Cost     V log V in the vertices, linear in the rows
/// Throws   InputError if the mesh is abstract; or if a vertex id is outside [0, vertex_count)
/// Source   Skilling, "Programming the Hilbert curve", 2004
[[nodiscard]] Renumbering hilbert_order(const MeshData& mesh);

/// Renumbers everything that a mesh holds: rows and lower simplices, positions, fields, parts, edge lengths and forms (with
/// the signs of their simplices; forms of top degree and dual forms go from one orientation to the other, which with n = m
/// is by volume). Simplices of lower dimension keep their order, and so do the vertices within every simplex.
/// `vertex_tags` and `row_tags` hold what each was called before: its tag, else its position.
/// Cost     linear; with edge lengths or forms that of two complexes
/// Throws   InputError if the renumbering is not of this mesh; or if it has edge lengths or forms, but not as many as the
///          complex has simplices
void renumber(MeshData& mesh, const Renumbering& renumbering);

}  // namespace derham
