#pragma once

#include "derham/geometry/mesh_data.hpp"

namespace derham {

/// The first vertex that is in no row, -1 if all are used.
/// Cost     linear in the rows, whatever `vertex_count` is
/// Throws   InputError if a row has a vertex outside [0, vertex_count)
[[nodiscard]] Index first_unused_vertex(const MeshData& mesh);

/// Removes all vertices that are in no row, keeping the order of the others, and returns how many they were. If there
/// were any, `vertex_tags` then holds what the remaining ones were called before (their tag, else their position).
/// Simplices of lower dimension that have such a vertex go, too, and so do they and the vertices as members of parts: how
/// many is a note.
/// Throws   InputError as above
Index drop_unused_vertices(MeshData& mesh);

/// Of `count` cells of higher order (`cells` is what the format calls them) only the corners were kept: removes the
/// vertices that no row uses any more, if there are such cells, and says so in the notes.
void drop_mid_nodes(MeshData& mesh, Offset count, const char* cells);

}  // namespace derham
