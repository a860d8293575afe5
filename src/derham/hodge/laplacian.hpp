#pragma once

#include "derham/core/error.hpp"
#include "derham/forms/exterior_derivative.hpp"
#include "derham/hodge/hodge_star.hpp"
#include "derham/hodge/up_laplacian.hpp"

namespace derham {

/// The Laplacian of functions, Δ_0 = δd = ⋆_0^-1 d_0ᵀ ⋆_1 d_0: positive semi-definite, minus the Laplacian of analysis.
///
/// (Δu)_i = 1/|⋆i| Σ_j (|⋆ij| / |ij|) (u_i - u_j); on surfaces the cotangent formula.
/// Maps     primal 0-form -> primal 0-form          Units   length^-2
/// Matrix   self-adjoint for ⋆_0; positive semi-definite when no ⋆_1 is negative and ⋆_0 > 0
/// Boundary natural: the flux through the boundary is zero
/// Throws   GeometryError naming vertices whose dual volume is zero
/// Source   Elcott & Schröder, "Building your own DEC at home", §7; signs from ⋆d⋆d with the dual derivative's own
template <int n>
  requires(n >= 1)
[[nodiscard]] PrimalForm<n, 0> laplacian(const HodgeStar<n>& star, const PrimalForm<n, 0>& u) {
  if (&u.complex() != &star.complex()) throw InputError("the form and the Hodge star belong to different complexes");
  PrimalForm<n, 0> result(star.complex());
  UpLaplacian<n>(star, 0).apply(u.values(), result.values());
  star.apply_inverse(0, result.values(), result.values());
  return result;
}

}  // namespace derham
