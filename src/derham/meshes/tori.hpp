#pragma once

#include "derham/geometry/mesh_data.hpp"

namespace derham::meshes {

/// The torus of revolution about the z axis in R^3: 2 segments·sides triangles, seen counter-clockwise from outside.
/// `segments` go the long way round (radius `major` of the core circle), `sides` about the tube (radius `minor`).
/// Throws   InputError if a count is < 3 or not 0 < minor < major; LimitError
[[nodiscard]] MeshData torus(Index segments, Index sides, double major = 1, double minor = 0.4);

/// The flat torus in R^4: (cos s, sin s, cos t, sin t)·radius, 2 a b coherently oriented triangles, a, b >= 3.
[[nodiscard]] MeshData clifford_torus(Index a, Index b, double radius = 1);

/// The solid torus of revolution about the z axis: disks of 6 rings^2 triangles at `segments` angles, the prisms
/// between cut into three: 18 rings^2 segments positively oriented tetrahedra, (3 rings^2 + 3 rings + 1) segments
/// vertices. Edges are about equally long when segments ≈ 2π rings major / minor (rings = 6, segments = 94: 60,912
/// tetrahedra).
/// Throws   InputError if rings < 1, segments < 3 or not 0 < minor < major; LimitError
[[nodiscard]] MeshData solid_torus(Index rings, Index segments, double major = 1, double minor = 0.4);

}  // namespace derham::meshes
