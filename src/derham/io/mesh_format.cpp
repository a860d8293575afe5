#include "derham/io/mesh_format.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/cursor.hpp"
#include "derham/io/formats.hpp"

#include <algorithm>
#include <array>

namespace derham {
namespace {

struct Extension {
  std::string_view name;
  MeshFormat format;
};
constexpr std::array extensions{Extension{"node", MeshFormat::tetgen}, Extension{"ele", MeshFormat::tetgen},
                                Extension{"msh", MeshFormat::gmsh},    Extension{"off", MeshFormat::off},
                                Extension{"obj", MeshFormat::obj},     Extension{"facets", MeshFormat::facets},
                                Extension{"vtu", MeshFormat::vtu}};

std::string extension_of(std::string_view path) {
  const auto name = path.substr(path.find_last_of('/') + 1);
  const auto dot = name.find_last_of('.');
  std::string extension(dot == std::string_view::npos ? std::string_view() : name.substr(dot + 1));
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

}  // namespace

const char* format_name(MeshFormat format) noexcept {
  constexpr std::array names{"tetgen", "gmsh", "off", "obj", "facets", "vtu"};
  return names[static_cast<std::size_t>(format)];
}

std::optional<MeshFormat> format_by_name(std::string_view name) noexcept {
  for (const auto& [extension, format] : extensions)
    if (name == format_name(format)) return format;
  return {};
}

std::optional<MeshFormat> format_by_extension(std::string_view path) {
  const auto* const found = std::ranges::find(extensions, std::string_view(extension_of(path)), &Extension::name);
  if (found == extensions.end()) return {};
  return found->format;
}

MeshFormat detect_format(const std::string& path, std::string_view bytes) {
  Cursor cursor(bytes, path, '#');
  std::string_view first;
  if (cursor.next_line()) first = cursor.word("a token");
  if (first.starts_with("$")) return MeshFormat::gmsh;
  if (first == "OFF") return MeshFormat::off;
  if (is_obj_keyword(first)) return MeshFormat::obj;

  const auto format = format_by_extension(path);
  if (format && format != MeshFormat::vtu) return *format;
  const auto extension = extension_of(path);
  constexpr std::array unread{"vtu",  "vtk",  "vtp",  "ply",   "stl", "mesh", "meshb",
                              "poly", "face", "edge", "smesh", "inp", "xdmf"};
  if (!format && std::ranges::find(unread, extension) == unread.end() && !first.empty() && first[0] >= '0' &&
      first[0] <= '9')
    return MeshFormat::facets;
  throw FileError(FileError::Action::read, path, 0,
                  text("not a mesh format that derham reads: ",
                       first.empty() ? "the file has no content" : "it begins with " + quoted_token(first),
                       "; expected TetGen .node/.ele, Gmsh .msh 2.2, .off, .obj or .facets"));
}

}  // namespace derham
