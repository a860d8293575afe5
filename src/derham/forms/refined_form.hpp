#pragma once

#include "derham/complex/refinement.hpp"
#include "derham/core/error.hpp"
#include "derham/forms/form.hpp"

#include <array>
#include <span>

namespace derham {

/// One row of the prolongation: which coarse k-simplices a fine one takes its value from, and their weights.
struct ProlongationRow {
  static constexpr std::size_t capacity = 10;  ///< C(5, 2): the most k-faces of a 4-simplex
  std::size_t size = 0;
  std::array<Index, capacity> simplex{};
  std::array<double, capacity> weight{};
};

/// Row i of the prolongation of k-forms: the integrals over fine k-simplex i of the Whitney forms of the k-faces of its
/// carrier, which are minors of barycentric coordinates, halves of integers; no metric enters.
/// Cost     a search in K for the carrier and for every face
/// Throws   InputError unless 0 <= k <= n
template <int n>
[[nodiscard]] ProlongationRow prolongation_row(const Refinement<n>& refinement, int k, Index i);

/// y = P x and y = R x: see `prolongation` and `restriction`.
/// Shape    P: x (|K_k|,), y (|fine K_k|,); R: x (|fine K_k|,), y (|K_k|,)
/// Cost     a few searches a value; on several threads, same bits always
/// Throws   InputError unless 0 <= k <= n, or on a wrong length
template <int n>
void apply_prolongation(const Refinement<n>& refinement, int k, std::span<const double> x, std::span<double> y);
template <int n>
void apply_restriction(const Refinement<n>& refinement, int k, std::span<const double> x, std::span<double> y);

/// P w: the integrals of the Whitney form of w over the fine simplices.
///
/// Maps     primal k-form on K -> primal k-form on the fine complex
/// Laws     d P = P d and ∫ P w = ∫ w, on integers without rounding;  R P = 1 without rounding
/// Exact    on constant forms of flat meshes
/// Throws   InputError if the form is not of the coarse complex
/// Source   Whitney, "Geometric integration theory", 1957, IV.27
template <int n, int k>
[[nodiscard]] PrimalForm<n, k> prolongation(const Refinement<n>& refinement, const PrimalForm<n, k>& w) {
  if (&w.complex() != &refinement.coarse()) throw InputError("the form does not belong to the coarse complex");
  PrimalForm<n, k> result(refinement.fine());
  apply_prolongation(refinement, k, w.values(), result.values());
  return result;
}

/// R w: the sum of the values on the pieces of every coarse simplex, the integral over it.
///
/// Maps     primal k-form on the fine complex -> primal k-form on K
/// Matrix   2^k entries 1 or -1 a row
/// Laws     d R = R d;  R P = 1;  ∫ R w = ∫ w
/// Throws   InputError if the form is not of the fine complex
template <int n, int k>
[[nodiscard]] PrimalForm<n, k> restriction(const Refinement<n>& refinement, const PrimalForm<n, k>& w) {
  if (&w.complex() != &refinement.fine()) throw InputError("the form does not belong to the fine complex");
  PrimalForm<n, k> result(refinement.coarse());
  apply_restriction(refinement, k, w.values(), result.values());
  return result;
}

}  // namespace derham
