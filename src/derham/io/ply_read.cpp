#include "derham/core/text.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/listed_simplices.hpp"
#include "derham/io/ply_elements.hpp"
#include "derham/io/ply_header.hpp"
#include "derham/io/polygons.hpp"

#include <cstdint>
#include <utility>

namespace derham {
namespace {

// An element that makes no mesh.
void skip_element(ply::Numbers& numbers, const ply::Element& element, MeshData& mesh) {
  for (std::int64_t i = 0; i < element.count; ++i) {
    numbers.begin_record(element, i);
    for (const auto& property : element.properties) numbers.skip(property);
    numbers.end_record();
  }
  mesh.notes.push_back(text("skipped ", element.count, " records of the element ", quoted_token(element.name)));
}

}  // namespace

MeshData read_ply(Cursor& file, const ReadOptions& options) {
  const auto header = ply::read_header(file);
  MeshData mesh;
  for (const auto& element : header.elements)
    if (element.name == "vertex") mesh.vertex_count = static_cast<Index>(element.count);
  ply::Numbers numbers(file, header);
  ListedSimplices rows;
  Polygons polygons(file, options);
  ply::FaceFields face_fields;
  bool has_vertices = false;
  for (const auto& element : header.elements) {
    if (element.name == "vertex") {
      has_vertices = true;
      read_vertices(numbers, element, mesh);
    } else if (element.name == "face") {
      face_fields = read_faces(numbers, element, polygons, options, rows, mesh);
    } else if (element.name == "edge") {
      read_edges(numbers, element, rows, mesh);
    } else if (element.name == "tristrips" && element.count > 0) {
      file.fail("the faces are given as strips of triangles; expected the element face: save the file without strips");
    } else {
      skip_element(numbers, element, mesh);
    }
  }
  if (!has_vertices) file.fail("the file has no element vertex");
  if (!numbers.is_text() && file.remaining() > 0)
    file.fail(text(file.remaining(), " bytes follow the last record; expected the end of the file"));
  if (numbers.is_text()) file.end_file();
  polygons.note_on(mesh);
  std::move(rows).move_to(mesh);
  std::move(face_fields).move_to(mesh);
  return mesh;
}

}  // namespace derham
