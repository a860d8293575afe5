#pragma once

#include "derham/forms/pullback.hpp"
#include "derham/forms/refined_form.hpp"
#include "derham/operators/operator.hpp"

#include <vector>

namespace derham {

// Pullback, prolongation and restriction of k-forms as operators, for compositions and for their matrices. What they are
// made of must outlive them.

/// φ* of k-forms: see `pullback`.
template <int k, int n, int m>
  requires(k <= n && k <= m)
[[nodiscard]] Operator<PrimalForm<m, k>, PrimalForm<n, k>> pullback_operator(const SimplicialMap<n, m>& phi) {
  const auto* const map = &phi;
  const auto apply = [map](std::span<const double> x, std::span<double> y) { apply_pullback(*map, k, x, y); };
  const auto assemble = [map] {
    return detail::matrix_of_rows(map->source().size(k), map->target().size(k), [map](Index i, auto&& add) {
      if (const SignedIndex image = map->image(k, i)) add(image.index, image.sign);
    });
  };
  return {phi.target(), phi.source(), apply, assemble};
}
template <int k, int n, int m>
auto pullback_operator(SimplicialMap<n, m>&& phi) = delete;

/// P of k-forms: see `prolongation`.
template <int k, int n>
[[nodiscard]] Operator<PrimalForm<n, k>, PrimalForm<n, k>> prolongation_operator(const Refinement<n>& refinement) {
  const auto* const r = &refinement;
  const auto apply = [r](std::span<const double> x, std::span<double> y) { apply_prolongation(*r, k, x, y); };
  const auto assemble = [r] {
    return detail::matrix_of_rows(r->fine().size(k), r->coarse().size(k), [r](Index i, auto&& add) {
      const ProlongationRow row = prolongation_row(*r, k, i);
      for (std::size_t j = 0; j < row.size; ++j) add(row.simplex[j], row.weight[j]);
    });
  };
  return {refinement.coarse(), refinement.fine(), apply, assemble};
}
template <int k, int n>
auto prolongation_operator(Refinement<n>&& refinement) = delete;

/// R of k-forms: see `restriction`.
template <int k, int n>
[[nodiscard]] Operator<PrimalForm<n, k>, PrimalForm<n, k>> restriction_operator(const Refinement<n>& refinement) {
  const auto* const r = &refinement;
  const auto apply = [r](std::span<const double> x, std::span<double> y) { apply_restriction(*r, k, x, y); };
  const auto assemble = [r] {
    return detail::matrix_of_rows(r->coarse().size(k), r->fine().size(k), [r](Index i, auto&& add) {
      std::vector<Index> pieces;
      r->append_pieces(r->coarse().simplex(k, i), pieces);
      for (std::size_t p = 0; p < pieces.size(); p += k + 1) {
        const SignedIndex piece = r->fine().find(std::span<const Index>(pieces).subspan(p, k + 1));
        add(piece.index, piece.sign * r->coarse().sign(k, i));
      }
    });
  };
  return {refinement.fine(), refinement.coarse(), apply, assemble};
}
template <int k, int n>
auto restriction_operator(Refinement<n>&& refinement) = delete;

}  // namespace derham
