#pragma once

#include "derham/core/types.hpp"
#include "derham/geometry/mesh_data.hpp"

#include <span>

namespace derham {

/// A quadrangle that stands among the triangles of a mesh as that of its first three corners.
struct GmshQuadrangle {
  Index position, fourth_corner;
};

/// Makes two triangles of each: (a, b, c) and (a, c, d), one behind the other, both with its number, parts and values of
/// fields; and says so in the notes. `quadrangles` are in order of position.
/// Throws   LimitError if the triangles are too many for the index type
void split_quadrangles(MeshData& mesh, std::span<const GmshQuadrangle> quadrangles);

}  // namespace derham
