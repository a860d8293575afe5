#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace derham {

/// The mesh file formats.
enum class MeshFormat : std::uint8_t {
  tetgen,  ///< TetGen and Triangle: NAME.node and NAME.ele, with NAME.face and NAME.edge where they exist
  gmsh,    ///< Gmsh .msh 2.2 and 4.1, ASCII and binary
  medit,   ///< Medit .mesh, ASCII
  vtk,     ///< VTK legacy, ASCII and binary
  vtu,     ///< VTK unstructured grid (XML)
  obj,     ///< Wavefront OBJ
  off,     ///< Object File Format
  ply,     ///< Stanford polygon file, ASCII and binary
  stl,     ///< triangles without a common vertex list, ASCII and binary
  facets,  ///< one simplex per line: vertex ids, no positions
  npz,     ///< numpy arrays in a zip archive
};

/// The name of a format, as the enumerator: "tetgen", "gmsh", ….
[[nodiscard]] const char* format_name(MeshFormat format) noexcept;

/// The format with that name, if there is one.
[[nodiscard]] std::optional<MeshFormat> format_by_name(std::string_view name) noexcept;

/// The format that the extension of `path` stands for, in any letter case; nothing if it stands for none.
[[nodiscard]] std::optional<MeshFormat> format_by_extension(std::string_view path);

/// The names of all formats that derham reads (writes), separated by ", ".
[[nodiscard]] std::string readable_formats();
[[nodiscard]] std::string writable_formats();

/// The format of a file, by how its content begins ("OFF", "$…", an OBJ keyword), else by the extension of its name;
/// a file without a known extension that begins with a number is a list of facets, unless it reads like a .node or .ele
/// file (counts, then at least three numbered records as long as these say).
/// `bytes` is the beginning of the file, or all of it.
/// Throws   FileError if neither tells, or when the extension belongs to a format that derham does not read
[[nodiscard]] MeshFormat detect_format(const std::string& path, std::string_view bytes);

}  // namespace derham
