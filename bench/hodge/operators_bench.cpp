// ⋆ and the weak up-Laplacians applied without matrices, beside Eigen's product with the assembled matrices.
#include "bench/support/kernel.hpp"
#include "bench/support/meshes.hpp"
#include "bench/support/operators.hpp"
#include "bench/support/program.hpp"
#include "bench/support/yardsticks.hpp"
#include "derham/boundary/eigen.hpp"
#include "derham/hodge/hodge_star.hpp"
#include "derham/hodge/up_laplacian.hpp"

#include <Eigen/SparseCore>

#include <map>
#include <memory>
#include <optional>
#include <string>

namespace derham::bench {
namespace {

using Vector = std::vector<double>;

/// The star of one of the meshes, built at the first call.
const HodgeStar<3>& star_of(const BenchMesh& mesh) {
  static std::map<const BenchMesh*, HodgeStar<3>> built;
  const auto place = built.find(&mesh);
  if (place != built.end()) return place->second;
  const auto& K = complex_of<3>(mesh);
  return built.emplace(&mesh, HodgeStar<3>(K, Geometry<3>::from_mesh(K, mesh.data))).first->second;
}

template <int k>
Kernel star(const BenchMesh& mesh) {
  const auto& star = star_of(mesh);
  const Index size = star.complex().size(k);
  return application(mesh, size, size, 8 * Offset{size}, [&star](const Vector& x, Vector& y) { star.apply(k, x, y); });
}

template <int k>
Kernel star_inverse(const BenchMesh& mesh) {
  const auto& star = star_of(mesh);
  const Index size = star.complex().size(k);
  return application(mesh, size, size, 8 * Offset{size},
                     [&star](const Vector& x, Vector& y) { star.apply_inverse(k, x, y); });
}

/// Prepared for the number of threads that it is measured on.
template <int k, int columns = 1>
Kernel up_laplacian(const BenchMesh& mesh) {
  const auto& K = complex_of<3>(mesh);
  const auto L = std::make_shared<const UpLaplacian<3>>(star_of(mesh), k);
  const auto tables = static_cast<Offset>(K.face_table(k + 1).size_bytes()) + 8 * Offset{K.size(k + 1)};
  const auto apply = [L](const Vector& x, Vector& y) { L->apply(x, y, columns); };
  return application(mesh, K.size(k), K.size(k), tables, apply, columns);
}

template <int k>
Kernel preparation(const BenchMesh& mesh) {
  const auto& K = complex_of<3>(mesh);
  const auto L = std::make_shared<std::optional<UpLaplacian<3>>>();
  return {.run = [L, &star = star_of(mesh)] { L->emplace(star, k); },
          .items = static_cast<double>(mesh.data.simplices.size()),
          .bytes = static_cast<double>(K.face_table(k + 1).size_bytes()),
          .reset = [L] { L->reset(); },
          .memory = true};
}

template <int k>
Kernel eigen(const BenchMesh& mesh) {
  const auto& star = star_of(mesh);
  const Index size = star.complex().size(k);
  const auto d = to_eigen(coboundary_matrix(star.complex(), k));
  const auto weights = star.diagonal(k + 1);
  const Eigen::Map<const Eigen::VectorXd> diagonal(weights.data(), static_cast<Eigen::Index>(weights.size()));
  using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  const auto A = std::make_shared<const Matrix>(d.transpose() * diagonal.asDiagonal() * d);
  const auto apply = [A](const Vector& x, Vector& y) {
    Eigen::Map<Eigen::VectorXd>(y.data(), A->rows()).noalias() =
        *A * Eigen::Map<const Eigen::VectorXd>(x.data(), A->cols());
  };
  return application(mesh, size, size, 12 * A->nonZeros() + 4 * A->rows(), apply);
}

template <int k>
void add_laplacian(const std::string& name, const std::vector<BenchMesh>& meshes) {
  add(name, meshes, up_laplacian<k>);
  add(name + " of 4 vectors", meshes, up_laplacian<k, 4>);
  add(name + ", preparation", meshes, preparation<k>);
  add(name + " by Eigen", meshes, eigen<k>, Runs::one_thread);
}

const Suite suite([](const Options& options) {
  const auto& meshes = solids(options);
  add_copy();
  add("star_1", meshes, star<1>);
  add("star_1 inverse", meshes, star_inverse<1>);
  add("star_2", meshes, star<2>);
  add_laplacian<0>("weak Laplacian", meshes);
  add_laplacian<1>("curl-curl", meshes);
  add_laplacian<2>("grad-div", meshes);
});

}  // namespace
}  // namespace derham::bench
