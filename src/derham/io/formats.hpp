#pragma once

#include "derham/geometry/mesh_data.hpp"
#include "derham/io/cursor.hpp"
#include "derham/io/text_writer.hpp"

#include <string>
#include <string_view>

// One reader and one writer per format; read_mesh.hpp and write_mesh.hpp say what they do. Not installed.
namespace derham {

/// Both parts may be in one file: then both arguments are the same cursor.
[[nodiscard]] MeshData read_tetgen(Cursor& nodes, Cursor& simplices);
[[nodiscard]] MeshData read_gmsh(Cursor& file);
[[nodiscard]] MeshData read_off(Cursor& file);
[[nodiscard]] MeshData read_obj(Cursor& file);
[[nodiscard]] MeshData read_facets(Cursor& file);

void write_tetgen(TextWriter& nodes, TextWriter& simplices, const MeshData& mesh);
void write_gmsh(TextWriter& file, const MeshData& mesh);
void write_off(TextWriter& file, const MeshData& mesh);
void write_obj(TextWriter& file, const MeshData& mesh);
void write_facets(TextWriter& file, const MeshData& mesh);

/// Whether a line of an OBJ file may begin with `word`.
[[nodiscard]] bool is_obj_keyword(std::string_view word) noexcept;

/// NAME.node and NAME.ele for either of the two, or for NAME itself.
struct TetgenPaths {
  std::string node, ele;
};
[[nodiscard]] TetgenPaths tetgen_paths(const std::string& path);

}  // namespace derham
