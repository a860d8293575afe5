#pragma once

#include "derham/geometry/mesh_data.hpp"

namespace derham::meshes {

/// One regular n-simplex of edge length 1 in R^n about the origin, positively oriented, n = 1 to 6.
[[nodiscard]] MeshData regular_simplex(int n);

/// S^n as the n+2 facets of the regular (n+1)-simplex inscribed in the unit sphere of R^(n+1), n = 0 to 6; outward
/// oriented.
[[nodiscard]] MeshData simplex_boundary(int n);

/// S^n as the 2^(n+1) facets of the cross polytope with vertices ±e_i in R^(n+1), n = 0 to 6; outward oriented.
/// Vertex 2i is +e_i, vertex 2i+1 is -e_i.
[[nodiscard]] MeshData cross_polytope(int n);

/// S^3 as the 600 tetrahedra of the 600-cell: 120 unit icosians in R^4, edges 1/φ; outward oriented.
/// Source   Coxeter, "Regular polytopes", §8.7
[[nodiscard]] MeshData cell_600();

}  // namespace derham::meshes
