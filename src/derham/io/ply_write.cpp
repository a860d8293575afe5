#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/byte_order.hpp"
#include "derham/io/cursor.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/renamed_fields.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace derham {
namespace {

// The properties that hold the fields on vertices or on rows: one per component.
struct Column {
  std::string name;
  const MeshField* field;
  std::size_t component;
};

// A name that is one word, and not taken yet.
std::string free_word(std::string name, std::set<std::string>& taken) {
  for (char& c : name)
    if (static_cast<unsigned char>(c) <= ' ' || c == '\x7f') c = '_';
  if (name.empty()) name = "field";
  while (!taken.insert(name).second) name += '_';
  return name;
}

std::vector<Column> columns(const MeshData& mesh, MeshField::On on) {
  std::set<std::string> taken{"x", "y", "z", "vertex_indices", "vertex_index", "list"};
  std::vector<Column> out;
  for (const auto& field : mesh.fields)
    for (std::size_t c = 0; field.on == on && c < static_cast<std::size_t>(field.components); ++c)
      out.push_back({free_word(field.components == 1 ? field.name : text(field.name, "_", c), taken), &field, c});
  return out;
}

// What becomes of the names of the fields.
void add_lost_names(const MeshData& mesh, MeshField::On on, std::vector<std::string>& lost) {
  const auto written = columns(mesh, on);
  for (std::size_t i = 0; i < written.size(); i += static_cast<std::size_t>(written[i].field->components)) {
    const auto& field = *written[i].field;
    const auto last = i + static_cast<std::size_t>(field.components) - 1;
    if (field.components > 1)
      lost.push_back(text("does not hold the ", field.components, " components of the field ", quoted_token(field.name),
                          " together: they become ", quoted_token(written[i].name), " to ",
                          quoted_token(written[last].name)));
    else if (written[i].name != field.name)
      lost.push_back(lost_name(field.name, written[i].name));
  }
}

}  // namespace

std::vector<std::string> lost_in_ply(const MeshData& mesh, const WriteOptions&) {
  std::vector<std::string> lost;
  add_lost_names(mesh, MeshField::On::vertices, lost);
  add_lost_names(mesh, MeshField::On::rows, lost);
  return lost;
}

void write_ply(TextWriter& file, const MeshData& mesh, const WriteOptions& options) {
  if (std::int64_t{mesh.vertex_count} > std::numeric_limits<std::int32_t>::max())
    throw InputError(text("format ply numbers vertices by 32 bits, this mesh has ", mesh.vertex_count));
  const bool is_text = options.encoding == WriteOptions::Encoding::ascii;
  constexpr bool swap = is_foreign_order(true);
  const auto on_vertices = columns(mesh, MeshField::On::vertices);
  const auto on_rows = columns(mesh, MeshField::On::rows);
  file.put("ply\nformat ").put(is_text ? "ascii" : "binary_little_endian").put(" 1.0\nelement vertex ");
  file.put(mesh.vertex_count).put("\nproperty double x\nproperty double y\nproperty double z\n");
  for (const auto& column : on_vertices) file.put("property double ").put(column.name).put('\n');
  file.put("element face ").put(mesh.simplices.size()).put("\nproperty list uchar int vertex_indices\n");
  for (const auto& column : on_rows) file.put("property double ").put(column.name).put('\n');
  file.put("end_header\n");

  const auto put_double = [&](double value, char before) {
    if (!is_text)
      file.put_bytes(value, swap);
    else if (before == '\0')
      file.put(value);
    else
      file.put(before).put(value);
  };
  const auto put_columns = [&](const std::vector<Column>& of, std::size_t item) {
    for (const auto& [name, field, component] : of)
      put_double(field->values[item * static_cast<std::size_t>(field->components) + component], ' ');
    if (is_text) file.put('\n');
  };
  const auto m = static_cast<std::size_t>(mesh.ambient_dimension);
  for (std::size_t i = 0; i < static_cast<std::size_t>(mesh.vertex_count); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      put_double(axis < m ? mesh.points[i * m + axis] : 0.0, axis == 0 ? '\0' : ' ');
    put_columns(on_vertices, i);
  }
  for (Offset i = 0; i < mesh.simplices.size(); ++i) {
    const auto row = mesh.simplices[i];
    if (is_text) {
      file.put(row.size());
      for (const Index v : row) file.put(' ').put(v);
    } else {
      file.put_bytes(static_cast<std::uint8_t>(row.size()));
      for (const Index v : row) file.put_bytes(static_cast<std::int32_t>(v), swap);
    }
    put_columns(on_rows, static_cast<std::size_t>(i));
  }
}

}  // namespace derham
