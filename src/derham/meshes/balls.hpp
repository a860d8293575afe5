#pragma once

#include "derham/geometry/mesh_data.hpp"

namespace derham::meshes {

/// The solid ball of R^n about the origin in `layers` shells, n = 1 to 6 (n = 2: a disk of 6 layers^2 triangles, n = 3:
/// 24 layers^3 tetrahedra). Radii are multiples of radius/layers; the boundary vertices lie on the sphere.
/// (layers+1)^(n+1) - layers^(n+1) vertices, (n+1)! layers^n positively oriented simplices.
/// The points of the lattice A_n* that are `layers` steps or fewer from the origin, each step's shell blown up to a
/// sphere.
/// Cost     linear
/// Throws   InputError if layers < 1 or radius is not positive; LimitError
[[nodiscard]] MeshData ball(int n, Index layers, double radius = 1);

/// The sphere of R^3 about the origin: an icosahedron, every triangle cut into four `level` times, new vertices pushed
/// out to the sphere. 10·4^level + 2 vertices, 20·4^level triangles, counter-clockwise seen from outside.
/// Throws   InputError if level < 0 or radius is not positive; LimitError
[[nodiscard]] MeshData icosphere(int level, double radius = 1);

}  // namespace derham::meshes
