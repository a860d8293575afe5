// Volumes and dual volumes of every degree, the verdicts on them, and the stars.
#include "bench/support/kernel.hpp"
#include "bench/support/meshes.hpp"
#include "bench/support/program.hpp"
#include "derham/dual/circumcentric.hpp"
#include "derham/dual/dual_report.hpp"
#include "derham/geometry/quality.hpp"
#include "derham/hodge/hodge_star.hpp"

#include <memory>

namespace derham::bench {
namespace {

template <int n, class Action>
Kernel kernel(const BenchMesh& mesh, Action action) {
  const auto& K = complex_of<n>(mesh);
  const auto geometry = std::make_shared<Geometry<n>>(Geometry<n>::from_mesh(K, mesh.data));
  const auto items = static_cast<double>(K.size(n));
  return {.run = [&K, geometry, action] { action(K, *geometry); }, .items = items, .bytes = 0, .reset = {}};
}

template <int n>
Kernel dual(const BenchMesh& mesh) {
  return kernel<n>(mesh, [](const auto& K, const auto& geometry) { (void)circumcentric_dual(K, geometry); });
}

template <int n>
Kernel judged(const BenchMesh& mesh) {
  return kernel<n>(mesh, [](const auto& K, const auto& geometry) { (void)judged_dual(K, geometry); });
}

// Everything that `derham info` asks of a metric but the orientation.
template <int n>
Kernel all(const BenchMesh& mesh) {
  return kernel<n>(mesh, [](const auto& K, const auto& geometry) {
    (void)quality(K, geometry);
    (void)judged_dual(K, geometry);
  });
}

template <int n>
Kernel stars(const BenchMesh& mesh) {
  return kernel<n>(mesh, [](const auto& K, const auto& geometry) { const HodgeStar<n> star(K, geometry); });
}

// A surface from its triangles to the diagonals of all stars.
Kernel from_triangles(const BenchMesh& mesh) {
  return {.run =
              [&mesh] {
                const SimplicialComplex<2> K(mesh.data.simplices, mesh.data.vertex_count);
                const HodgeStar<2> star(K, Geometry<2>::from_mesh(K, mesh.data));
              },
          .items = static_cast<double>(mesh.data.simplices.size()),
          .bytes = 0,
          .reset = {}};
}

const Suite suite([](const Options& options) {
  add("dual volumes", solids(options), dual<3>);
  add("dual volumes and verdicts", solids(options), judged<3>);
  add("the same and verdicts on volumes", solids(options), all<3>);
  add("stars", solids(options), stars<3>);
  add("dual volumes", surfaces(options), dual<2>);
  add("stars", surfaces(options), stars<2>);
  add("complex and stars", surfaces(options), from_triangles);
});

}  // namespace
}  // namespace derham::bench
