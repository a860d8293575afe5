#include "derham/io/write_mesh.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/atomic_file.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/text_writer.hpp"
#include "derham/io/vtu_file.hpp"

namespace derham {
namespace {

void require_sound(const MeshData& mesh) {
  for (const Index v : mesh.simplices.vertices())
    if (v < 0 || v >= mesh.vertex_count)
      throw InputError(text("vertex id ", v, " in a mesh of ", mesh.vertex_count, " vertices; expected 0 to ",
                            mesh.vertex_count - 1));
  const auto expected = static_cast<Offset>(mesh.vertex_count) * mesh.ambient_dimension;
  if (mesh.has_points() && static_cast<Offset>(mesh.points.size()) != expected)
    throw InputError(text(mesh.points.size(), " coordinates for ", mesh.vertex_count, " vertices in dimension ",
                          mesh.ambient_dimension, "; expected ", expected));
}

void require_fit(const MeshData& mesh, MeshFormat format) {
  const auto refuse = [&](const auto&... reason) {
    throw InputError(
        text("format ", format_name(format), " ", reason..., "; .facets holds any complex without positions"));
  };
  const int n = mesh.simplices.dimension();
  const int m = mesh.ambient_dimension;
  if (mesh.has_corners()) refuse("has one position per vertex, a periodic mesh has not; .vtu holds it for pictures");
  if (!mesh.has_points() && mesh.vertex_count > 0) refuse("needs positions, this mesh has none");
  if (!mesh.simplices.is_uniform()) refuse("holds simplices of one dimension, this mesh has several");
  const int largest = format == MeshFormat::off || format == MeshFormat::obj ? 2 : 3;
  if (n > largest) refuse("holds simplices of dimension at most ", largest, ", this mesh has dimension ", n);
  if (m > 3) refuse("holds positions in at most 3 dimensions, this mesh has ", m);
  if (format == MeshFormat::tetgen && !mesh.simplices.empty() && (n < 2 || m < 2))
    refuse("holds triangles and tetrahedra in 2 or 3 dimensions, this mesh has dimension ", n, " in ", m);
}

}  // namespace

void write_mesh(const std::string& path, const MeshData& mesh, MeshFormat format) {
  require_sound(mesh);
  if (format == MeshFormat::vtu) return VtuFile(mesh).write(path);
  if (format != MeshFormat::facets) require_fit(mesh, format);

  const auto [node_path, ele_path] = tetgen_paths(path);
  const bool is_pair = format == MeshFormat::tetgen && path != "-";
  AtomicFile file(is_pair ? node_path : path);
  TextWriter writer(file);
  switch (format) {
    case MeshFormat::tetgen: {
      if (!is_pair) {
        write_tetgen(writer, writer, mesh);
        break;
      }
      AtomicFile ele_file(ele_path);
      TextWriter ele_writer(ele_file);
      write_tetgen(writer, ele_writer, mesh);
      writer.flush();
      ele_writer.flush();
      file.commit();
      ele_file.commit();
      return;
    }
    case MeshFormat::gmsh:
      write_gmsh(writer, mesh);
      break;
    case MeshFormat::off:
      write_off(writer, mesh);
      break;
    case MeshFormat::obj:
      write_obj(writer, mesh);
      break;
    case MeshFormat::facets:
      write_facets(writer, mesh);
      break;
    case MeshFormat::vtu:
      break;
  }
  writer.flush();
  file.commit();
}

void write_mesh(const std::string& path, const MeshData& mesh) {
  const auto format = format_by_extension(path);
  if (!format)
    throw InputError(text(
        "'", path, "' has no extension of a mesh format; expected .node, .ele, .msh, .off, .obj, .facets or .vtu"));
  write_mesh(path, mesh, *format);
}

}  // namespace derham
