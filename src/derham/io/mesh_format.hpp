#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace derham {

/// The mesh file formats. `vtu` is written only.
enum class MeshFormat : std::uint8_t {
  tetgen,  ///< TetGen and Triangle: a pair NAME.node and NAME.ele
  gmsh,    ///< Gmsh .msh 2.2 ASCII
  off,     ///< Object File Format
  obj,     ///< Wavefront OBJ
  facets,  ///< one simplex per line: vertex ids, no positions
  vtu,     ///< VTK unstructured grid
};

/// The name of a format: "tetgen", "gmsh", "off", "obj", "facets", "vtu".
[[nodiscard]] const char* format_name(MeshFormat format) noexcept;

/// The format with that name, if there is one.
[[nodiscard]] std::optional<MeshFormat> format_by_name(std::string_view name) noexcept;

/// The format that the extension of `path` stands for, in any letter case; nothing if it stands for none.
[[nodiscard]] std::optional<MeshFormat> format_by_extension(std::string_view path);

/// The format of a file, by how its content begins ("OFF", "$…", an OBJ keyword), else by the extension of its name;
/// a file without a known extension that begins with a number is a list of facets.
/// `bytes` is the beginning of the file, or all of it.
/// Throws   FileError if neither tells, or when the extension belongs to a format that derham does not read
[[nodiscard]] MeshFormat detect_format(const std::string& path, std::string_view bytes);

}  // namespace derham
