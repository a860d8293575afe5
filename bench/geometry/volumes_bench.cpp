// Volumes and verdicts of top simplices; what exact signs of volumes cost beside plain determinants.
#include "bench/support/kernel.hpp"
#include "bench/support/meshes.hpp"
#include "bench/support/program.hpp"
#include "derham/geometry/predicates.hpp"
#include "derham/geometry/quality.hpp"
#include "derham/geometry/volumes.hpp"

#include <memory>
#include <vector>

namespace derham::bench {
namespace {

template <int n, class Action>
Kernel kernel(const BenchMesh& mesh, Action action) {
  const auto& K = complex_of<n>(mesh);
  const auto geometry = std::make_shared<Geometry<n>>(Geometry<n>::from_mesh(K, mesh.data));
  return {.run = [&K, geometry, action] { action(K, *geometry); },
          .items = static_cast<double>(K.size(n)),
          .bytes = 0,
          .reset = {}};
}

template <int n>
Kernel volumes(const BenchMesh& mesh) {
  return kernel<n>(mesh, [](const auto& K, const auto& geometry) { (void)primal_volumes(K, geometry); });
}

template <int n>
Kernel verdicts(const BenchMesh& mesh) {
  return kernel<n>(mesh, [](const auto& K, const auto& geometry) { (void)quality(K, geometry); });
}

// Volumes with the signs of exact arithmetic.
Kernel exact(const BenchMesh& mesh) {
  return kernel<3>(mesh, [](const auto& K, const auto& geometry) { (void)signed_volumes(K, geometry); });
}

// The signs alone, by a filtered predicate for every tetrahedron.
Kernel predicates(const BenchMesh& mesh) {
  return kernel<3>(mesh, [](const auto& K, const auto& geometry) {
    std::vector<Sign> sign(static_cast<std::size_t>(K.size(3)));
    for (std::size_t t = 0; t < sign.size(); ++t)
      sign[t] = orientation_sign<3>(geometry.corners(K, static_cast<Index>(t)));
  });
}

// Volumes with the signs of rounded determinants.
Kernel rounded(const BenchMesh& mesh) {
  return kernel<3>(mesh, [](const auto& K, const auto& geometry) {
    std::vector<double> volume(static_cast<std::size_t>(K.size(3)));
    for (std::size_t t = 0; t < volume.size(); ++t) {
      const auto p = geometry.corners(K, static_cast<Index>(t));
      double e[3][3];
      for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 3; ++c) e[i][c] = p[static_cast<std::size_t>(i) + 1][c] - p[0][c];
      volume[t] =
          (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
          6;
    }
  });
}

const Suite suite([](const Options& options) {
  add("primal volumes", solids(options), volumes<3>);
  add("quality", solids(options), verdicts<3>);
  add("signed volumes, exact signs", solids(options), exact);
  add("signed volumes, plain determinants", solids(options), rounded, Runs::one_thread);
  add("orientation signs, one by one", solids(options), predicates, Runs::one_thread);
  add("primal volumes", surfaces(options), volumes<2>);
  add("quality", surfaces(options), verdicts<2>);
});

}  // namespace
}  // namespace derham::bench
