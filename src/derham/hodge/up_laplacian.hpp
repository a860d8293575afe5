#pragma once

#include "derham/boundary/scatter_pieces.hpp"
#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/types.hpp"
#include "derham/hodge/hodge_star.hpp"

#include <span>
#include <vector>

namespace derham {

/// The weak up-Laplacian d_kᵀ W d_k with a diagonal W, usually ⋆_{k+1}, applied without a matrix: for k = 0 the weak
/// Laplacian of functions, for k = 1 in space curl–curl, for k = n-1 grad–div. K and W must outlive it.
///
/// One pass: each (k+1)-simplex gathers from its faces, weighs, and adds to the same faces. Every value is the sum of
/// its cofaces' shares in the order of their indices, so the bits do not depend on the number of threads.
/// Shape    |K_k| × |K_k|                           Units   length^(n-2k-2) for W = ⋆_{k+1}
/// Matrix   symmetric, d_{k-1} in its kernel; positive semi-definite when W >= 0
/// Source   Elcott & Schröder, "Building your own DEC at home", §7; the name: Lim, "Hodge Laplacians on graphs", 2020
template <int n>
  requires(n >= 1)
class UpLaplacian {
 public:
  /// Prepares for the present `thread_count()`: deals the faces to that many pieces. For one thread nothing is done and
  /// kept; for more, the indices of the simplices with faces in several pieces, hardly any when the numbering is local. If it is
  /// not at all, everything stays one piece.
  /// Cost     one pass over the face table of degree k+1
  /// Throws   InputError unless 0 <= k < n, or if `weights` does not hold one number per (k+1)-simplex
  UpLaplacian(const SimplicialComplex<n>& K, int k, std::span<const double> weights);

  /// d_kᵀ ⋆_{k+1} d_k.
  UpLaplacian(const HodgeStar<n>& star, int k)
    requires(n <= 4)
      : UpLaplacian(star.complex(), k, star.diagonal(k + 1)) {}

  UpLaplacian(SimplicialComplex<n>&&, int, std::span<const double>) = delete;
  UpLaplacian(const SimplicialComplex<n>&, int, std::vector<double>&&) = delete;  // weights must outlive it, too
  UpLaplacian(HodgeStar<n>&&, int) = delete;

  [[nodiscard]] int degree() const noexcept { return degree_; }

  /// y = d_kᵀ W d_k x, of every column the same bits as alone. Several calls may run at the same time.
  /// Shape    x, y (|K_k|, columns) row-major, not overlapping
  /// Cost     one pass over the face table, the weights, x and y; no allocation
  /// Throws   InputError on a wrong length, or unless columns >= 1
  void apply(std::span<const double> x, std::span<double> y, Index columns = 1) const;

 private:
  const SimplicialComplex<n>* complex_;
  int degree_ = 0;
  std::span<const double> weights_;
  std::vector<detail::ScatterPiece> pieces_;
};

}  // namespace derham
