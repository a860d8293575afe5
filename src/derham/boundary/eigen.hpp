#pragma once

// The only header of this room that needs Eigen; include it where matrices are handed to Eigen.
#include "derham/boundary/matrix.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <Eigen/SparseCore>

#include <algorithm>
#include <limits>

namespace derham {

/// A copy of `matrix` as an Eigen sparse matrix (row-major, so that the arrays correspond one to one).
/// Shape    rows × cols as `matrix`
/// Throws   LimitError if the number of entries does not fit StorageIndex
template <class Scalar = double, class StorageIndex = int>
[[nodiscard]] Eigen::SparseMatrix<Scalar, Eigen::RowMajor, StorageIndex> to_eigen(const SignMatrix& matrix) {
  if (matrix.nonzeros() > std::numeric_limits<StorageIndex>::max())
    throw LimitError(text("a matrix of ", matrix.nonzeros(),
                          " entries does not fit Eigen's index type; ask for to_eigen<Scalar, std::int64_t>"));
  Eigen::SparseMatrix<Scalar, Eigen::RowMajor, StorageIndex> result(matrix.rows, matrix.cols);
  result.resizeNonZeros(matrix.nonzeros());
  std::copy(matrix.offsets.begin(), matrix.offsets.end(), result.outerIndexPtr());
  std::copy(matrix.columns.begin(), matrix.columns.end(), result.innerIndexPtr());
  std::copy(matrix.values.begin(), matrix.values.end(), result.valuePtr());
  return result;
}

}  // namespace derham
