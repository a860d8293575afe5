#pragma once

#include "derham/boundary/scatter_pieces.hpp"
#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/types.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace derham {

/// ∂_k applied without a matrix on several threads, prepared once: each thread owns a range of (k-1)-simplices and adds up
/// what the k-simplices about them give, in the order of their indices. So it has the bits of `apply_boundary` for any
/// number of threads, and reads fewer bytes than the cofaces have. Which simplex is the first about a face is known, so that y
/// need not be set to zero before. K must outlive it.
/// Shape    |K_{k-1}| × |K_k|
template <int n>
  requires(n >= 1)
class BoundaryMap {
 public:
  /// Prepares for the present `thread_count()`: deals the faces to that many pieces. Keeps a byte per k-simplex and, for several
  /// threads, the indices of the simplices with faces in several pieces, hardly any when the numbering is local. If it is
  /// not at all, everything stays one piece.
  /// Cost     two passes over the face table of degree k
  /// Throws   InputError unless 1 <= k <= n
  BoundaryMap(const SimplicialComplex<n>& K, int k);
  BoundaryMap(SimplicialComplex<n>&&, int) = delete;

  [[nodiscard]] int degree() const noexcept { return degree_; }

  /// y = ∂_k x, of every column the same bits as alone. Several calls may run at the same time.
  /// Shape    x (|K_k|, columns), y (|K_{k-1}|, columns) row-major, not overlapping
  /// Cost     one pass over the face table, x and y; no allocation worth naming
  /// Throws   InputError on a wrong length, or unless columns >= 1
  void apply(std::span<const double> x, std::span<double> y, Index columns = 1) const;

 private:
  const SimplicialComplex<n>* complex_;
  int degree_;
  std::vector<detail::ScatterPiece> pieces_;
  std::vector<std::uint8_t> begun_;  // (|K_k|,) for k >= 2: which of its faces a simplex before it has, too, as bits
  std::vector<Index> bare_;          // for k >= 2: faces of no simplex
};

}  // namespace derham
