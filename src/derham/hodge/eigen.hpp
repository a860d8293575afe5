#pragma once

// The only header of this room that needs Eigen.
#include "derham/boundary/eigen.hpp"
#include "derham/hodge/hodge_star.hpp"

#include <Eigen/SparseCore>

namespace derham {

/// The diagonal of ⋆_k as an Eigen vector, to be used as `to_eigen(star, k).asDiagonal()`.
/// Throws   InputError unless 0 <= k <= n
template <int n>
[[nodiscard]] Eigen::VectorXd to_eigen(const HodgeStar<n>& star, int k) {
  const auto diagonal = star.diagonal(k);
  return Eigen::Map<const Eigen::VectorXd>(diagonal.data(), static_cast<Eigen::Index>(diagonal.size()));
}

/// The weak Laplacian of functions d_0ᵀ ⋆_1 d_0: symmetric, constants in its kernel; Δ_0 = ⋆_0^-1 times it.
/// Shape    |V| × |V|                               Units   length^(n-2)
/// Matrix   symmetric; positive semi-definite when no ⋆_1 is negative; a zero of ⋆_1 is stored as an entry 0
/// Source   Elcott & Schröder, "Building your own DEC at home", §7
template <int n>
  requires(n >= 1)
[[nodiscard]] Eigen::SparseMatrix<double, Eigen::RowMajor> weak_laplacian(const HodgeStar<n>& star) {
  const auto d0 = to_eigen(coboundary_matrix(star.complex(), 0));
  return d0.transpose() * to_eigen(star, 1).asDiagonal() * d0;
}

}  // namespace derham
