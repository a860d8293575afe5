#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/forms/form.hpp"
#include "derham/geometry/geometry.hpp"

#include <span>
#include <vector>

namespace derham {

// Vector fields have d components, d = geometry.coordinate_dimension(), on every top simplex, shape (|K_n|, d), or at every
// vertex, (|V|, d), row-major. On a top simplex they are in the chart of its corners, with edge lengths only in the
// simplex's own frame; they are tangential to it. Sharp makes vectors of 1-forms, flat 1-forms of vectors. All are exact
// for constant fields and forms; flat(sharp) and sharp(flat) are the identity on these only. All throw InputError for
// wrong shapes and a geometry of another complex, GeometryError naming flat top simplices; pp_sharp and dpp_flat TopologyError unless K is pure. All give
// the same bits for any number of threads.

/// Whitney sharp: the Whitney form at the barycentre of every top simplex.
/// Shape    (|K_n|, d)
/// Exact    for constant forms, at any boundary
template <int n>
  requires(n >= 1)
[[nodiscard]] std::vector<double> whitney_sharp(const Geometry<n>& geometry, const PrimalForm<n, 1>& w);

/// PD sharp (primal form to dual field): the Whitney form at the dual vertex, the circumcentre, which may lie outside of
/// the simplex; the form is continued linearly.
/// Shape    (|K_n|, d)
/// Exact    for constant forms
template <int n>
  requires(n >= 1)
[[nodiscard]] std::vector<double> pd_sharp(const Geometry<n>& geometry, const PrimalForm<n, 1>& w);

/// PP sharp (primal form to primal field): at vertex v the mean of X_T = Σ_{u≠v} w[v,u] ∇λ_u over the top simplices T
/// around v, weighted by their shares |⋆v ∩ T| of its dual cell, signed; by their volumes where the dual cell has none.
/// Shape    (|V|, d)
/// Exact    for constant forms, with weights of any sign, at the boundary too
/// Invalid  tangentially on surfaces in space: a mean of vectors of different planes
/// Throws   GeometryError unless geometry.has_common_frame(): vectors of different simplices cannot be compared else
/// Source   Hirani 2003, definition 5.8.1
template <int n>
  requires(n >= 1)
[[nodiscard]] std::vector<double> pp_sharp(const Geometry<n>& geometry, const PrimalForm<n, 1>& w);

/// DPP flat (dual field, constant on primal top simplices, to primal form): on edge e the mean of X_T · e over the top
/// simplices T around it, weighted by their shares |⋆e ∩ T| of its dual cell, signed; by their volumes where the dual
/// cell has none, as on the diagonals of grids.
/// Shape    vectors (|K_n|, d)
/// Exact    for constant fields
/// Invalid  as an accurate mean where shares of different signs nearly cancel: then differences of X_T are amplified
/// Source   Hirani 2003, definition 5.5.2
template <int n>
  requires(n >= 1)
[[nodiscard]] PrimalForm<n, 1> dpp_flat(const SimplicialComplex<n>& K, const Geometry<n>& geometry,
                                        std::span<const double> vectors);

/// DPD flat (dual field, constant on primal top simplices, to dual form): the integral along the dual edges, Σ X_T · piece.
/// Shape    vectors (|K_n|, d)
/// Exact    for constant fields: (-1)^(n-1) ⋆ of the flux if K is oriented by volume, minus that if it is turned over; at the
///          boundary along the half edge inside
/// Throws   TopologyError if K is not orientable: dual edges have no direction then
/// Source   Hirani 2003, chapter 5
template <int n>
  requires(n >= 1)
[[nodiscard]] DualForm<n, 1> dpd_flat(const SimplicialComplex<n>& K, const Geometry<n>& geometry,
                                      std::span<const double> vectors);

/// PPP flat (primal field, linear on primal simplices, to primal form): ½ (X_a + X_b) · e on the edge from a to b.
/// Shape    vectors (|V|, d)
/// Exact    for linear fields; of second order for others
/// Throws   GeometryError unless geometry.has_common_frame()
/// Source   Hirani 2003, chapter 5
template <int n>
  requires(n >= 1)
[[nodiscard]] PrimalForm<n, 1> ppp_flat(const SimplicialComplex<n>& K, const Geometry<n>& geometry,
                                        std::span<const double> vectors);

}  // namespace derham
