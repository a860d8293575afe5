#pragma once

#include "derham/geometry/mesh_data.hpp"

namespace derham::meshes {

/// The Delaunay triangulation of the lattice A_n* on the torus R^n / (cells * lattice), with `corners`: all dual
/// volumes of all degrees are positive. n = 1 to 6: intervals, equilateral triangles (n = 2), body-centred tetrahedra
/// (n = 3), …. There are cells^n vertices and n! cells^n simplices, positively oriented. With scale 1 the pairs of
/// vertices at distance g along a simplex have squared length g(n+1-g)/(n+1): for n = 3 edges of √3/2 and 1. A_n* is
/// Z^n compressed along its main diagonal by 1/√(n+1), and Kuhn's cut of the cubes becomes Delaunay.
/// Throws   InputError if cells < 3 or scale is not positive; LimitError
/// Source   Conway & Sloane, "Low-dimensional lattices VI", 1992 (the obtuse superbasis)
[[nodiscard]] MeshData a_star_lattice(int n, Index cells, double scale = 1);

/// The body-centred cubic tetrahedra on the cubic torus of cells^3 cubes of side `cell_length`, with `corners`. Per
/// cube 2 vertices, 14 edges (6 long: the side of the cube, 8 short: √3/2 of it), 24 triangles, 12 tetrahedra
/// (disphenoids, well-centred, positively oriented). Vertices 2c and 2c+1 are the lower corner and the centre of cube
/// c. With cell_length 1 the stars are 1/2; 1/8 (long), 3/8 (short); 1; 12.
/// Throws   InputError if cells < 3 or cell_length is not positive; LimitError
/// Source   Sommerville 1923
[[nodiscard]] MeshData bcc_lattice(Index cells, double cell_length = 1);

}  // namespace derham::meshes
