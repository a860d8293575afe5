#include "derham/io/read_mesh.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/cursor.hpp"
#include "derham/io/file_bytes.hpp"
#include "derham/io/formats.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

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

// A file of a TetGen mesh that need not exist.
class OptionalFile {
 public:
  explicit OptionalFile(const std::string& path) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) return;
    bytes_.emplace(path);
    cursor_.emplace(bytes_->view(), path, '#');
  }
  [[nodiscard]] Cursor* cursor() noexcept { return cursor_ ? &*cursor_ : nullptr; }

 private:
  std::optional<FileBytes> bytes_;
  std::optional<Cursor> cursor_;
};

// The line ends of old Macs would join lines and lengthen comments: in a format of lines that loses simplices in silence.
// `bytes` begins the file, so that the line is found.
void refuse_lone_returns(std::string_view bytes, const std::string& name) {
  for (auto at = bytes.find('\r'); at != std::string_view::npos; at = bytes.find('\r', at + 1)) {
    const auto next = bytes.find_first_not_of('\r', at);
    if (next == std::string_view::npos || bytes[next] == '\n') {
      at = std::min(next, bytes.size()) - 1;
      continue;
    }
    throw FileError(
        FileError::Action::read, name,
        1 + std::count(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(at), '\n'),
        "found a carriage return within a line, expected lines that end with a newline: convert the file, for "
        "example with tr '\\r' '\\n'");
  }
}

// A file may have fields of the same name, but none can be written so.
void note_repeated_fields(MeshData& mesh) {
  std::map<std::pair<MeshField::On, std::string_view>, std::size_t> counts;
  for (const auto& field : mesh.fields) ++counts[{field.on, field.name}];
  for (const auto& [field, count] : counts)
    if (count > 1)
      mesh.notes.push_back(text(count, " fields on ", field.first == MeshField::On::rows ? "rows" : "vertices",
                                " are called ", quoted_token(field.second), ": all are kept"));
}

// What is done for every format alike.
MeshData finished(MeshData mesh, const ReadOptions& options) {
  note_repeated_fields(mesh);
  if (options.planar && mesh.ambient_dimension == 3 && !flatten_plane(mesh))
    mesh.notes.emplace_back("no mesh in a plane z = 0: read as one in space");
  return mesh;
}

}  // namespace

bool flatten_plane(MeshData& mesh) {
  if (mesh.ambient_dimension != 3 || mesh.simplices.dimension() > 2) return false;
  const auto drop_third = [](std::vector<double>& positions) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < positions.size(); ++i)
      if (i % 3 != 2) positions[kept++] = positions[i];
    positions.resize(kept);
  };
  for (const auto* positions : {&mesh.points, &mesh.corners})
    for (std::size_t i = 2; i < positions->size(); i += 3)
      if ((*positions)[i] != 0) return false;
  drop_third(mesh.points);
  drop_third(mesh.corners);
  mesh.ambient_dimension = 2;
  mesh.notes.emplace_back("every third coordinate is 0: read as a mesh in the plane");
  return true;
}

MeshData read_mesh_from_memory(std::string_view bytes, MeshFormat format, const std::string& name,
                               const ReadOptions& options) {
  if (bytes.empty() && format != MeshFormat::facets)  // no facets make the empty complex
    throw FileError(FileError::Action::read, name, 0, "the file is empty");
  const auto& traits = format_traits(format);
  if (traits.comment != Cursor::no_comment) refuse_lone_returns(bytes, name);
  Cursor file(bytes, name, traits.comment);
  if (format == MeshFormat::tetgen) return finished(read_tetgen({file, file}, options), options);
  if (traits.read == nullptr)
    throw FileError(FileError::Action::read, name, 0,
                    text("derham writes ", format_name(format), " but does not read it"));
  return finished(traits.read(file, options), options);
}

MeshData read_mesh(const std::string& path, std::optional<MeshFormat> format, const ReadOptions& options) {
  const FileBytes bytes(path);
  const std::string name = path == "-" ? "stdin" : path;
  if (!format && bytes.view().empty() && format_by_extension(name) != MeshFormat::facets)
    throw FileError(FileError::Action::read, name, 0, "the file is empty");
  if (!format) format = detect_format(name, bytes.view());
  const auto paths = tetgen_paths(path);
  const bool is_pair = *format == MeshFormat::tetgen && (path == paths.node || path == paths.ele);
  if (!is_pair) return read_mesh_from_memory(bytes.view(), *format, name, options);

  const bool is_ele = path == paths.ele;
  const FileBytes other = companion(is_ele ? paths.node : paths.ele, path);
  Cursor nodes(is_ele ? other.view() : bytes.view(), paths.node, '#');
  Cursor simplices(is_ele ? bytes.view() : other.view(), paths.ele, '#');
  OptionalFile faces(paths.face), edges(paths.edge);
  return finished(read_tetgen({nodes, simplices, faces.cursor(), edges.cursor()}, options), options);
}

}  // namespace derham
