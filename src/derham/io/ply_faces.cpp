#include "derham/core/text.hpp"
#include "derham/io/ply_elements.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>

namespace derham::ply {
namespace {

// The position of the list of vertices, -1 if there are no faces either.
int vertex_list(const Numbers& numbers, const Element& element) {
  const int plural = element.find_ids("vertex_indices");
  const int found = plural >= 0 ? plural : element.find_ids("vertex_index");
  if (found < 0 && element.count > 0)
    numbers.file().fail("the faces have no list of integers called vertex_indices or vertex_index");
  return found;
}

void read_face(Numbers& numbers, const Property& list, std::int64_t i, Polygons& polygons, const ReadOptions& options,
               Index vertex_count, std::vector<Index>& face) {
  Cursor& file = numbers.file();
  const auto here = file.offset();
  const auto width = numbers.list_size(list);
  if (width == 0 || (width > 3 && !options.triangulate)) {
    file.rewind(here);
    if (width > 0) polygons.refuse(static_cast<std::size_t>(width));
    file.fail(text("face ", i, " has no vertices; expected 1 to 3"));
  }
  face.resize(static_cast<std::size_t>(width));
  numbers.vertices(list.type, vertex_count, face);
}

}  // namespace

void FaceFields::move_to(MeshData& mesh) && {
  const auto top = static_cast<std::size_t>(mesh.simplices.dimension()) + 1;
  for (auto& field : fields) {
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(mesh.simplices.size()));
    for (std::size_t i = 0; i < widths.size(); ++i) {
      const std::size_t rows = widths[i] == top ? 1 : widths[i] > 3 ? widths[i] - 2 : 0;
      values.insert(values.end(), rows, field.values[i]);
    }
    // Edges of an element of their own are rows without such numbers.
    if (values.size() != static_cast<std::size_t>(mesh.simplices.size())) {
      mesh.notes.push_back(
          text("skipped the property ", quoted_token(field.name), " of the faces: not all rows have it"));
      continue;
    }
    field.values = std::move(values);
    mesh.fields.push_back(std::move(field));
  }
}

FaceFields read_faces(Numbers& numbers, const Element& element, Polygons& polygons, const ReadOptions& options,
                      ListedSimplices& rows, MeshData& mesh) {
  const int indices = vertex_list(numbers, element);
  if (indices < 0) return {};
  const auto& list = element.properties[static_cast<std::size_t>(indices)];
  FaceFields result;
  std::vector<int> field_of(element.properties.size(), -1);
  for (std::size_t p = 0; p < field_of.size(); ++p) {
    const auto& property = element.properties[p];
    if (property.is_list) {
      if (&property != &list) note_skipped(property, "faces", mesh);
      continue;
    }
    field_of[p] = static_cast<int>(result.fields.size());
    result.fields.push_back({property.name, MeshField::On::rows, 1, {}});
    result.fields.back().values.reserve(static_cast<std::size_t>(element.count));
  }
  // Most faces are triangles: room for as many as the file can hold.
  rows.reserve(2, static_cast<Index>(std::min(element.count, numbers.room_for_triangles(list))), false);
  std::vector<Index> face;
  for (std::int64_t i = 0; i < element.count; ++i) {
    if (field_of.size() == 1) i += numbers.triangles(list, element.count - i, mesh.vertex_count, rows);
    if (i == element.count) break;
    numbers.begin_record(element, i);
    for (std::size_t p = 0; p < field_of.size(); ++p) {
      const auto& property = element.properties[p];
      if (&property == &list) {
        read_face(numbers, list, i, polygons, options, mesh.vertex_count, face);
        polygons.add(face, rows);
      } else if (field_of[p] >= 0) {
        result.fields[static_cast<std::size_t>(field_of[p])].values.push_back(
            numbers.real(property.type, "a property of a face", false));
      } else {
        numbers.skip(property);
      }
    }
    numbers.end_record();
    if (!result.fields.empty()) result.widths.push_back(face.size());
  }
  return result;
}

void read_edges(Numbers& numbers, const Element& element, ListedSimplices& rows, MeshData& mesh) {
  constexpr std::array ends{"vertex1", "vertex2"};
  std::array<int, 2> at{};
  for (std::size_t end = 0; end < 2; ++end) {
    at[end] = element.find_scalar(ends[end]);
    if (at[end] < 0 || is_real(element.properties[static_cast<std::size_t>(at[end])].type))
      numbers.file().fail(text("the edges have no integer property ", ends[end]));
  }
  const auto end_of = [&](std::size_t p) { return std::ranges::find(at, static_cast<int>(p)) - at.begin(); };
  const auto count = element.properties.size();
  for (std::size_t p = 0; p < count; ++p)
    if (end_of(p) == 2) note_skipped(element.properties[p], "edges", mesh);
  std::array<Index, 2> edge{};
  for (std::int64_t i = 0; i < element.count; ++i) {
    numbers.begin_record(element, i);
    for (std::size_t p = 0; p < count; ++p)
      if (const auto end = end_of(p); end < 2)
        numbers.vertices(element.properties[p].type, mesh.vertex_count,
                         std::span(edge).subspan(static_cast<std::size_t>(end), 1));
      else
        numbers.skip(element.properties[p]);
    numbers.end_record();
    rows.add(edge);
  }
}

}  // namespace derham::ply
