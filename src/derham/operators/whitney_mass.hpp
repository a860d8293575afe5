#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/geometry/material.hpp"

#include <Eigen/SparseCore>

#include <vector>

namespace derham {

/// The Whitney (Galerkin) mass matrix of k-forms, M_στ = ∫ ⟨W_σ, A W_τ⟩ with the Whitney forms W_σ of WhitneyMap and the
/// material A: the Hodge star that needs no dual mesh and is positive on every mesh. n = 0 to 4, every k.
///
/// A tensor weighs k-forms with 0 < k < n as it acts on each of their factors: for k <= n/2 on covectors, so that
/// ⟨a_1 ∧ … ∧ a_k, A b_1 ∧ … ∧ b_k⟩ = det(a_i · A b_j), the metric of forms that A is as a metric of covectors; for k > n/2
/// so on the n-k factors of ⋆ of the form. That is αᵀAα for k = 1, n >= 2, and XᵀAX for the flux vector X = ⋆α for
/// 2 <= k = n-1. Functions and densities take numbers only.
/// Shape    |K_k| × |K_k|, an entry for every pair of k-simplices of one top simplex   Units   length^(n-2k) times A's
/// Matrix   symmetric bit for bit; positive definite if A is; diagonal for k = n: A/|T|
/// Law      cᵀ M c = ∫ ⟨c, A c⟩ for constant forms c, with or without boundary
/// Cost     linear; rows on all threads, each the sum over its top simplices in their order: the same bits for any number
///          of them; memory beside the result: products of constant forms and two tables, less than the result
/// Throws   InputError unless 0 <= k <= n, if the geometry or the material does not fit, or for a tensor in a degree
///          that takes none; GeometryError naming flat top simplices, one out of the range of doubles, or for
///          1 < k < n-1 one whose tensor is not positive; LimitError
///          if there are more entries than Eigen's index type counts
/// Source   Bell & Hirani, "PyDEC", 2012, §10; Dodziuk 1976 (the inner product)
template <int n>
[[nodiscard]] Eigen::SparseMatrix<double, Eigen::RowMajor> whitney_mass(const SimplicialComplex<n>& K,
                                                                        const Geometry<n>& geometry, int k,
                                                                        const Material& material = {});

/// The diagonal mass of functions, a (n+1)-th of every top simplex for each of its vertices (the row sums of the Whitney mass), or
/// of n-forms, 1/|T|; both times the material, a number. No other degree has one that converges.
/// Shape    (|K_k|,)
/// Throws   InputError unless k is 0 or n, and as above
template <int n>
[[nodiscard]] std::vector<double> lumped_mass(const SimplicialComplex<n>& K, const Geometry<n>& geometry, int k,
                                              const Material& material = {});

}  // namespace derham
