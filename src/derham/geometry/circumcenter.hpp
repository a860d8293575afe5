#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/geometry/geometry.hpp"

#include <span>
#include <vector>

namespace derham {

/// The point of the plane of a simplex at equal distance from all its vertices. It may lie outside the simplex.
struct Circumcenter {
  std::vector<double> barycentric;  ///< (k+1,), sums to 1
  std::vector<double> point;        ///< (m,)
  double radius = 0;                ///< units length
};

/// Circumcentre of k+1 points of R^m, `points` shape (k+1, m) row-major, 0 <= k <= m.
/// Solves G λ = ½ diag(G), G the Gram matrix of the edges from point 0, by orthogonalisation: the error grows with the
/// condition of the edges, not with its square.
/// Throws   InputError on a wrong shape; GeometryError if the points span no k-simplex: the smallest altitude is at most
///          max(relative_flatness * longest edge, 16 ulp of the largest coordinate)
/// Source   Elcott & Schröder, "Building your own DEC at home", §6.2.1
[[nodiscard]] Circumcenter circumcenter(std::span<const double> points, int k, int m, double relative_flatness = 1e-12);

/// Circumcentre of k-simplex i of K; `point` in coordinate_dimension() coordinates, in the chart of
/// geometry.simplex_corners(K, k, i).
/// Throws   GeometryError naming a simplex that is flat by geometry.relative_flatness(); no face of a top simplex that
///          is not degenerate is
template <int n>
[[nodiscard]] Circumcenter circumcenter(const SimplicialComplex<n>& K, const Geometry<n>& geometry, int k, Index i);

}  // namespace derham
