#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/error.hpp"
#include "derham/forms/form.hpp"

#include <span>
#include <vector>

namespace derham {

/// y = a ∧ b for a p-form a and a q-form b whose degrees are known at run time only: see `wedge`.
/// Shape    a (|K_p|,), b (|K_q|,), y (|K_{p+q}|,) not overlapping the others
/// Cost     one pass over the (p+q)-simplices and their face tables; on several threads, same bits always
/// Throws   InputError unless p, q >= 0 and p+q <= n, or on a wrong length
template <int n>
void apply_wedge(const SimplicialComplex<n>& K, int p, std::span<const double> a, int q, std::span<const double> b,
                 std::span<double> y);

/// a ∧ b of a fixed b, as a linear function of a: (a ∧ b)_i = Σ weight[j] a[index[j]] with j from offsets[i] up to, but
/// not, offsets[i + 1].
struct WedgeTerms {
  std::vector<Offset> offsets;
  std::vector<Index> index;
  std::vector<double> weight;
};

/// The terms of the product of p-forms with the q-form b: C(p+q+1, p+1) for every (p+q)-simplex.
/// Cost     that of a product, and the memory of the result
/// Throws   as apply_wedge
template <int n>
[[nodiscard]] WedgeTerms wedge_terms(const SimplicialComplex<n>& K, int p, int q, std::span<const double> b);

/// The wedge product of primal forms: the cup product, made antisymmetric.
///
/// (a ∧ b)[v_0 … v_{p+q}] = 1/(p+q+1)! Σ_π sgn π a[v_π(0) … v_π(p)] b[v_π(p) … v_π(p+q)], all permutations π
/// Maps     primal p-form, primal q-form -> primal (p+q)-form
/// Laws     d(a ∧ b) = da ∧ b + (-1)^p a ∧ db;  b ∧ a = (-1)^(pq) a ∧ b;  1 ∧ a = a;  pullbacks commute with it
/// Exact    on constant forms of a flat mesh; needs no metric, manifold or orientation
/// Invalid  as an associative product: (a ∧ b) ∧ c = a ∧ (b ∧ c) holds for closed forms only
/// Cost     as above
/// Throws   InputError if the forms belong to different complexes
/// Source   Whitney, "On products in a complex", 1938; Wilson, "Cochain algebra on manifolds and convergence under
///          refinement", 2007, §5. Hirani 2003, chapter 7, has other factors
template <int n, int p, int q>
  requires(p + q <= n)
[[nodiscard]] PrimalForm<n, p + q> wedge(const PrimalForm<n, p>& a, const PrimalForm<n, q>& b) {
  if (&a.complex() != &b.complex()) throw InputError("the forms belong to different complexes");
  PrimalForm<n, p + q> result(a.complex());
  apply_wedge(a.complex(), p, a.values(), q, b.values(), result.values());
  return result;
}

/// ∫ w over the fundamental class: the sum of the values on the positively oriented top simplices.
/// Law      integral(d(w)) = 0 on a closed oriented manifold, to round-off
/// Throws   TopologyError if K is not orientable: then there is no fundamental class
template <int n>
[[nodiscard]] double integral(const PrimalForm<n, n>& w) {
  if (!w.complex().is_orientable())
    throw TopologyError("the complex is not orientable and has no fundamental class to integrate over");
  double sum = 0;
  for (const double value : w.values()) sum += value;
  return sum;
}

}  // namespace derham
