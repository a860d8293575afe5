#include "derham/operators/whitney_star.hpp"

#include "derham/core/text.hpp"

#include <Eigen/SparseCholesky>

#include <utility>

namespace derham {
namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

void require_shape(const char* name, std::size_t size, Eigen::Index rows, Index columns) {
  if (columns < 1) throw InputError(text(columns, " columns; there must be one at least"));
  const auto expected = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
  if (size != expected) throw InputError(text(name, " holds ", size, " numbers; expected ", expected));
}

}  // namespace

struct MassInverse::Factored {
  Matrix matrix;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor;
};

MassInverse::MassInverse(const Matrix& matrix) {
  if (matrix.rows() != matrix.cols())
    throw InputError(text("a mass of ", matrix.rows(), " × ", matrix.cols(), "; it must be square"));
  auto factored = std::make_shared<Factored>();
  factored->matrix = matrix;
  if (factored->matrix.rows() > 0) {
    factored->factor.compute(factored->matrix);
    if (factored->factor.info() != Eigen::Success)
      throw GeometryError(
          "the mass matrix is not positive definite, so it has no Cholesky factor; the material must be positive on "
          "every "
          "top simplex");
  }
  factored_ = std::move(factored);
}

const MassInverse::Matrix& MassInverse::matrix() const noexcept { return factored_->matrix; }

void MassInverse::apply(std::span<const double> x, std::span<double> y, Index columns) const {
  const Eigen::Index rows = matrix().rows();
  require_shape("x", x.size(), rows, columns);
  require_shape("y", y.size(), rows, columns);
  const Rows result = matrix() * Eigen::Map<const Rows>(x.data(), rows, columns);
  Eigen::Map<Rows>(y.data(), rows, columns) = result;
}

void MassInverse::apply_inverse(std::span<const double> x, std::span<double> y, Index columns) const {
  const Eigen::Index rows = matrix().rows();
  require_shape("x", x.size(), rows, columns);
  require_shape("y", y.size(), rows, columns);
  if (rows == 0) return;
  const Eigen::MatrixXd right = Eigen::Map<const Rows>(x.data(), rows, columns);
  Eigen::Map<Rows>(y.data(), rows, columns) = factored_->factor.solve(right);
}

}  // namespace derham
