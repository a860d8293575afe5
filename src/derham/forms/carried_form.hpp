#pragma once

#include "derham/complex/renumbering.hpp"
#include "derham/forms/form.hpp"

namespace derham {

/// The same form on L, the complex of the renumbered rows of form.complex(). d commutes with it, and the Hodge star does.
/// For dual forms, and for the star, L must be oriented as the other complex: `orient_as`, or both by volume.
/// Cost     a search for every simplex; who carries many forms keeps the `simplex_map`
/// Throws   InputError if L is not that complex
template <int n, int k, Side side>
[[nodiscard]] Form<n, k, side> carried(const Form<n, k, side>& form, const SimplicialComplex<n>& L,
                                       const Renumbering& renumbering) {
  const auto map = simplex_map(form.complex(), L, renumbering, Form<n, k, side>::simplex_degree);
  return Form<n, k, side>(L, carried(form.values(), map));
}

/// The way back: a form on the renumbered complex as one on K.
template <int n, int k, Side side>
[[nodiscard]] Form<n, k, side> carried_back(const Form<n, k, side>& form, const SimplicialComplex<n>& K,
                                            const Renumbering& renumbering) {
  const auto map = simplex_map(K, form.complex(), renumbering, Form<n, k, side>::simplex_degree);
  return Form<n, k, side>(K, carried_back(form.values(), map));
}

}  // namespace derham
