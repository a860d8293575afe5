// The manifold certificate and the orientation of tetrahedra and triangles, beside the construction they are compared with.
#include "bench/support/construction.hpp"
#include "bench/support/kernel.hpp"
#include "bench/support/meshes.hpp"
#include "bench/support/program.hpp"
#include "derham/boundary/manifold.hpp"
#include "derham/complex/orientation.hpp"

#include <memory>

namespace derham::bench {
namespace {

/// check_manifold of a manifold.
template <int n>
Kernel certificate(const BenchMesh& mesh) {
  const auto report = std::make_shared<ManifoldReport>();
  return {.run = [report, &K = complex_of<n>(mesh)] { *report = check_manifold(K); },
          .items = static_cast<double>(mesh.data.simplices.size()),
          .bytes = 0,
          .reset = {},
          .memory = true};
}

/// The signs of the top simplices, found again from the signs of the rows.
template <int n>
Kernel orientation(const BenchMesh& mesh) {
  const auto& K = complex_of<n>(mesh);
  const auto found = std::make_shared<Orientation>();
  return {.run = [found, &K, preferred = K.orientation().sign] { *found = coherent_orientation(K, preferred); },
          .items = static_cast<double>(mesh.data.simplices.size()),
          .bytes = 0,
          .reset = [found] { *found = Orientation(); },
          .memory = true};
}

const Suite suite([](const Options& options) {
  add("construction", solids(options), construction<3>);
  add("orientation", solids(options), orientation<3>);
  add("certificate", solids(options), certificate<3>);
  add("orientation", surfaces(options), orientation<2>);
  add("certificate", surfaces(options), certificate<2>);
});

}  // namespace
}  // namespace derham::bench
