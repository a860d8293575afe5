#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/types.hpp"

#include <vector>

namespace derham {

/// A sparse matrix of signs in compressed rows (CSR). Read as compressed columns, the same arrays are the transpose.
struct SignMatrix {
  Index rows = 0, cols = 0;
  std::vector<Offset> offsets{0};  ///< (rows+1,)
  std::vector<Index> columns;      ///< (nonzeros,) increasing within a row
  std::vector<Sign> values;        ///< (nonzeros,) +1 or -1

  [[nodiscard]] Offset nonzeros() const noexcept { return static_cast<Offset>(columns.size()); }
  friend bool operator==(const SignMatrix&, const SignMatrix&) = default;
};

/// ∂_k in compressed rows: from each k-simplex to its faces, entry S(representative)(-1)^i for the face that omits
/// vertex i.
/// Shape    |K_{k-1}| × |K_k|, k+1 entries a column; 0 × |K_0| for k = 0
/// Law      ∂_{k-1} ∂_k = 0 exactly
/// Throws   InputError unless 0 <= k <= n
/// Source   Elcott & Schröder, "Building your own DEC at home", §4; S(representative) is -1 for some top simplices
template <int n>
[[nodiscard]] SignMatrix boundary_matrix(const SimplicialComplex<n>& K, int k);

/// d_k = transpose of ∂_{k+1} in compressed rows: the coboundary, or discrete exterior derivative.
/// Shape    |K_{k+1}| × |K_k|, k+2 entries a row; 0 × |K_n| for k = n
/// Throws   InputError unless 0 <= k <= n
/// Source   Elcott & Schröder, §6.1
template <int n>
[[nodiscard]] SignMatrix coboundary_matrix(const SimplicialComplex<n>& K, int k);

}  // namespace derham
