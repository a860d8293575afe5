#pragma once

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/forms/trace.hpp"
#include "derham/hodge/hodge_star.hpp"
#include "derham/operators/boundary_metric.hpp"
#include "derham/operators/laplace_de_rham.hpp"

namespace derham {

// What natural data and Robin conditions add to a weak problem of k-forms. S is an inner product of k-forms on ∂K, a
// HodgeStar<n - 1> or a matrix as whitney_mass gives it, made with a boundary_material that is 0 off the part it is for.

/// The matrix of the trace of k-forms.
/// Shape    |B_k| × |K_k|
/// Throws   InputError unless 0 <= k < n, or if B is not the boundary of K
template <int n>
  requires(n >= 1)
[[nodiscard]] SparseMatrix trace_matrix(const SimplicialComplex<n>& K, const BoundaryComplex<n>& B, int k);

/// trᵀ S tr, what a Robin condition adds to the weak operator: S is weighed with the number h of the condition
/// tr ⋆du = ⋆h(g - tr u). On Γ elsewhere S is 0.
/// Shape    |K_k| × |K_k|
/// Matrix   symmetric; positive semi-definite if S is
/// Throws   as above, or if S has another shape
template <int n>
  requires(n >= 1)
[[nodiscard]] SparseMatrix robin_matrix(const SimplicialComplex<n>& K, const BoundaryComplex<n>& B, int k,
                                        const SparseMatrix& S);
template <int n>
  requires(n >= 1)
[[nodiscard]] SparseMatrix robin_matrix(const SimplicialComplex<n>& K, const BoundaryComplex<n>& B, int k,
                                        const HodgeStar<n - 1>& S) {
  return robin_matrix<n>(K, B, k, detail::diagonal_matrix(S.diagonal(k)));
}

/// trᵀ S g, what a density g on ∂K adds to the right-hand side: as natural data, tr ⋆du = ⋆g with g = i_ν du (the outward
/// derivative for functions, curl u × ν for 1-forms in space), or as the data of a Robin condition.
/// Maps     primal k-form on ∂K -> dual (n-k)-form on K, as star(f) is
/// Throws   InputError as above
template <int n, int k>
  requires(n >= 1)
[[nodiscard]] DualForm<n, n - k> boundary_load(const SimplicialComplex<n>& K, const BoundaryComplex<n>& B,
                                               const HodgeStar<n - 1>& S, const PrimalForm<n - 1, k>& g) {
  return boundary_term(K, B, S(g));
}
template <int n, int k>
  requires(n >= 1)
[[nodiscard]] DualForm<n, n - k> boundary_load(const SimplicialComplex<n>& K, const BoundaryComplex<n>& B,
                                               const SparseMatrix& S, const PrimalForm<n - 1, k>& g) {
  if (S.rows() != g.size() || S.cols() != g.size())
    throw InputError(text("an inner product of shape ", S.rows(), " x ", S.cols(), " for ", g.size(), " values"));
  DualForm<n - 1, n - 1 - k> weighed(B.complex);
  const Eigen::Map<const Eigen::VectorXd> x(g.values().data(), g.size());
  Eigen::Map<Eigen::VectorXd>(weighed.values().data(), g.size()) = S * x;
  return boundary_term(K, B, weighed);
}

/// δw with the trace of ⋆w on ∂K given, integrated over the dual cells there: dual cells are closed, ⋆⁻¹(dᵀ⋆w - trᵀ β).
///
/// Law      ⟨da, w⟩ = ⟨a, δw⟩ + Σ (tr a)_s β_s to round-off; δ of a constant form is 0 with its own trace
/// Throws   as codifferential(star, w) and boundary_term
template <int n, int k>
  requires(k >= 1)
[[nodiscard]] PrimalForm<n, k - 1> codifferential(const HodgeStar<n>& star, const PrimalForm<n, k>& w,
                                                  const BoundaryComplex<n>& B, const DualForm<n - 1, n - k>& trace) {
  constexpr double sign = (n * (k - 1) + 1) % 2 == 0 ? 1 : -1;
  return sign * star(d(star(w), B, trace));
}

}  // namespace derham
