#pragma once

#include "derham/complex/simplicial_map.hpp"
#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/forms/form.hpp"

namespace derham {

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
  parallel_blocks(result.size(), 1 << 12, [&](Offset first, Offset last) {
    for (auto i = static_cast<Index>(first); i < last; ++i)
      if (const SignedIndex image = phi.image(k, i)) result[i] = image.sign * w[image.index];
  });
  return result;
}

}  // namespace derham
