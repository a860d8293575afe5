// Any bytes, in the format DERHAM_FUZZ_FORMAT or without it as the faces and edges beside a TetGen mesh, are a sound mesh or an error of ours; and a mesh that was read survives being freed of unused vertices.
#include "derham/core/error.hpp"
#include "derham/io/read_mesh.hpp"
#include "derham/io/unused_vertices.hpp"
#include "io/tetgen_faces.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace {

void demand(bool holds) {
  if (!holds) std::abort();
}

void demand_sound(const derham::MeshData& mesh) {
  const auto vertices = static_cast<std::size_t>(mesh.vertex_count);
  demand(mesh.points.empty() || mesh.points.size() == vertices * static_cast<std::size_t>(mesh.ambient_dimension));
  demand(mesh.vertex_tags.empty() || mesh.vertex_tags.size() == vertices);
  demand(mesh.row_tags.empty() || static_cast<derham::Offset>(mesh.row_tags.size()) == mesh.simplices.size());
  for (const derham::Index v : mesh.simplices.vertices()) demand(v >= 0 && v < mesh.vertex_count);
  for (const auto& list : mesh.lower)
    for (const derham::Index v : list.vertices()) demand(v >= 0 && v < mesh.vertex_count);
  for (const auto& part : mesh.parts) {
    demand(part.degree >= 0);
    const auto degree = static_cast<std::size_t>(part.degree);
    const derham::Offset bound = part.degree == mesh.simplices.dimension() ? mesh.simplices.size()
                                 : degree == 0                             ? derham::Offset{mesh.vertex_count}
                                 : degree < mesh.lower.size()              ? mesh.lower[degree].size()
                                                                           : 0;
    for (std::size_t i = 0; i < part.members.size(); ++i)
      demand(part.members[i] < bound && part.members[i] > (i == 0 ? -1 : part.members[i - 1]));
  }
  for (const auto& field : mesh.fields) {
    const auto items =
        field.on == derham::MeshField::On::vertices ? derham::Offset{mesh.vertex_count} : mesh.simplices.size();
    demand(static_cast<derham::Offset>(field.values.size()) == items * field.components);
  }
}

derham::MeshData read(std::string_view bytes, const derham::ReadOptions& options) {
#ifdef DERHAM_FUZZ_FORMAT
  (void)derham::detect_format("fuzz.node", bytes);
  return derham::read_mesh_from_memory(bytes, derham::MeshFormat::DERHAM_FUZZ_FORMAT, "fuzz", options);
#else
  return derham::io_test::read_tetgen_faces(bytes, options);
#endif
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    const bool is_odd = size % 2 == 1;  // either with everything that may be asked of a reader, or with nothing
    auto mesh = read(bytes, {.triangulate = is_odd, .corner_nodes = is_odd, .planar = is_odd});
    demand_sound(mesh);
    const bool has_unused = derham::first_unused_vertex(mesh) >= 0;
    demand((derham::drop_unused_vertices(mesh) > 0) == has_unused);
    demand(derham::first_unused_vertex(mesh) < 0);
    demand_sound(mesh);
  } catch (const derham::Error&) {
  }
  return 0;
}
