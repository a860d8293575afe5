#include "derham/operators/linear_map.hpp"

#include "derham/core/parallel.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace derham::detail {
namespace {

using Values = std::span<const double>;
using Result = std::span<double>;

constexpr Offset grain = 1 << 13;  // values or rows per block of a parallel loop

std::size_t size(Index count) { return static_cast<std::size_t>(count); }

class Leaf final : public LinearMap {
 public:
  Leaf(Index columns, Index rows, std::function<void(Values, Result)> apply, std::function<SparseMatrix()> assemble)
      : LinearMap(columns, rows), apply_(std::move(apply)), assemble_(std::move(assemble)) {}
  void apply(Values x, Result y) const override { apply_(x, y); }

 private:
  [[nodiscard]] SparseMatrix assemble() const override { return assemble_ ? assemble_() : fed_with_identity(*this); }
  std::function<void(Values, Result)> apply_;
  std::function<SparseMatrix()> assemble_;
};

class Identity final : public LinearMap {
 public:
  explicit Identity(Index size) : LinearMap(size, size) {}
  void apply(Values x, Result y) const override { std::ranges::copy(x, y.begin()); }

 private:
  [[nodiscard]] SparseMatrix assemble() const override {
    SparseMatrix result(rows(), columns());
    result.setIdentity();
    return result;
  }
};

class Product final : public LinearMap {
 public:
  Product(LinearMapPtr B, LinearMapPtr A) : LinearMap(A->columns(), B->rows()), B_(std::move(B)), A_(std::move(A)) {}
  void apply(Values x, Result y) const override {
    std::vector<double> between(size(A_->rows()));
    A_->apply(x, between);
    B_->apply(between, y);
  }

 private:
  [[nodiscard]] SparseMatrix assemble() const override { return B_->matrix() * A_->matrix(); }
  LinearMapPtr B_, A_;
};

class Sum final : public LinearMap {
 public:
  Sum(LinearMapPtr A, double factor, LinearMapPtr B)
      : LinearMap(A->columns(), A->rows()), A_(std::move(A)), B_(std::move(B)), factor_(factor) {}
  void apply(Values x, Result y) const override {
    A_->apply(x, y);
    std::vector<double> other(y.size());
    B_->apply(x, other);
    parallel_blocks(rows(), grain, [&](Offset first, Offset last) {
      for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
        y[i] += factor_ * other[i];
    });
  }

 private:
  [[nodiscard]] SparseMatrix assemble() const override { return A_->matrix() + factor_ * B_->matrix(); }
  LinearMapPtr A_, B_;
  double factor_;
};

class Multiple final : public LinearMap {
 public:
  Multiple(double factor, LinearMapPtr A) : LinearMap(A->columns(), A->rows()), A_(std::move(A)), factor_(factor) {}
  void apply(Values x, Result y) const override {
    A_->apply(x, y);
    parallel_blocks(rows(), grain, [&](Offset first, Offset last) {
      for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) y[i] *= factor_;
    });
  }

 private:
  [[nodiscard]] SparseMatrix assemble() const override { return factor_ * A_->matrix(); }
  LinearMapPtr A_;
  double factor_;
};

class ByMatrix final : public LinearMap {
 public:
  explicit ByMatrix(LinearMapPtr A) : LinearMap(A->columns(), A->rows()), A_(std::move(A)) {}
  void apply(Values x, Result y) const override { multiply(A_->matrix(), x, y); }

 private:
  [[nodiscard]] SparseMatrix assemble() const override { return A_->matrix(); }
  LinearMapPtr A_;
};

class Transposed final : public LinearMap {
 public:
  explicit Transposed(LinearMapPtr A) : LinearMap(A->rows(), A->columns()), A_(std::move(A)) {}
  void apply(Values x, Result y) const override { multiply(matrix(), x, y); }

 private:
  [[nodiscard]] SparseMatrix assemble() const override { return A_->matrix().transpose(); }
  LinearMapPtr A_;
};

}  // namespace

LinearMapPtr linear_map(Index columns, Index rows, std::function<void(Values, Result)> apply,
                        std::function<SparseMatrix()> assemble) {
  return std::make_shared<Leaf>(columns, rows, std::move(apply), std::move(assemble));
}
LinearMapPtr identity_map(Index size) { return std::make_shared<Identity>(size); }
LinearMapPtr product(LinearMapPtr B, LinearMapPtr A) { return std::make_shared<Product>(std::move(B), std::move(A)); }
LinearMapPtr sum(LinearMapPtr A, double factor, LinearMapPtr B) {
  return std::make_shared<Sum>(std::move(A), factor, std::move(B));
}
LinearMapPtr multiple(double factor, LinearMapPtr A) { return std::make_shared<Multiple>(factor, std::move(A)); }
LinearMapPtr by_matrix(LinearMapPtr A) { return std::make_shared<ByMatrix>(std::move(A)); }
LinearMapPtr transposed_map(LinearMapPtr A) { return std::make_shared<Transposed>(std::move(A)); }

void multiply(const SparseMatrix& A, Values x, Result y) {
  parallel_blocks(static_cast<Offset>(A.rows()), grain, [&](Offset first, Offset last) {
    for (Offset i = first; i < last; ++i) {
      double sum = 0;
      for (SparseMatrix::InnerIterator entry(A, i); entry; ++entry)
        sum += entry.value() * x[static_cast<std::size_t>(entry.col())];
      y[static_cast<std::size_t>(i)] = sum;
    }
  });
}

SparseMatrix diagonal_matrix(std::span<const double> diagonal) {
  if (diagonal.empty()) return SparseMatrix(0, 0);  // Eigen 3.4 reads the first column of none
  const Eigen::Map<const Eigen::VectorXd> entries(diagonal.data(), static_cast<Eigen::Index>(diagonal.size()));
  return SparseMatrix(entries.asDiagonal());
}

SparseMatrix fed_with_identity(const LinearMap& A) {
  using Column = Eigen::SparseMatrix<double, Eigen::ColMajor>;
  Column result(A.rows(), A.columns());
  std::vector<double> unit(size(A.columns())), image(size(A.rows()));
  for (Index j = 0; j < A.columns(); ++j) {
    unit[size(j)] = 1;
    A.apply(unit, image);
    unit[size(j)] = 0;
    result.startVec(j);
    for (Index i = 0; i < A.rows(); ++i)
      if (image[size(i)] != 0) result.insertBack(i, j) = image[size(i)];
  }
  result.finalize();
  return result;
}

}  // namespace derham::detail
