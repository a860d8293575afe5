#pragma once

#include "derham/geometry/material.hpp"
#include "derham/hodge/hodge_star.hpp"
#include "derham/operators/form_space.hpp"
#include "derham/operators/linear_map.hpp"
#include "derham/operators/whitney_mass.hpp"

#include <array>

namespace derham {

/// The weak Laplace–de Rham operator of primal k-forms, d_kᵀ ⋆_{k+1} d_k + ⋆_k d_{k-1} ⋆_{k-1}^-1 d_{k-1}ᵀ ⋆_k = ⋆_k Δ_k: an
/// eigenproblem or a system is solved with it against the mass ⋆_k, which is never inverted.
///
/// Shape    |K_k| × |K_k|                           Units   length^(n-2k-2)
/// Matrix   symmetric; positive semi-definite with kernel of dimension β_k where ⋆_{k-1}, ⋆_k, ⋆_{k+1} are positive
/// Cost     three sparse products
/// Throws   InputError unless 0 <= k <= n; GeometryError naming (k-1)-simplices whose dual volume is zero: use the mixed form
/// Source   Bell & Hirani, "PyDEC", 2012
template <int n>
  requires(n >= 1)
[[nodiscard]] SparseMatrix weak_laplace_de_rham(const HodgeStar<n>& star, int k);

/// The same for forms that vanish on the Γ of `space`, and with δu that vanishes there, too: the Laplacian of (K, Γ), for which
/// 0 is prescribed in u and in σ = δu. It is not EᵀAE of the operator above, in which δ has values on Γ (for k = 0 and for
/// dᵀ⋆d alone it is).
/// Shape    |free(k)| × |free(k)|
/// Matrix   as above; the kernel has the dimension of H^k(K, Γ)
/// Throws   as above, where only free (k-1)-simplices count; InputError if the space is of another complex
template <int n>
  requires(n >= 1)
[[nodiscard]] SparseMatrix weak_laplace_de_rham(const HodgeStar<n>& star, const FormSpace<n>& space, int k);

/// Laplace–de Rham of k-forms u with σ = δu as an unknown of its own, for inner products M that have no sparse inverse:
///
///     | -M_{k-1}       d_{k-1}ᵀ M_k         | |σ|   |    0   |
///     | M_k d_{k-1}    d_kᵀ M_{k+1} d_k     | |u| = | M_k f  |
///
/// For k = 0 there is no σ.
struct MixedLaplacian {
  Index sigma = 0;      ///< |K_{k-1}|, the number of unknowns σ, which come first; 0 for k = 0
  SparseMatrix matrix;  ///< symmetric and indefinite
  SparseMatrix mass;    ///< 0 for σ, M_k for u: eigenvalues λ of Δ_k are those of matrix x = λ mass x
};

/// With inner products that are given: M[0] of (k-1)-forms, M[1] of k-forms, M[2] of (k+1)-forms, diagonal or not; M[0] is
/// not looked at for k = 0, M[2] not for k = n.
/// Shape    |K_{k-1}| + |K_k| rows and columns
/// Matrix   for positive M: |K_{k-1}| eigenvalues are negative, β_k zero, the others positive
/// Throws   InputError unless 0 <= k <= n, or if an inner product has another shape
/// Source   Arnold, Falk, Winther, "Finite element exterior calculus", 2006, §7
template <int n>
  requires(n >= 1)
[[nodiscard]] MixedLaplacian mixed_laplace_de_rham(const SimplicialComplex<n>& K, int k,
                                                   const std::array<SparseMatrix, 3>& M);

/// With Whitney masses, all with the same material: valid on every mesh without flat simplices.
/// Throws   as above and as whitney_mass
template <int n>
  requires(n >= 1)
[[nodiscard]] MixedLaplacian mixed_laplace_de_rham(const SimplicialComplex<n>& K, const Geometry<n>& geometry, int k,
                                                   const Material& material = {});

/// With rows and columns of the free (k-1)- and k-simplices of `space` only: u and σ are 0 on its Γ.
/// Matrix   as above, with the dimension of H^k(K, Γ) in place of β_k
template <int n>
  requires(n >= 1)
[[nodiscard]] MixedLaplacian restricted(const MixedLaplacian& whole, const FormSpace<n>& space, int k);

}  // namespace derham
