#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/geometry/material.hpp"
#include "derham/hodge/hodge_star.hpp"

#include <Eigen/SparseCore>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace derham {

/// What is known of the sign of a quadratic form.
enum class Definiteness : std::uint8_t {
  positive,      ///< proved: xᵀMx > 0 for all x but 0
  not_positive,  ///< there is an x but 0 with xᵀMx <= 0
  unproved
};

/// What a Hodge star, or a mass matrix in its place, of degree k is good for on this mesh.
struct StarReport {
  int degree = 0;
  Definiteness definiteness = Definiteness::unproved;
  std::vector<Index> zero;      ///< k-simplices whose diagonal entry is zero
  std::vector<Index> negative;  ///< k-simplices whose diagonal entry is negative
  double smallest = 0;          ///< entry of the diagonal; units length^(n-2k)
  double largest = 0;

  /// Largest over smallest eigenvalue: exact for diagonals, from below for matrices (the diagonal, and 40 steps of Lanczos);
  /// infinite unless all eigenvalues that were met are positive.
  double condition = std::numeric_limits<double>::infinity();

  /// The largest error of the products of the constant forms dx^I, over |M|: 0 up to rounding says that the star is
  /// consistent on this mesh. NaN where space has other dimension than K, or none, and for tensors. At a boundary the
  /// circumcentric star of n >= 3 has an error here although it converges.
  double constant_error = std::numeric_limits<double>::quiet_NaN();

  /// What to use instead, and why; empty if there is nothing to say.
  std::string advice;
};

/// Judges the diagonal of degree k of a star of any kind and material that was made with the same geometry.
/// Cost     a few passes over the k-simplices
/// Throws   InputError unless 0 <= k <= n, the star has this degree, and the geometry belongs to its complex
template <int n>
[[nodiscard]] StarReport star_report(const HodgeStar<n>& star, const Geometry<n>& geometry, int k);

/// Judges the mass matrix that `whitney_mass` made with the same arguments. It is positive if the material is on every top
/// simplex, whatever rounding says.
/// Cost     40 products with the matrix
/// Source   Lanczos 1950; that Ritz values lie within the spectrum: Parlett, "The symmetric eigenvalue problem", 1980
/// Throws   InputError as above, or if the shapes do not fit
template <int n>
[[nodiscard]] StarReport star_report(const Eigen::SparseMatrix<double, Eigen::RowMajor>& mass,
                                     const SimplicialComplex<n>& K, const Geometry<n>& geometry, int k,
                                     const Material& material = {});

}  // namespace derham
