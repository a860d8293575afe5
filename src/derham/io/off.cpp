#include "derham/core/large_pages.hpp"
#include "derham/core/text.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/listed_simplices.hpp"
#include "derham/io/polygons.hpp"

#include <limits>
#include <utility>
#include <vector>

namespace derham {

MeshData read_off(Cursor& file, const ReadOptions& options) {
  if (!file.next_line()) file.fail_token("the header OFF", nullptr);
  const auto start = file.offset();
  if (const auto header = file.word("the header OFF"); header != "OFF") {
    file.rewind(start);
    if (header.ends_with("OFF"))
      file.fail(text("this is ", quoted_token(header),
                     ", a variant of OFF; expected plain OFF: vertices of 3 coordinates without colours or normals"));
    file.fail_token("the header OFF", nullptr);
  }
  if (!file.at_line_end() && file.word("BINARY") == "BINARY") file.fail("this is binary OFF; expected the text form");
  file.rewind(start + 3);

  MeshData mesh;
  mesh.ambient_dimension = 3;
  if (!file.next_line()) file.fail_token("the number of vertices", nullptr);
  mesh.vertex_count = file.count("the number of vertices", 6);
  const Index faces = file.count("the number of faces", 4);
  if (!file.at_line_end()) (void)file.integer("the number of edges", 0, std::numeric_limits<std::int64_t>::max());
  file.end_line();

  reserve_large(mesh.points, static_cast<std::size_t>(mesh.vertex_count) * 3);
  for (Index i = 0; i < mesh.vertex_count; ++i) {
    if (!file.next_line()) file.fail(text("the file ends after ", i, " of ", mesh.vertex_count, " vertices"));
    for (int axis = 0; axis < 3; ++axis) mesh.points.push_back(file.real("a coordinate"));
    file.end_line();
  }

  ListedSimplices rows;
  Polygons polygons(file, options);
  Index coloured = 0;
  std::vector<Index> row;
  for (Index i = 0; i < faces; ++i) {
    if (!file.next_line()) file.fail(text("the file ends after ", i, " of ", faces, " faces"));
    const auto width = file.integer("the number of vertices of a face", 1, std::numeric_limits<std::int64_t>::max());
    if (width > 3 && !options.triangulate) polygons.refuse(static_cast<std::size_t>(width));
    row.clear();  // grows with what the line really holds
    for (std::int64_t v = 0; v < width; ++v)
      row.push_back(static_cast<Index>(file.integer("a vertex id", 0, std::int64_t{mesh.vertex_count} - 1)));
    // A colour may follow: an index, or 3 or 4 components.
    coloured += !file.at_line_end();
    for (int part = 0; part < 4 && !file.at_line_end(); ++part) (void)file.real("a colour");
    file.end_line();
    polygons.add(row, rows);
  }
  file.end_file();
  polygons.note_on(mesh);
  if (coloured > 0) mesh.notes.push_back(text("skipped the colours of ", coloured, " faces"));
  std::move(rows).move_to(mesh);
  return mesh;
}

void write_off(TextWriter& file, const MeshData& mesh, const WriteOptions&) {
  const auto m = static_cast<std::size_t>(mesh.ambient_dimension);
  file.put("OFF\n").put(mesh.vertex_count).put(' ').put(mesh.simplices.size()).put(" 0\n");
  for (std::size_t i = 0; i < static_cast<std::size_t>(mesh.vertex_count); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      file.put(axis < m ? mesh.points[i * m + axis] : 0.0).put(axis < 2 ? ' ' : '\n');
  for (Offset i = 0; i < mesh.simplices.size(); ++i) {
    file.put(mesh.simplices[i].size());
    for (const Index v : mesh.simplices[i]) file.put(' ').put(v);
    file.put('\n');
  }
}

}  // namespace derham
