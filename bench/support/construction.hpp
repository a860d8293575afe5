#pragma once

#include "bench/support/kernel.hpp"
#include "bench/support/meshes.hpp"
#include "derham/complex/simplicial_complex.hpp"

#include <memory>
#include <optional>

namespace derham::bench {

/// The whole oriented complex from the rows: what other kernels are compared with.
template <int n>
Kernel construction(const BenchMesh& mesh) {
  const auto K = std::make_shared<std::optional<SimplicialComplex<n>>>();
  return {.run = [K, &mesh] { K->emplace(mesh.data.simplices, mesh.data.vertex_count); },
          .items = static_cast<double>(mesh.data.simplices.size()),
          .bytes = 0,
          .reset = [K] { K->reset(); },
          .memory = true};
}

}  // namespace derham::bench
