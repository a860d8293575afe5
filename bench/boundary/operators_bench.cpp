// d and ∂ applied without matrices, beside Eigen's product with the same matrices.
#include "bench/support/kernel.hpp"
#include "bench/support/meshes.hpp"
#include "bench/support/operators.hpp"
#include "bench/support/program.hpp"
#include "bench/support/yardsticks.hpp"
#include "derham/boundary/boundary_map.hpp"
#include "derham/boundary/eigen.hpp"
#include "derham/boundary/matrix_free.hpp"

#include <Eigen/SparseCore>

#include <memory>
#include <string>

namespace derham::bench {
namespace {

using Vector = std::vector<double>;

Offset bytes(std::span<const Index> table) { return static_cast<Offset>(table.size_bytes()); }

template <int k, int columns = 1>
Kernel derivative(const BenchMesh& mesh) {
  const auto& K = complex_of<3>(mesh);
  const auto apply = [&K](const Vector& x, Vector& y) { apply_coboundary(K, k, x, y, columns); };
  const Offset signs = k + 1 == 3 ? K.size(3) : 0;
  return application(mesh, K.size(k), K.size(k + 1), bytes(K.face_table(k + 1)) + signs, apply, columns);
}

template <int k>
Kernel scattered(const BenchMesh& mesh) {
  const auto& K = complex_of<3>(mesh);
  const auto apply = [&K](const Vector& x, Vector& y) { apply_boundary(K, k, x, y); };
  return application(mesh, K.size(k), K.size(k - 1), bytes(K.face_table(k)), apply);
}

template <int k, int columns = 1>
Kernel in_pieces(const BenchMesh& mesh) {
  const auto& K = complex_of<3>(mesh);
  const auto map = std::make_shared<const BoundaryMap<3>>(K, k);
  const auto apply = [map](const Vector& x, Vector& y) { map->apply(x, y, columns); };
  const Offset marks = k == 1 ? 0 : K.size(k), signs = k == 3 ? K.size(k) : 0;
  return application(mesh, K.size(k), K.size(k - 1), bytes(K.face_table(k)) + marks + signs, apply, columns);
}

template <int k, int columns = 1>
Kernel gathered(const BenchMesh& mesh) {
  const auto& K = complex_of<3>(mesh);
  const auto cofaces = std::make_shared<const Cofaces>(K, k - 1);
  const auto apply = [&K, cofaces](const Vector& x, Vector& y) { apply_boundary(K, *cofaces, x, y, columns); };
  return application(mesh, K.size(k), K.size(k - 1), bytes(cofaces->offsets()) + bytes(cofaces->packed()), apply,
                     columns);
}

template <int k>
Kernel eigen(const BenchMesh& mesh) {
  const auto& K = complex_of<3>(mesh);
  const auto A =
      std::make_shared<const Eigen::SparseMatrix<double, Eigen::RowMajor>>(to_eigen(coboundary_matrix(K, k)));
  const auto apply = [A](const Vector& x, Vector& y) {
    Eigen::Map<Eigen::VectorXd>(y.data(), A->rows()).noalias() =
        *A * Eigen::Map<const Eigen::VectorXd>(x.data(), A->cols());
  };
  return application(mesh, K.size(k), K.size(k + 1), 12 * A->nonZeros() + 4 * A->rows(), apply);
}

template <int k>
void add_degree(const std::vector<BenchMesh>& meshes) {
  const std::string derivative_name = "d_" + std::to_string(k), boundary_name = "∂_" + std::to_string(k + 1);
  add(derivative_name, meshes, derivative<k>);
  add(derivative_name + " of 4 vectors", meshes, derivative<k, 4>);
  add(derivative_name + " by Eigen", meshes, eigen<k>, Runs::one_thread);
  add(boundary_name, meshes, scattered<k + 1>, Runs::one_thread);
  add(boundary_name + " in pieces", meshes, in_pieces<k + 1>);
  add(boundary_name + " in pieces of 4 vectors", meshes, in_pieces<k + 1, 4>);
  add(boundary_name + " by cofaces", meshes, gathered<k + 1>);
  add(boundary_name + " by cofaces of 4 vectors", meshes, gathered<k + 1, 4>);
}

const Suite suite([](const Options& options) {
  add_copy();
  add_gather(solids(options));
  add_degree<0>(solids(options));
  add_degree<1>(solids(options));
  add_degree<2>(solids(options));
});

}  // namespace
}  // namespace derham::bench
