// Eigen: the same operators as sparse matrices in compressed rows.
#include "bench/support/kernel.hpp"
#include "bench/support/meshes.hpp"
#include "bench/support/program.hpp"
#include "derham/boundary/eigen.hpp"

#include <Eigen/SparseCore>

#include <memory>

namespace derham::bench {
namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// y = A x. On one thread, whatever is asked: this product of Eigen uses OpenMP only.
Kernel product(const std::shared_ptr<const Matrix>& A, Index items) {
  const auto x = std::make_shared<Eigen::VectorXd>(Eigen::VectorXd::Ones(A->cols()));
  const auto y = std::make_shared<Eigen::VectorXd>(Eigen::VectorXd::Zero(A->rows()));
  return {.run = [=] { y->noalias() = *A * *x; }, .items = static_cast<double>(items), .bytes = 0, .reset = {}};
}

Kernel derivative(const BenchMesh& mesh) {
  const auto& K = complex_of<3>(mesh);
  return product(std::make_shared<Matrix>(to_eigen(coboundary_matrix(K, 1))), K.size(3));
}

/// d_1ᵀ ⋆ d_1 assembled, with a star of ones: the values do not change the time.
Kernel curl_curl(const BenchMesh& mesh) {
  const auto& K = complex_of<3>(mesh);
  const Matrix d = to_eigen(coboundary_matrix(K, 1));
  return product(std::make_shared<Matrix>(d.transpose() * d), K.size(3));
}

const Suite suite([](const Options& options) {
  add("d_1 x: Eigen", solids(options), derivative, Runs::one_thread);
  add("curl-curl x: Eigen, assembled", solids(options), curl_curl, Runs::one_thread);
});

}  // namespace
}  // namespace derham::bench
