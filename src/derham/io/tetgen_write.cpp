#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/atomic_file.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/part_numbers.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <sys/stat.h>
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

bool reads_as_region(double value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return tetgen_region({digits.data(), end}).has_value();
}

[[noreturn]] void fail_stale(const std::string& path, int code) {
  throw FileError(FileError::Action::write, path, 0,
                  text("cannot remove this file of an older mesh: ", std::generic_category().message(code)));
}

// Faces and edges of an older mesh would be read with the new one.
void remove_stale(const std::string& path) {
  if (::unlink(path.c_str()) != 0 && errno != ENOENT) fail_stale(path, errno);
}

// Refuses, before anything is changed, what `remove_stale` could not remove.
void require_removable(const std::string& path) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0) return;
  if (S_ISDIR(status.st_mode)) fail_stale(path, EISDIR);
  const auto slash = path.find_last_of('/');
  const auto directory = slash == std::string::npos ? std::string(".") : path.substr(0, slash + 1);
  if (::access(directory.c_str(), W_OK | X_OK) != 0) fail_stale(path, errno);
}

struct Output {
  explicit Output(const std::string& path) : file(path), writer(file) {}
  void finish() {
    writer.flush();
    file.finish();
  }
  AtomicFile file;
  TextWriter writer;
};

}  // namespace

void write_tetgen(const TetgenWriters& files, const MeshData& mesh) {
  const auto m = static_cast<std::size_t>(mesh.ambient_dimension);
  const auto width = std::max<std::size_t>(m, 2);
  const auto markers = part_numbers(mesh, 0, mesh.vertex_count);
  const Columns attributes(mesh, MeshField::On::vertices, mesh.vertex_count);
  auto& nodes = files.nodes;
  nodes.put(mesh.vertex_count)
      .put(' ')
      .put(width)
      .put(' ')
      .put(attributes.count())
      .put(markers.empty() ? " 0\n" : " 1\n");
  for (std::size_t i = 0; i < static_cast<std::size_t>(mesh.vertex_count); ++i) {
    nodes.put(i);
    for (std::size_t axis = 0; axis < width; ++axis) nodes.put(' ').put(axis < m ? mesh.points[i * m + axis] : 0.0);
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
      .put((mesh.simplices.empty() ? static_cast<int>(width) : mesh.simplices.dimension()) + 1);
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

std::vector<std::string> lost_in_tetgen(const MeshData& mesh, const WriteOptions&) {
  auto lost = lost_in_part_numbers(mesh);
  const MeshField* on_rows = nullptr;
  Offset named = 0, vertex_fields = 0, row_fields = 0, row_parts = 0;
  for (const auto& field : mesh.fields) {
    const bool is_row_field = field.on == MeshField::On::rows;
    if (is_row_field) on_rows = &field;
    auto& count = is_row_field ? row_fields : vertex_fields;
    ++count;
    named += field.components != 1 || field.name != tetgen_attribute_name(count);
  }
  for (const auto& part : mesh.parts) row_parts += part.degree == mesh.simplices.dimension();
  if (named > 0)
    lost.push_back(text("does not hold names and components of fields (", named, "), only columns of attributes"));
  if (row_fields > 0 && row_parts > 0)
    lost.push_back(text("does not hold parts of the rows (", row_parts, ") beside fields on rows"));
  if (row_fields == 1 && on_rows->components == 1 && std::ranges::all_of(on_rows->values, reads_as_region))
    lost.push_back(text("holds a single field of integers on the rows (", quoted_token(on_rows->name),
                        ") as regions: it reads back as parts"));
  return lost;
}

std::vector<std::string> tetgen_files(const TetgenPaths& paths, const MeshData& mesh) {
  std::vector<std::string> files{paths.node, paths.ele};
  if (has_lower(mesh, 2)) files.push_back(paths.face);
  if (has_lower(mesh, 1)) files.push_back(paths.edge);
  return files;
}

void write_tetgen_files(const TetgenPaths& paths, const MeshData& mesh) {
  Output nodes(paths.node), simplices(paths.ele);
  std::optional<Output> faces, edges;
  has_lower(mesh, 2) ? void(faces.emplace(paths.face)) : require_removable(paths.face);
  has_lower(mesh, 1) ? void(edges.emplace(paths.edge)) : require_removable(paths.edge);
  write_tetgen({nodes.writer, simplices.writer, faces ? &faces->writer : nullptr, edges ? &edges->writer : nullptr},
               mesh);
  std::vector<Output*> outputs{&nodes};
  if (faces) outputs.push_back(&*faces);
  if (edges) outputs.push_back(&*edges);
  outputs.push_back(&simplices);

  // The files cannot be replaced at once, but no mesh is read without its simplices: while those are missing, it does
  // not matter that old files stand beside new ones.
  for (auto* output : outputs) output->finish();
  simplices.file.remove_old();
  if (!faces) remove_stale(paths.face);
  if (!edges) remove_stale(paths.edge);
  for (auto* output : outputs) output->file.commit();
}

}  // namespace derham
