#pragma once

#include "derham/geometry/mesh_data.hpp"

namespace derham::meshes {

/// The smallest mesh that shows everything: two regular tetrahedra of edge 3√2 on both sides of the triangle (0, 1, 2),
/// with apexes 3 and 4 at integer points. 5 vertices, 9 edges, 7 triangles, 2 tetrahedra; the representatives (0,1,2,3)
/// and (0,1,2,4) have opposite signs, every dual volume is positive.
/// Source   in the spirit of Elcott & Schröder, "Building your own DEC at home", Figure 4
[[nodiscard]] MeshData example();

}  // namespace derham::meshes
