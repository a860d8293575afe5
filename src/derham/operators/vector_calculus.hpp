#pragma once

#include "derham/operators/laplace_de_rham.hpp"

namespace derham {

// d and δ by their names in the plane and in space, on forms of either side. Without a star they are d and need no metric:
// grad takes values to circulations, curl circulations to fluxes (in the plane to densities), div fluxes to densities. With
// a star they are the same operators read the other way round: ⋆d⋆. n = 2 and 3.

/// The circulation of the gradient: d of functions.
template <int n, Side side>
  requires(n == 2 || n == 3)
[[nodiscard]] Form<n, 1, side> grad(const Form<n, 0, side>& u) {
  return d(u);
}

/// The flux of the curl of a circulation, in the plane its integral: d of 1-forms. Law: curl(grad(u)) = 0.
template <int n, Side side>
  requires(n == 2 || n == 3)
[[nodiscard]] Form<n, 2, side> curl(const Form<n, 1, side>& u) {
  return d(u);
}

/// The integral of the divergence of a flux: d of (n-1)-forms. In the plane a 1-form is read as a flux here, from the side
/// where (X, edge) is positive, as DeRhamMap::flux makes them, and not as a circulation. Law: div(curl(u)) = 0 in space.
template <int n, Side side>
  requires(n == 2 || n == 3)
[[nodiscard]] Form<n, n, side> div(const Form<n, n - 1, side>& flux) {
  return d(flux);
}

/// The divergence of a circulation, as a function: -δ.
/// Law      ⟨grad(u), v⟩ = -⟨u, div(star, v)⟩        Boundary no flux     Throws   as codifferential
template <int n, Side side>
  requires(n == 2 || n == 3)
[[nodiscard]] Form<n, 0, side> div(const HodgeStar<n>& star, const Form<n, 1, side>& u) {
  return -codifferential(star, u);
}

/// The curl of a flux, as a circulation: δ of 2-forms in space.
/// Law      ⟨curl(u), v⟩ = ⟨u, curl(star, v)⟩        Boundary v × normal = 0     Throws   as codifferential
template <Side side>
[[nodiscard]] Form<3, 1, side> curl(const HodgeStar<3>& star, const Form<3, 2, side>& flux) {
  return codifferential(star, flux);
}

/// The flux of the gradient of a density: -δ of n-forms.
/// Law      ⟨div(v), q⟩ = -⟨v, grad(star, q)⟩        Boundary q = 0       Throws   as codifferential
template <int n, Side side>
  requires(n == 2 || n == 3)
[[nodiscard]] Form<n, n - 1, side> grad(const HodgeStar<n>& star, const Form<n, n, side>& density) {
  return -codifferential(star, density);
}

}  // namespace derham
