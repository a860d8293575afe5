#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/geometry/material.hpp"
#include "derham/geometry/volumes.hpp"

#include <cmath>
#include <limits>
#include <vector>

namespace derham {

/// Signed circumcentric dual volumes and primal volumes of every degree, whatever the mesh: nothing is refused here.
///
/// The dual of a top simplex has volume 1, and D(σ^k) = 1/(n-k) Σ h±(σ^k, σ^{k+1}) D(σ^{k+1}) over the cofaces, where
/// h± is the distance of the circumcentre of σ^{k+1} from σ^k, positive on the side of the opposite vertex. Every
/// simplex is measured once, from the top degree down.
///
/// What rounding could explain is exactly 0: a height h of at most 1e-10 of the circumradius of σ^{k+1}, and a sum that
/// could vanish if every h were wrong by 1e-10 of itself, in both cases plus 16 ulp of the coordinates. So a right-angled
/// mesh keeps its zeros under every rigid motion and scaling. NaN marks the simplices of degenerate top simplices, whose
/// dual cells do not exist, and volumes out of the range of doubles.
template <int n>
struct CircumcentricDual {
  ByDegree<n> primal;             ///< [k] (|K_k|,) volumes; units length^k
  ByDegree<n> dual;               ///< [k] (|K_k|,) signed volumes of the dual cells; units length^(n-k)
  std::vector<Index> degenerate;  ///< top simplices left out, as QualityReport::degenerate
  bool well_centered = true;      ///< every simplex of every degree contains its circumcentre in its interior
};

/// Cost     one pass over the simplices of every degree, on all threads where numbering is local; the same bits for any number; beside the
///          result, 16 bytes for every simplex of two degrees at a time
/// Source   Elcott & Schröder, "Building your own DEC at home", §6.2.1, with 1/(n-k) and the signs of Hirani,
///          Kalyanaraman, VanderZee, "Delaunay Hodge star", 2013
template <int n>
[[nodiscard]] CircumcentricDual<n> circumcentric_dual(const SimplicialComplex<n>& K, const Geometry<n>& geometry);

/// dual/primal, an entry of the diagonal star; NaN where it is undefined or out of the range of normal doubles.
[[nodiscard]] inline double star_entry(double dual, double primal) noexcept {
  const double star = dual / primal;
  return dual == 0 || std::isnormal(star) ? star : std::numeric_limits<double>::quiet_NaN();
}

/// The signed dual volumes, [k] (|K_k|,), units length^(n-k).
/// Law      Σ |σ^k| D(σ^k) = C(n,k) |M| for every k, on every mesh
/// Throws   GeometryError naming the degenerate top simplices, if there are any, or a simplex whose dual volume is out of
///          the range of doubles
template <int n>
[[nodiscard]] ByDegree<n> dual_volumes(const SimplicialComplex<n>& K, const Geometry<n>& geometry);

/// Volumes of the barycentric dual cells: the cells whose corners are barycentres. All positive, even where simplices
/// are flat. Use them for k = 0 and k = n only: for 0 < k < n these cells are not orthogonal to their simplices, and
/// the diagonal star made of them does not converge. A material weighs the parts of the cells in the top simplices.
/// Law      Σ |σ^k| D(σ^k) = C(n,k) Σ a_T |T| for k = 0 and k = n only
/// Throws   InputError if the material does not fit, or holds tensors
template <int n>
[[nodiscard]] ByDegree<n> barycentric_dual_volumes(const SimplicialComplex<n>& K, const Geometry<n>& geometry,
                                                   const Material& material = {});

}  // namespace derham
