#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/atomic_file.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/part_numbers.hpp"

#include <cerrno>
#include <cstddef>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <unistd.h>

namespace derham {
namespace {

// The fields of a kind side by side: the attributes of a node or of a simplex.
class Columns {
 public:
  Columns(const MeshData& mesh, MeshField::On on, Offset items) {
    for (const auto& field : mesh.fields) {
      if (field.on != on) continue;
      if (field.components < 1 || static_cast<Offset>(field.values.size()) != items * field.components)
        throw InputError(text("field '", field.name, "' has ", field.values.size(), " values; expected ", items,
                              " times ", field.components));
      fields_.push_back(&field);
      count_ += field.components;
    }
    if (count_ > 1000) throw InputError(text("format tetgen holds at most 1000 attributes, this mesh has ", count_));
  }
  [[nodiscard]] Offset count() const noexcept { return count_; }
  void put(TextWriter& file, std::size_t i) const {
    for (const auto* field : fields_) {
      const auto width = static_cast<std::size_t>(field->components);
      for (std::size_t c = 0; c < width; ++c) file.put(' ').put(field->values[i * width + c]);
    }
  }

 private:
  std::vector<const MeshField*> fields_;
  Offset count_ = 0;
};

void write_lower(TextWriter& file, const MeshData& mesh, int degree) {
  const auto& list = mesh.lower[static_cast<std::size_t>(degree)];
  const auto markers = part_numbers(mesh, degree, list.size());
  file.put(list.size()).put(markers.empty() ? " 0\n" : " 1\n");
  for (Offset i = 0; i < list.size(); ++i) {
    file.put(i);
    for (const Index v : list[i]) file.put(' ').put(v);
    if (!markers.empty()) file.put(' ').put(markers[static_cast<std::size_t>(i)]);
    file.put('\n');
  }
}

bool has_lower(const MeshData& mesh, int degree) noexcept {
  const auto d = static_cast<std::size_t>(degree);
  return degree < mesh.simplices.dimension() && d < mesh.lower.size() && !mesh.lower[d].empty();
}

// Faces and edges of an older mesh would be read with the new one.
void remove_stale(const std::string& path) {
  if (::unlink(path.c_str()) != 0 && errno != ENOENT)
    throw FileError(FileError::Action::write, path, 0,
                    text("cannot remove this file of an older mesh: ", std::generic_category().message(errno)));
}

struct Output {
  explicit Output(const std::string& path) : file(path), writer(file) {}
  AtomicFile file;
  TextWriter writer;
};

}  // namespace

void write_tetgen(const TetgenWriters& files, const MeshData& mesh) {
  const auto m = static_cast<std::size_t>(mesh.ambient_dimension);
  const auto markers = part_numbers(mesh, 0, mesh.vertex_count);
  const Columns attributes(mesh, MeshField::On::vertices, mesh.vertex_count);
  auto& nodes = files.nodes;
  nodes.put(mesh.vertex_count).put(' ').put(m).put(' ').put(attributes.count()).put(markers.empty() ? " 0\n" : " 1\n");
  for (std::size_t i = 0; i < static_cast<std::size_t>(mesh.vertex_count); ++i) {
    nodes.put(i);
    for (std::size_t axis = 0; axis < m; ++axis) nodes.put(' ').put(mesh.points[i * m + axis]);
    attributes.put(nodes, i);
    if (!markers.empty()) nodes.put(' ').put(markers[i]);
    nodes.put('\n');
  }

  const Columns row_attributes(mesh, MeshField::On::rows, mesh.simplices.size());
  std::vector<std::int64_t> regions;
  if (row_attributes.count() == 0 && !mesh.simplices.empty())
    regions = part_numbers(mesh, mesh.simplices.dimension(), mesh.simplices.size());
  auto& simplices = files.simplices;
  simplices.put(mesh.simplices.size())
      .put(' ')
      .put((mesh.simplices.empty() ? static_cast<int>(m) : mesh.simplices.dimension()) + 1);
  simplices.put(' ').put(regions.empty() ? row_attributes.count() : 1).put('\n');
  for (Offset i = 0; i < mesh.simplices.size(); ++i) {
    simplices.put(i);
    for (const Index v : mesh.simplices[i]) simplices.put(' ').put(v);
    row_attributes.put(simplices, static_cast<std::size_t>(i));
    if (!regions.empty()) simplices.put(' ').put(regions[static_cast<std::size_t>(i)]);
    simplices.put('\n');
  }
  if (files.edges != nullptr) write_lower(*files.edges, mesh, 1);
  if (files.faces != nullptr) write_lower(*files.faces, mesh, 2);
}

std::vector<std::string> lost_in_tetgen(const MeshData& mesh) {
  std::vector<std::string> lost;
  Offset named = 0, on_rows = 0, on_vertices = 0, row_parts = 0;
  for (const auto& field : mesh.fields) {
    auto& count = field.on == MeshField::On::rows ? on_rows : on_vertices;
    ++count;
    named += field.components != 1 || field.name != text("attribute ", count);
  }
  for (const auto& part : mesh.parts) row_parts += part.degree == mesh.simplices.dimension();
  if (named > 0) lost.push_back(text("names and components of fields (", named, "), only columns of attributes"));
  if (on_rows > 0 && row_parts > 0) lost.push_back(text("parts of the rows (", row_parts, ") beside fields on rows"));
  return lost;
}

void write_tetgen_files(const TetgenPaths& paths, const MeshData& mesh) {
  Output nodes(paths.node), simplices(paths.ele);
  std::optional<Output> faces, edges;
  if (has_lower(mesh, 2)) faces.emplace(paths.face);
  if (has_lower(mesh, 1)) edges.emplace(paths.edge);
  write_tetgen({nodes.writer, simplices.writer, faces ? &faces->writer : nullptr, edges ? &edges->writer : nullptr},
               mesh);
  nodes.writer.flush();
  simplices.writer.flush();
  if (faces) faces->writer.flush();
  if (edges) edges->writer.flush();
  nodes.file.commit();
  simplices.file.commit();
  faces ? faces->file.commit() : remove_stale(paths.face);
  edges ? edges->file.commit() : remove_stale(paths.edge);
}

}  // namespace derham
