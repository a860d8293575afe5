// OpenMesh: the half-edges of a triangle mesh, without boundary tables or signs.
#include "bench/support/kernel.hpp"
#include "bench/support/meshes.hpp"
#include "bench/support/program.hpp"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <memory>
#include <optional>
#include <vector>

namespace derham::bench {
namespace {

using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<>;

void build(HalfEdges& mesh, const MeshData& data) {
  std::vector<HalfEdges::VertexHandle> vertices;
  for (std::size_t v = 0; v < static_cast<std::size_t>(data.vertex_count); ++v) {
    const double* const p = data.points.data() + 3 * v;
    vertices.push_back(mesh.add_vertex(
        HalfEdges::Point(static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]))));
  }
  for (Offset t = 0; t < data.simplices.size(); ++t) {
    const auto row = data.simplices[t];
    mesh.add_face(vertices[static_cast<std::size_t>(row[0])], vertices[static_cast<std::size_t>(row[1])],
                  vertices[static_cast<std::size_t>(row[2])]);
  }
}

Kernel construction(const BenchMesh& mesh) {
  const auto built = std::make_shared<std::optional<HalfEdges>>();
  return {.run = [built, &mesh] { build(built->emplace(), mesh.data); },
          .items = static_cast<double>(mesh.data.simplices.size()),
          .bytes = 0,
          .reset = [built] { built->reset(); },
          .memory = true};
}

const Suite suite([](const Options& options) {
  for (const auto& mesh : surfaces(options))
    if (mesh.data.ambient_dimension != 3) return;
  add("construction: OpenMesh (half-edges)", surfaces(options), construction, Runs::one_thread);
});

}  // namespace
}  // namespace derham::bench
