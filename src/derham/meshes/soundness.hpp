#pragma once

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/geometry/mesh_data.hpp"

namespace derham::meshes::detail {

/// Throws InputError naming the first row of `simplices` with a negative id.
inline void require_ids(const SimplexList& simplices) {
  for (Offset i = 0; i < simplices.size(); ++i)
    for (const Index v : simplices[i])
      if (v < 0)
        throw InputError(text("row ", i, " ", tuple_text(simplices[i]), " has the vertex ", v, "; ids are 0 or more"),
                         i);
}

/// Throws InputError if an id or the size of an array would lead outside the mesh.
inline void require_sound(const MeshData& mesh) {
  require_ids(mesh.simplices);
  const auto m = static_cast<std::size_t>(mesh.ambient_dimension);
  if (mesh.simplices.vertex_bound() > mesh.vertex_count)
    throw InputError(
        text("vertex ", mesh.simplices.vertex_bound() - 1, " is used; vertex_count is ", mesh.vertex_count));
  if (mesh.has_points() && mesh.points.size() != static_cast<std::size_t>(mesh.vertex_count) * m)
    throw InputError(
        text(mesh.points.size(), " coordinates are given for ", mesh.vertex_count, " points of dimension ", m));
  if (mesh.has_corners() && mesh.corners.size() != mesh.simplices.vertices().size() * m)
    throw InputError(text(mesh.corners.size(), " coordinates are given for ", mesh.simplices.vertices().size(),
                          " corners of dimension ", m));
}

}  // namespace derham::meshes::detail
