#pragma once

#include "derham/operators/expression.hpp"

namespace derham {

// δ and Δ are composed of the typed ⋆ and d, so that no sign is written twice. The star must outlive the operators.

/// The codifferential δ = (-1)^(n(k-1)+1) ⋆ d ⋆ of k-forms of either side; on primal forms ⋆_{k-1}^-1 d_{k-1}ᵀ ⋆_k.
///
/// Maps     k-form -> (k-1)-form of the same side   Units   length^-2
/// Laws     δδ = 0; ⟨da, b⟩ = ⟨a, δb⟩ for primal forms, in ⟨a, b⟩ = pair(a, ⋆b): to round-off on every mesh
/// Boundary natural: dual cells are open there, the flux of b through ∂M counts as zero
/// Throws   when applied: GeometryError naming simplices whose dual volume is zero
/// Source   Hirani 2003, chapter 4; signs as in Abraham, Marsden, Ratiu, "Manifolds, tensor analysis and applications", §6.5
template <class F>
  requires(F::degree >= 1)
[[nodiscard]] auto codifferential(const HodgeStar<F::dimension>& star) {
  constexpr int n = F::dimension, k = F::degree;
  constexpr double sign = (n * (k - 1) + 1) % 2 == 0 ? 1 : -1;
  const Derivative<n> d(star.complex());
  return (sign * (star * d * star)).template at<F>();
}
template <class F>
auto codifferential(HodgeStar<F::dimension>&&) = delete;

/// Laplace–de Rham Δ = dδ + δd of k-forms of either side; for functions minus the Laplacian of analysis.
///
/// Maps     k-form -> k-form of the same side       Units   length^-2
/// Matrix   self-adjoint for ⋆ on every mesh; where all dual volumes are positive also positive semi-definite, with kernel
///          of dimension β_k on primal forms
/// Boundary natural, for b and for db
/// Throws   as δ: it needs ⋆_{k-1}^-1 and ⋆_k^-1; weak_laplace_de_rham needs the former only, mixed_laplace_de_rham none
/// Source   Elcott & Schröder, "Building your own DEC at home", §7
template <class F>
[[nodiscard]] Operator<F, F> laplace_de_rham(const HodgeStar<F::dimension>& star) {
  constexpr int n = F::dimension, k = F::degree;
  static_assert(n >= 1, "a complex of points has no derivative");
  const Derivative<n> d(star.complex());
  if constexpr (k == 0) {
    const auto derivative = d.template at<F>();
    return codifferential<typename decltype(derivative)::To>(star) * derivative;
  } else {
    const auto delta = codifferential<F>(star);
    Operator<F, F> down = d.template at<typename decltype(delta)::To>() * delta;
    if constexpr (k == n) {
      return down;
    } else {
      const auto derivative = d.template at<F>();
      return down + codifferential<typename decltype(derivative)::To>(star) * derivative;
    }
  }
}
template <class F>
Operator<F, F> laplace_de_rham(HodgeStar<F::dimension>&&) = delete;

/// δw.
/// Throws   InputError if the form and the star belong to different complexes; and as above
template <int n, int k, Side side>
  requires(k >= 1)
[[nodiscard]] Form<n, k - 1, side> codifferential(const HodgeStar<n>& star, const Form<n, k, side>& w) {
  return codifferential<Form<n, k, side>>(star)(w);
}

/// Δw.
/// Throws   as above
template <int n, int k, Side side>
[[nodiscard]] Form<n, k, side> laplace_de_rham(const HodgeStar<n>& star, const Form<n, k, side>& w) {
  return laplace_de_rham<Form<n, k, side>>(star)(w);
}

}  // namespace derham
