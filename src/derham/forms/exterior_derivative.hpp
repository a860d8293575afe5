#pragma once

#include "derham/boundary/chain.hpp"
#include "derham/boundary/matrix_free.hpp"
#include "derham/complex/cofaces.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/forms/form.hpp"

namespace derham {

namespace detail {
template <int n>
void require_dual_cells(const SimplicialComplex<n>& K) {
  if (!K.is_orientable())
    throw TopologyError("the complex is not orientable, so its dual cells have no coherent orientation");
}
}  // namespace detail

/// The exterior derivative of a primal k-form: (dw)(s) = w(∂s), so that Stokes' theorem holds exactly.
///
/// Maps     primal k-form -> primal (k+1)-form
/// Matrix   d_k, see coboundary_matrix
/// Law      d(d(w)) = 0
/// Source   Elcott & Schröder, "Building your own DEC at home", §6.1
template <int n, int k>
  requires(k < n)
[[nodiscard]] Form<n, k + 1, Side::primal> d(const Form<n, k, Side::primal>& w) {
  Form<n, k + 1, Side::primal> result(w.complex());
  apply_coboundary(w.complex(), k, w.values(), result.values());
  return result;
}

/// The exterior derivative of a dual j-form. With the dual cell of s oriented so that (s, ⋆s) is positive, the boundary
/// of the dual cell of a p-simplex is (-1)^(p+1) times the signed sum of the dual cells of its cofaces, hence d =
/// (-1)^(p+1) ∂_{p+1} with p = n-j-1.
///
/// Maps     dual j-form -> dual (j+1)-form
/// Matrix   (-1)^(n-j) ∂_{n-j}
/// Law      d(d(w)) = 0
/// Valid    not at the boundary unless the form vanishes there (homogeneous natural data): dual cells are open at ∂K,
///          and the part of their boundary inside ∂K is not represented; with its values: trace.hpp
/// Throws   TopologyError if K is not orientable
/// Source   Desbrun, Kanso, Tong, "Discrete differential forms for computational modeling", 2008, §6; sign derived
///          in docs/operators/conventions.md
template <int n, int j>
  requires(j < n)
[[nodiscard]] Form<n, j + 1, Side::dual> d(const Form<n, j, Side::dual>& w) {
  detail::require_dual_cells(w.complex());
  Form<n, j + 1, Side::dual> result(w.complex());
  detail::apply_boundary(w.complex(), n - j, (n - j) % 2 != 0, w.values(), result.values(), 1);
  return result;
}

/// The same bits, on several threads.
/// Throws   as above; InputError unless `cofaces` are those of the (n-j-1)-simplices
template <int n, int j>
  requires(j < n)
[[nodiscard]] Form<n, j + 1, Side::dual> d(const Form<n, j, Side::dual>& w, const Cofaces& cofaces) {
  detail::require_dual_cells(w.complex());
  if (cofaces.degree() != n - j - 1)
    throw InputError(
        text("cofaces of degree ", cofaces.degree(), "; d of a dual ", j, "-form needs degree ", n - j - 1));
  Form<n, j + 1, Side::dual> result(w.complex());
  detail::apply_boundary(w.complex(), cofaces, (n - j) % 2 != 0, w.values(), result.values(), 1);
  return result;
}

/// ⟨w, c⟩: the integral of a k-form over a k-chain.
/// Law      pair(d(w), c) = pair(w, boundary(c)) to round-off (Stokes)
/// Throws   InputError if they belong to different complexes
/// Source   Elcott & Schröder, §3.1
template <int n, int k>
[[nodiscard]] double pair(const Form<n, k, Side::primal>& w, const Chain<n, k>& c) {
  if (&w.complex() != &c.complex()) throw InputError("the form and the chain belong to different complexes");
  double sum = 0;
  for (const auto& [simplex, coefficient] : c.terms()) sum += static_cast<double>(coefficient) * w[simplex];
  return sum;
}

}  // namespace derham
