// derham in the tasks that the peers do. Names are "task: library".
#include "bench/support/construction.hpp"
#include "bench/support/kernel.hpp"
#include "bench/support/meshes.hpp"
#include "bench/support/program.hpp"
#include "bench/support/yardsticks.hpp"
#include "derham/boundary/matrix_free.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/hodge/eigen.hpp"
#include "derham/hodge/hodge_star.hpp"
#include "derham/hodge/up_laplacian.hpp"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace derham::bench {
namespace {

using Values = std::vector<double>;

std::shared_ptr<Values> values(Index size) { return std::make_shared<Values>(static_cast<std::size_t>(size), 1.0); }

Kernel derivative(const BenchMesh& mesh) {
  const auto& K = complex_of<3>(mesh);
  const auto x = values(K.size(1)), y = values(K.size(2));
  return {.run = [&K, x, y] { apply_coboundary<3>(K, 1, *x, *y); },
          .items = static_cast<double>(K.size(3)),
          .bytes = 0,
          .reset = {}};
}

/// d_1ᵀ ⋆ d_1 with a star of ones, as the peers have it.
Kernel curl_curl(const BenchMesh& mesh) {
  const auto& K = complex_of<3>(mesh);
  const auto weights = values(K.size(2)), x = values(K.size(1)), y = values(K.size(1));
  const auto L = std::make_shared<const UpLaplacian<3>>(K, 1, *weights);
  return {.run = [L, weights, x, y] { L->apply(*x, *y); },
          .items = static_cast<double>(K.size(3)),
          .bytes = 0,
          .reset = {}};
}

/// Everything that surfaces need, from the rows and points: the complex, its dual volumes, all Hodge stars.
Kernel surface_operators(const BenchMesh& mesh) {
  struct Operators {
    SimplicialComplex<2> K;
    HodgeStar<2> star;
    explicit Operators(const MeshData& data)
        : K(data.simplices, data.vertex_count), star(K, Geometry<2>::from_mesh(K, data)) {}
  };
  const auto built = std::make_shared<std::unique_ptr<Operators>>();
  return {.run = [built, &mesh] { *built = std::make_unique<Operators>(mesh.data); },
          .items = static_cast<double>(mesh.data.simplices.size()),
          .bytes = 0,
          .reset = [built] { built->reset(); },
          .memory = true};
}

/// The weak Laplacian of functions and the star of vertices, with all that they need, from the rows and points.
template <int n>
Kernel laplacian(const BenchMesh& mesh) {
  using Matrices = std::pair<Eigen::SparseMatrix<double, Eigen::RowMajor>, Eigen::VectorXd>;
  const auto built = std::make_shared<std::optional<Matrices>>();
  return {.run =
              [built, &mesh] {
                const SimplicialComplex<n> K(mesh.data.simplices, mesh.data.vertex_count);
                const HodgeStar<n> star(K, Geometry<n>::from_mesh(K, mesh.data));
                built->emplace(weak_laplacian(star), to_eigen(star, 0));
              },
          .items = static_cast<double>(mesh.data.simplices.size()),
          .bytes = 0,
          .reset = [built] { built->reset(); },
          .memory = true};
}

const Suite suite([](const Options& options) {
  add("construction: derham", solids(options), construction<3>);
  add("construction: derham", surfaces(options), construction<2>);
  add("d_1 x: derham", solids(options), derivative);
  add("curl-curl x: derham", solids(options), curl_curl);
  add("Laplacian and mass matrix: derham", solids(options), laplacian<3>);
  add("Laplacian and mass matrix: derham", surfaces(options), laplacian<2>);
  add("complex, d, all stars: derham", surfaces(options), surface_operators);
});

}  // namespace
}  // namespace derham::bench
