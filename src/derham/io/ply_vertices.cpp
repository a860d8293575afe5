#include "derham/core/large_pages.hpp"
#include "derham/core/text.hpp"
#include "derham/io/ply_elements.hpp"

#include <array>
#include <cmath>
#include <cstdint>

namespace derham::ply {
namespace {

// Where the numbers of a property go: an axis, a field, or nowhere.
struct Target {
  double* first = nullptr;
  std::int64_t stride = 1;
  bool is_position = false;
};

// How many of x, y, z there are.
int dimension_of(const Element& element) {
  constexpr std::array axes{"x", "y", "z"};
  int dimension = 0;
  while (dimension < 3 && element.find_scalar(axes[static_cast<std::size_t>(dimension)]) >= 0) ++dimension;
  return dimension;
}

// Makes room for the positions and fields.
std::vector<Target> targets_of(const Element& element, MeshData& mesh) {
  const auto count = static_cast<std::size_t>(element.count);
  const int m = mesh.ambient_dimension;
  reserve_large(mesh.points, count * static_cast<std::size_t>(m));
  mesh.points.resize(count * static_cast<std::size_t>(m));
  mesh.fields.reserve(element.properties.size());
  std::vector<Target> targets;
  for (const auto& property : element.properties) {
    const int axis = property.name.size() == 1 ? property.name[0] - 'x' : -1;
    if (axis >= 0 && axis < m) {
      targets.push_back({mesh.points.data() + axis, m, true});
    } else if (property.is_list) {
      targets.push_back({});
      note_skipped(property, "vertices", mesh);
    } else {
      auto& field =
          mesh.fields.emplace_back(MeshField{property.name, MeshField::On::vertices, 1, std::vector<double>(count)});
      targets.push_back({field.values.data(), 1, false});
    }
  }
  return targets;
}

// Bytes without lists: a table, read column by column.
void read_table(Numbers& numbers, const Element& element, const std::vector<Target>& targets) {
  Cursor& file = numbers.file();
  const auto count = element.count;
  const auto record_bytes = element.least_bytes(false);
  const auto start = file.offset();
  const char* const table = file.bytes(count * record_bytes, "the vertices").data();
  std::int64_t offset = 0;
  for (std::size_t p = 0; p < targets.size(); ++p) {
    const auto& [first, stride, is_position] = targets[p];
    const auto type = element.properties[p].type;
    numbers.column(table + offset, count, record_bytes, type, first, stride);
    for (std::int64_t i = 0; is_position && i < count; ++i) {
      if (std::isfinite(first[i * stride])) continue;
      file.rewind(start + i * record_bytes + offset);
      file.fail(text("found ", first[i * stride], ", expected a finite number as the property ",
                     quoted_token(element.properties[p].name), " of vertex ", i));
    }
    offset += byte_width(type);
  }
}

}  // namespace

void note_skipped(const Property& property, std::string_view what, MeshData& mesh) {
  mesh.notes.push_back(
      text("skipped the ", property.is_list ? "list " : "property ", quoted_token(property.name), " of the ", what));
}

void read_vertices(Numbers& numbers, const Element& element, MeshData& mesh) {
  mesh.ambient_dimension = dimension_of(element);
  if (mesh.ambient_dimension == 0) numbers.file().fail("the vertices have no property x; expected x, y and z");
  if (element.count == 0) return;
  const auto targets = targets_of(element, mesh);
  if (!numbers.is_text() && !element.has_lists()) return read_table(numbers, element, targets);
  for (std::int64_t i = 0; i < element.count; ++i) {
    numbers.begin_record(element, i);
    for (std::size_t p = 0; p < targets.size(); ++p)
      if (targets[p].first != nullptr)
        targets[p].first[i * targets[p].stride] =
            numbers.real(element.properties[p].type, "a property of a vertex", targets[p].is_position);
      else
        numbers.skip(element.properties[p]);
    numbers.end_record();
  }
}

}  // namespace derham::ply
