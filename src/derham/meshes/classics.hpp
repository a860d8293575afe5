#pragma once

#include "derham/complex/simplex_list.hpp"

namespace derham::meshes {

// Small triangulations with known invariants, without positions. f is the number of simplices of each degree.

/// S^1 as a polygon of `size` >= 3 edges.
[[nodiscard]] SimplexList cycle(Index size);
/// An interval of `size` >= 1 edges.
[[nodiscard]] SimplexList path(Index size);
/// S^n as the boundary of the (n+1)-simplex, n = 0 to 6.
[[nodiscard]] SimplexList sphere(int n);
/// RP^2 on 6 vertices (the half icosahedron): f = (6, 15, 10), H_1 = Z_2.
[[nodiscard]] SimplexList projective_plane();
/// The Klein bottle on 8 vertices: f = (8, 24, 16).
[[nodiscard]] SimplexList klein_bottle();
/// The torus on 7 vertices (Möbius 1861, Császár 1949): f = (7, 21, 14).
[[nodiscard]] SimplexList csaszar_torus();
/// The Möbius strip on 5 vertices: f = (5, 10, 5).
[[nodiscard]] SimplexList moebius_strip();
/// The annulus on 6 vertices: f = (6, 12, 6).
[[nodiscard]] SimplexList annulus();
/// CP^2 on 9 vertices: f = (9, 36, 84, 90, 36), β = (1, 0, 1, 0, 1).
/// Source   Kühnel & Banchoff, "The 9-vertex complex projective plane", 1983
[[nodiscard]] SimplexList complex_projective_plane();
/// The Poincaré sphere on 16 vertices: f = (16, 106, 180, 90), the homology of S^3 but another fundamental group.
/// Source   Björner & Lutz, "Simplicial manifolds, bistellar flips and a 16-vertex triangulation of the Poincaré
///          homology 3-sphere", 2000
[[nodiscard]] SimplexList poincare_sphere();
/// The lens space L(p, q), p >= 1: the barycentric subdivision of the join of two 3p-gons modulo the rotation by 3 and
/// 3q steps; H_1 = Z_p. L(3, 1) has f = (120, 768, 1296, 648).
/// Throws   InputError unless p >= 1 and gcd(p, q) = 1
[[nodiscard]] SimplexList lens_space(int p, int q);
/// T^n as a periodic box of cells^n cubes, n = 1 to 6, cells >= 3. T^3: f = (27, 189, 324, 162).
[[nodiscard]] SimplexList grid_torus(int n, Index cells = 3);

}  // namespace derham::meshes
