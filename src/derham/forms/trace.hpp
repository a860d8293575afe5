#pragma once

#include "derham/boundary/boundary_complex.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/forms/exterior_derivative.hpp"
#include "derham/forms/form.hpp"

#include <span>

namespace derham {

namespace detail {
/// Throws InputError unless B can be the boundary of K: the number of k-simplices tells.
template <int n>
void require_boundary_of(const SimplicialComplex<n>& K, const BoundaryComplex<n>& B, int k) {
  const auto& inclusion = B.inclusion[static_cast<std::size_t>(k)];
  if (!inclusion.empty() && inclusion.back() >= K.size(k))
    throw InputError(text("the boundary has the ", k, "-simplex ", inclusion.back(), " of a complex that has ",
                          K.size(k), " of them; it belongs to another one"));
}

template <int n, int k, Side side>
void require_on_boundary(const BoundaryComplex<n>& B, const Form<n - 1, k, side>& w) {
  if (&w.complex() != &B.complex) throw InputError("the form is not one on this boundary complex");
}
}  // namespace detail

/// tr w, the restriction of a k-form to the boundary: its values on the simplices there (Dirichlet data for k = 0, the
/// tangential part for k = 1, the flux outwards for k = n-1, which refers to facets oriented as ∂K is).
///
/// Maps     primal k-form on K -> primal k-form on ∂K, k < n
/// Matrix   one entry a row, 1, or for k = n-1 the sign of the facet in ∂K
/// Law      tr dw = d tr w; for n >= 2 the integral of dw is that of tr w over ∂K (Stokes)
/// Throws   InputError if B is not the boundary of the form's complex
/// Source   Arnold, Falk, Winther, "Finite element exterior calculus", 2006, §2.2
template <int n, int k>
  requires(k < n)
[[nodiscard]] PrimalForm<n - 1, k> trace(const BoundaryComplex<n>& B, const PrimalForm<n, k>& w) {
  detail::require_boundary_of(w.complex(), B, k);
  PrimalForm<n - 1, k> result(B.complex);
  for (Index i = 0; i < result.size(); ++i)
    result[i] = B.complex.sign(k, i) * w[B.inclusion[k][static_cast<std::size_t>(i)]];
  return result;
}

/// trᵀ b, the transpose of the trace: the boundary term of integration by parts, which data b on ∂K give to a right-hand side,
///
///     ⟨da, w⟩ = ⟨a, δw⟩ + ∫_∂K tr(a ∧ ⋆w),      the last = Σ (tr a)_s b_s.
///
/// b_s is the integral of tr ⋆w over the dual cell of s within ∂K: for functions a the flux of w outwards through it, for
/// 1-forms in space a current along ∂K, for (n-1)-forms the value at the facet.
/// Maps     dual j-form on ∂K -> dual (j+1)-form on K, counted by the same simplices: (n-1-j)-simplices of ∂K
/// Matrix   that of the trace of (n-1-j)-forms, transposed
/// Law      Σ (tr a)_s b_s over ∂K is Σ a_s boundary_term(b)_s over K
/// Throws   InputError if the form is not on B, or B not the boundary of K
/// Source   Desbrun, Kanso, Tong 2008, §6 (dual cells); the boundary and its sign are derived in docs/operators/form-spaces.md
template <int n, int j>
  requires(j < n)
[[nodiscard]] DualForm<n, j + 1> boundary_term(const SimplicialComplex<n>& K, const BoundaryComplex<n>& B,
                                               const DualForm<n - 1, j>& b) {
  constexpr int k = n - 1 - j;
  detail::require_boundary_of(K, B, k);
  detail::require_on_boundary<n>(B, b);
  DualForm<n, j + 1> result(K);
  for (Index i = 0; i < b.size(); ++i)
    result[B.inclusion[k][static_cast<std::size_t>(i)]] = B.complex.sign(k, i) * b[i];
  return result;
}
template <int n, int j>
void boundary_term(SimplicialComplex<n>&&, const BoundaryComplex<n>&, const DualForm<n - 1, j>&) = delete;

/// The exterior derivative of a dual j-form with its trace on ∂K: the dual cells are closed there. With k = n-1-j the
/// boundary of the dual cell of s is (-1)^(k+1) times the sum of the dual cells of its cofaces and, if s is on ∂K, (-1)^k
/// times its dual cell within ∂K, where (s, ⋆s) is positive for the orientation of ∂K.
///
/// Maps     dual j-form on K and on ∂K -> dual (j+1)-form on K
/// Law      d(d(w, B, b), B, d(b)) = 0; d(w, B, 0) = d(w)
/// Throws   TopologyError if K is not orientable; InputError as above
/// Source   as above
template <int n, int j>
  requires(j < n)
[[nodiscard]] DualForm<n, j + 1> d(const DualForm<n, j>& w, const BoundaryComplex<n>& B, const DualForm<n - 1, j>& b) {
  constexpr int k = n - 1 - j;
  const auto term = boundary_term(w.complex(), B, b);
  return k % 2 == 0 ? d(w) + term : d(w) - term;
}

}  // namespace derham
