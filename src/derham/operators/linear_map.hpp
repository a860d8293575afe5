#pragma once

#include "derham/core/kept.hpp"
#include "derham/core/types.hpp"

#include <Eigen/SparseCore>

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace derham {

/// A sparse matrix by rows.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

namespace detail {

/// What an Operator does to values, whatever they belong to.
class LinearMap {
 public:
  LinearMap(Index columns, Index rows) : columns_(columns), rows_(rows) {}
  LinearMap(const LinearMap&) = delete;
  LinearMap& operator=(const LinearMap&) = delete;
  virtual ~LinearMap() = default;

  [[nodiscard]] Index columns() const noexcept { return columns_; }
  [[nodiscard]] Index rows() const noexcept { return rows_; }

  /// y = A x, y overwritten.
  virtual void apply(std::span<const double> x, std::span<double> y) const = 0;

  /// Assembled at the first call, and kept.
  [[nodiscard]] const SparseMatrix& matrix() const {
    return matrix_.get([this] { return assemble(); });
  }

 private:
  [[nodiscard]] virtual SparseMatrix assemble() const = 0;

  Index columns_, rows_;
  Kept<SparseMatrix> matrix_;
};

using LinearMapPtr = std::shared_ptr<const LinearMap>;

/// Without `assemble` its matrix is `fed_with_identity`.
[[nodiscard]] LinearMapPtr linear_map(Index columns, Index rows,
                                      std::function<void(std::span<const double>, std::span<double>)> apply,
                                      std::function<SparseMatrix()> assemble);
[[nodiscard]] LinearMapPtr identity_map(Index size);
/// B A.
[[nodiscard]] LinearMapPtr product(LinearMapPtr B, LinearMapPtr A);
/// A + factor B.
[[nodiscard]] LinearMapPtr sum(LinearMapPtr A, double factor, LinearMapPtr B);
[[nodiscard]] LinearMapPtr multiple(double factor, LinearMapPtr A);
/// A, applied by its matrix.
[[nodiscard]] LinearMapPtr by_matrix(LinearMapPtr A);
/// Aᵀ, applied by the transpose of the matrix of A.
[[nodiscard]] LinearMapPtr transposed_map(LinearMapPtr A);

/// y = A x, on several threads.
void multiply(const SparseMatrix& A, std::span<const double> x, std::span<double> y);

[[nodiscard]] SparseMatrix diagonal_matrix(std::span<const double> diagonal);

/// The matrix whose columns are A e_0, A e_1, …; entries that are zero are left out.
/// Cost     as many applications as columns
[[nodiscard]] SparseMatrix fed_with_identity(const LinearMap& A);

/// The matrix with rows row(i, add), which calls add(column, value) for every entry.
template <class Row>
[[nodiscard]] SparseMatrix matrix_of_rows(Index rows, Index columns, Row&& row) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Index i = 0; i < rows; ++i)
    row(i, [&](Index column, double value) {
      entries.emplace_back(static_cast<int>(i), static_cast<int>(column), value);
    });
  SparseMatrix result(rows, columns);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace detail
}  // namespace derham
