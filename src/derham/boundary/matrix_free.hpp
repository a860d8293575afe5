#pragma once

#include "derham/complex/cofaces.hpp"
#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/types.hpp"

#include <span>

namespace derham {

// The boundary and coboundary applied without a matrix, to one vector or to several at once. Several vectors are the
// columns of a row-major array of shape (|K_k|, columns): the values of one simplex lie side by side, so that an index
// is read once for all of them and every gather reads whole cache lines. Every column gets the bits that it would get
// alone.

/// y = d_k x: each (k+1)-simplex gathers from its faces. On several threads, same bits always.
/// Shape    x (|K_k|, columns), y (|K_{k+1}|, columns), not overlapping
/// Cost     one pass over the face table, x and y
/// Throws   InputError on a wrong degree or length, or unless columns >= 1
template <int n>
void apply_coboundary(const SimplicialComplex<n>& K, int k, std::span<const double> x, std::span<double> y,
                      Index columns = 1);

/// y = ∂_k x: each k-simplex adds to its faces, in index order. On one thread; for several see BoundaryMap.
/// Shape    x (|K_k|, columns), y (|K_{k-1}|, columns), not overlapping
/// Cost     one pass over the face table, x and y
/// Throws   as above
template <int n>
void apply_boundary(const SimplicialComplex<n>& K, int k, std::span<const double> x, std::span<double> y,
                    Index columns = 1);

/// y = ∂_k x with the same bits, on several threads: each (k-1)-simplex gathers from its cofaces, in index order.
/// Shape    cofaces of degree k-1, x (|K_k|, columns), y (|K_{k-1}|, columns), not overlapping
/// Cost     one pass over the cofaces, x and y
/// Throws   as above; InputError if `cofaces` cannot be those of K
template <int n>
void apply_boundary(const SimplicialComplex<n>& K, const Cofaces& cofaces, std::span<const double> x,
                    std::span<double> y, Index columns = 1);

namespace detail {
/// The same, of -∂_k when `minus`.
template <int n>
void apply_boundary(const SimplicialComplex<n>& K, int k, bool minus, std::span<const double> x, std::span<double> y,
                    Index columns);
template <int n>
void apply_boundary(const SimplicialComplex<n>& K, const Cofaces& cofaces, bool minus, std::span<const double> x,
                    std::span<double> y, Index columns);

/// Throws InputError unless low <= k <= high.
void require_degree(int n, int k, int low, int high);

/// Throws InputError unless columns >= 1 and `found` = simplices * columns.
void require_shape(const char* name, std::size_t found, Index simplices, Index columns);
}  // namespace detail

}  // namespace derham
