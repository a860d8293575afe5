// Assembly of the Whitney mass matrices of tetrahedral meshes, with the memory it takes.
#include "bench/support/kernel.hpp"
#include "bench/support/meshes.hpp"
#include "bench/support/program.hpp"
#include "derham/operators/whitney_mass.hpp"

#include <memory>
#include <string>

namespace derham::bench {
namespace {

template <int k>
Kernel whitney(const BenchMesh& mesh) {
  const auto& K = complex_of<3>(mesh);
  const auto geometry = std::make_shared<const Geometry<3>>(Geometry<3>::from_mesh(K, mesh.data));
  const auto M = std::make_shared<Eigen::SparseMatrix<double, Eigen::RowMajor>>();
  return {.run =
              [&K, geometry, M] {
                auto result = whitney_mass(K, *geometry, k);
                M->swap(result);
              },
          .items = static_cast<double>(mesh.data.simplices.size()),
          .reset = [M] { *M = Eigen::SparseMatrix<double, Eigen::RowMajor>(); },
          .memory = true};
}

const Suite suite([](const Options& options) {
  const auto& meshes = solids(options);
  add("Whitney mass, k = 0", meshes, whitney<0>);
  add("Whitney mass, k = 1", meshes, whitney<1>);
  add("Whitney mass, k = 2", meshes, whitney<2>);
  add("Whitney mass, k = 3", meshes, whitney<3>);
});

}  // namespace
}  // namespace derham::bench
