#pragma once

#include "derham/core/error.hpp"
#include "derham/forms/form.hpp"
#include "derham/forms/wedge.hpp"

#include <span>

namespace derham {

// Products with dual forms that need no metric. None of them knows the shape of a dual cell, so none is exact on constant
// forms; each states the laws that it keeps.

/// ∫ a ∧ b of a primal k-form and a dual (n-k)-form: Σ a_i b_i over the k-simplices and their dual cells. With b = ⋆c
/// that is the inner product of a and c.
/// Laws     pair(d(a), b) + (-1)^k pair(a, d(b)) = 0 for a dual (n-k-1)-form b, to round-off
/// Throws   InputError if the forms belong to different complexes
/// Source   Elcott & Schröder, "Building your own DEC at home", §6.2; Hirani 2003, chapter 7
template <int n, int k>
[[nodiscard]] double pair(const Form<n, k, Side::primal>& a, const Form<n, n - k, Side::dual>& b) {
  if (&a.complex() != &b.complex()) throw InputError("the forms belong to different complexes");
  double sum = 0;
  for (Index i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// ∫ b ∧ a = (-1)^(k(n-k)) ∫ a ∧ b.
template <int n, int j>
[[nodiscard]] double pair(const Form<n, j, Side::dual>& b, const Form<n, n - j, Side::primal>& a) {
  return j * (n - j) % 2 == 0 ? pair(a, b) : -pair(a, b);
}

namespace detail {
/// y_i = x_i times the mean of f over the vertices of k-simplex i.
template <int n>
void scale_by_vertex_means(const SimplicialComplex<n>& K, int k, std::span<const double> f, std::span<const double> x,
                           std::span<double> y);
/// Throws   TopologyError unless K is pure
template <int n>
void require_tops_about_all(const SimplicialComplex<n>& K) {
  if (!K.is_pure())
    throw TopologyError("a simplex that belongs to no top simplex has no dual cell; the product needs a pure complex");
}
/// y_i = x_i times the mean of g over the top simplices that contain k-simplex i. Throws TopologyError unless K is pure.
template <int n>
void scale_by_top_means(const SimplicialComplex<n>& K, int k, std::span<const double> g, std::span<const double> x,
                        std::span<double> y);
}  // namespace detail

/// f ∧ b of a primal 0-form and a dual q-form: the value on a dual cell times the mean of f over the vertices of its
/// simplex.
/// Laws     1 ∧ b = b;  pair(a, f ∧ b) = pair(f ∧ a, b) for every primal (n-q)-form a;  ⋆(f ∧ a) = f ∧ ⋆a for diagonal ⋆
/// Invalid  Leibniz' rule holds for constant f only
/// Cost     one pass over the (n-q)-simplices; on several threads, same bits always
/// Throws   InputError if the forms belong to different complexes
template <int n, int q>
[[nodiscard]] Form<n, q, Side::dual> wedge(const Form<n, 0, Side::primal>& f, const Form<n, q, Side::dual>& b) {
  if (&f.complex() != &b.complex()) throw InputError("the forms belong to different complexes");
  Form<n, q, Side::dual> result(f.complex());
  detail::scale_by_vertex_means(f.complex(), n - q, f.values(), b.values(), result.values());
  return result;
}

/// g ∧ b of a dual 0-form and a dual q-form: the value on a dual cell times the mean of g over its corners, which are the
/// top simplices that contain its simplex.
/// Laws     1 ∧ b = b;  pair(a, g ∧ b) = pair(g ∧ a, b);  for q = 0 commutative, associative, and
///          d(g ∧ h) = dg ∧ h + g ∧ dh on every dual edge that joins two top simplices
/// Invalid  Leibniz' rule at the boundary, where dual edges have one corner
/// Cost     one pass over the top simplices
/// Throws   InputError as above; TopologyError unless K is pure
template <int n, int q>
[[nodiscard]] Form<n, q, Side::dual> wedge(const Form<n, 0, Side::dual>& g, const Form<n, q, Side::dual>& b) {
  if (&g.complex() != &b.complex()) throw InputError("the forms belong to different complexes");
  Form<n, q, Side::dual> result(g.complex());
  detail::scale_by_top_means(g.complex(), n - q, g.values(), b.values(), result.values());
  return result;
}

/// g ∧ a of a dual 0-form and a primal q-form: the value on a simplex times the mean of g over the top simplices that
/// contain it.
/// Laws     1 ∧ a = a;  pair(g ∧ a, b) = pair(a, g ∧ b);  for q = n the product of densities, exact
/// Invalid  Leibniz' rule holds for constant g only
/// Cost     one pass over the top simplices
/// Throws   as above
template <int n, int q>
[[nodiscard]] Form<n, q, Side::primal> wedge(const Form<n, 0, Side::dual>& g, const Form<n, q, Side::primal>& a) {
  if (&g.complex() != &a.complex()) throw InputError("the forms belong to different complexes");
  Form<n, q, Side::primal> result(g.complex());
  detail::scale_by_top_means(g.complex(), q, g.values(), a.values(), result.values());
  return result;
}

/// a ∧ b of dual 1-forms on a surface: for the dual polygon of a vertex with the sides 0, …, m-1, counter-clockwise,
/// Σ_{0<s<m/2} (1/2 - s/m) Σ_i a_i (b_{i+s} - b_{i-s}); on triangles the wedge of primal forms.
/// Laws     b ∧ a = -a ∧ b;  d(g ∧ b) = dg ∧ b + g ∧ db for a dual 0-form g
/// Invalid  on the dual cells of boundary vertices, which are open: the value there is 0
/// Cost     Σ m² over the vertices
/// Throws   InputError as above; TopologyError if K is not orientable, or if the triangles about a vertex are no ring
/// Source   Ptáčková & Velho, "A simple and complete discrete exterior calculus on general polygonal meshes", 2021, §3.1
[[nodiscard]] Form<2, 2, Side::dual> wedge(const Form<2, 1, Side::dual>& a, const Form<2, 1, Side::dual>& b);

/// The terms of a ∧ b of dual 1-forms a, for fixed b: one for every side of a dual polygon.
/// Throws   as that product
[[nodiscard]] WedgeTerms wedge_terms(const Form<2, 1, Side::dual>& b);

}  // namespace derham
