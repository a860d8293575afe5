// What a renumbering costs, and what construction and d cost after it.
#include "bench/support/construction.hpp"
#include "bench/support/kernel.hpp"
#include "bench/support/meshes.hpp"
#include "bench/support/operators.hpp"
#include "bench/support/program.hpp"
#include "derham/boundary/matrix_free.hpp"
#include "derham/geometry/renumber_mesh.hpp"

#include <memory>
#include <vector>

namespace derham::bench {
namespace {

Renumbering cuthill_mckee(const MeshData& mesh) { return reverse_cuthill_mckee(mesh.simplices, mesh.vertex_count); }

/// The renumbering and the renumbered rows.
template <auto find>
Kernel renumbering(const BenchMesh& mesh) {
  const auto rows = std::make_shared<SimplexList>();
  return {.run = [rows, &mesh] { *rows = renumbered(mesh.data.simplices, find(mesh.data)); },
          .items = static_cast<double>(mesh.data.simplices.size()),
          .bytes = 0,
          .reset = [rows] { *rows = SimplexList(); },
          .memory = true};
}

template <auto find>
std::vector<BenchMesh> reordered(std::vector<BenchMesh> meshes) {
  for (BenchMesh& mesh : meshes) renumber(mesh.data, find(mesh.data));
  return meshes;
}

Kernel derivative(const BenchMesh& mesh) {
  const auto& K = complex_of<3>(mesh);
  const auto apply = [&K](const std::vector<double>& x, std::vector<double>& y) { apply_coboundary(K, 1, x, y); };
  return application(mesh, K.size(1), K.size(2), static_cast<Offset>(K.face_table(2).size_bytes()), apply);
}

const Suite suite([](const Options& options) {
  static const auto by_layers = reordered<cuthill_mckee>(solids(options));
  static const auto by_curve = reordered<hilbert_order>(solids(options));
  add("reverse Cuthill-McKee", solids(options), renumbering<cuthill_mckee>);
  add("Hilbert order", solids(options), renumbering<hilbert_order>);
  add("construction after Cuthill-McKee", by_layers, construction<3>);
  add("construction after Hilbert", by_curve, construction<3>);
  add("d_1", solids(options), derivative);
  add("d_1 after Cuthill-McKee", by_layers, derivative);
  add("d_1 after Hilbert", by_curve, derivative);
});

}  // namespace
}  // namespace derham::bench
