#include "derham/io/read_mesh.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/cursor.hpp"
#include "derham/io/file_bytes.hpp"
#include "derham/io/formats.hpp"

namespace derham {
namespace {

// The bytes of the second file of a TetGen pair, which must exist beside the first.
FileBytes companion(const std::string& path, const std::string& of) {
  try {
    return FileBytes(path);
  } catch (const FileError&) {
    throw FileError(FileError::Action::read, path, 0,
                    text("cannot read the file that belongs to ", of, "; a TetGen mesh is a pair of .node and .ele"));
  }
}

}  // namespace

MeshData read_mesh_from_memory(std::string_view bytes, MeshFormat format, const std::string& name) {
  if (bytes.empty() && format != MeshFormat::facets)  // no facets make the empty complex
    throw FileError(FileError::Action::read, name, 0, "the file is empty");
  Cursor file(bytes, name, format == MeshFormat::gmsh ? Cursor::no_comment : '#');
  switch (format) {
    case MeshFormat::tetgen:
      return read_tetgen(file, file);
    case MeshFormat::gmsh:
      return read_gmsh(file);
    case MeshFormat::off:
      return read_off(file);
    case MeshFormat::obj:
      return read_obj(file);
    case MeshFormat::facets:
      return read_facets(file);
    case MeshFormat::vtu:
      break;
  }
  throw FileError(FileError::Action::read, name, 0,
                  text("derham writes ", format_name(format), " but does not read it"));
}

MeshData read_mesh(const std::string& path, std::optional<MeshFormat> format) {
  const FileBytes bytes(path);
  const std::string name = path == "-" ? "stdin" : path;
  if (!format && bytes.view().empty() && format_by_extension(name) != MeshFormat::facets)
    throw FileError(FileError::Action::read, name, 0, "the file is empty");
  if (!format) format = detect_format(name, bytes.view());
  const auto [node_path, ele_path] = tetgen_paths(path);
  const bool is_pair = *format == MeshFormat::tetgen && (path == node_path || path == ele_path);
  if (!is_pair) return read_mesh_from_memory(bytes.view(), *format, name);

  const bool is_ele = path == ele_path;
  const FileBytes other = companion(is_ele ? node_path : ele_path, path);
  Cursor nodes(is_ele ? other.view() : bytes.view(), node_path, '#');
  Cursor simplices(is_ele ? bytes.view() : other.view(), ele_path, '#');
  return read_tetgen(nodes, simplices);
}

}  // namespace derham
