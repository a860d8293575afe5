#pragma once

#include "derham/boundary/matrix_free.hpp"
#include "derham/complex/simplicial_map.hpp"
#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/forms/form.hpp"

#include <algorithm>
#include <span>

namespace derham {

/// y = φ* x for k-forms whose degree is known at run time only: see `pullback`.
/// Shape    x (|L_k|,), y (|K_k|,)
/// Cost     as there
/// Throws   InputError unless 0 <= k <= n and m, or on a wrong length
template <int n, int m>
void apply_pullback(const SimplicialMap<n, m>& phi, int k, std::span<const double> x, std::span<double> y) {
  detail::require_degree(n, k, 0, std::min(n, m));
  detail::require_shape("x", x.size(), phi.target().size(k), 1);
  detail::require_shape("y", y.size(), phi.source().size(k), 1);
  parallel_blocks(phi.source().size(k), 1 << 12, [&](Offset first, Offset last) {
    for (auto i = static_cast<Index>(first); i < last; ++i) {
      const SignedIndex image = phi.image(k, i);
      y[static_cast<std::size_t>(i)] = image ? image.sign * x[static_cast<std::size_t>(image.index)] : 0;
    }
  });
}

/// φ*w, the form on K whose value on a simplex is that of w on its image; 0 where the simplex is collapsed.
///
/// Maps     primal k-form on L -> primal k-form on K
/// Matrix   at most one entry +1 or -1 a row
/// Laws     d φ*w = φ* dw;  φ*(a ∧ b) = φ*a ∧ φ*b;  (ψφ)* = φ*ψ*;  ⟨φ*w, c⟩ = ⟨w, φ_* c⟩; all exact
/// Cost     a search in L for every k-simplex of K; on several threads, same bits always
/// Throws   InputError if the form is of another complex
/// Source   Munkres, "Elements of Algebraic Topology", 1984, §42
template <int n, int m, int k>
  requires(k <= n)
[[nodiscard]] PrimalForm<n, k> pullback(const SimplicialMap<n, m>& phi, const PrimalForm<m, k>& w) {
  if (&w.complex() != &phi.target()) throw InputError("the form and the map belong to different complexes");
  PrimalForm<n, k> result(phi.source());
  apply_pullback(phi, k, w.values(), result.values());
  return result;
}

}  // namespace derham
