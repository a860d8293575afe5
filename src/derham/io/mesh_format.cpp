#include "derham/io/mesh_format.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/cursor.hpp"
#include "derham/io/formats.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace derham {
namespace {

constexpr auto none = Cursor::no_comment;

constexpr std::array table{
    // clang-format off
    //            format              name      extensions  magic              comment  reader       writer        lost            n     m     parts  lower  fields
    FormatTraits{MeshFormat::tetgen, "tetgen", "node ele", "",                    '#',  nullptr,     nullptr,      lost_in_tetgen, 2, 3, 2, 3, true,  true,  true},
    FormatTraits{MeshFormat::gmsh,   "gmsh",   "msh",      "$",                   none, read_gmsh,   write_gmsh,   lost_in_gmsh,   0, 3, 3, 3, true,  true,  true},
    FormatTraits{MeshFormat::medit,  "medit",  "mesh",     "MeshVersionFormatted", '#', read_medit,  write_medit,  lost_in_medit,  1, 3, 2, 3, true,  true,  false},
    FormatTraits{MeshFormat::vtk,    "vtk",    "vtk",      "# vtk DataFile",      none, read_vtk,    write_vtk,    lost_in_vtk,    0, 3, 3, 3, false, true,  true},
    FormatTraits{MeshFormat::vtu,    "vtu",    "vtu",      "<",                   none, read_vtu,    write_vtu,    lost_in_vtu,    0, 3, 3, 3, false, true,  true},
    FormatTraits{MeshFormat::obj,    "obj",    "obj",      "",                    '#',  read_obj,    write_obj,    nullptr,        0, 2, 3, 3, false, false, false},
    FormatTraits{MeshFormat::off,    "off",    "off",      "OFF",                 '#',  read_off,    write_off,    nullptr,        0, 2, 3, 3, false, false, false},
    FormatTraits{MeshFormat::ply,    "ply",    "ply",      "ply",                 none, read_ply,    write_ply,    lost_in_ply,    0, 2, 3, 3, false, false, true},
    FormatTraits{MeshFormat::stl,    "stl",    "stl",      "solid",               none, read_stl,    write_stl,    lost_in_stl,    2, 2, 3, 3, false, false, false},
    FormatTraits{MeshFormat::facets, "facets", "facets",   "",                    '#',  read_facets, write_facets, lost_in_facets, 0, 6, 0, 6, false, false, false},
    FormatTraits{MeshFormat::npz,    "npz",    "npz",      "PK",                  none, read_npz,    write_npz,    nullptr,        0, 6, 0, 6, true,  true,  true},
    // clang-format on
};

std::string extension_of(std::string_view path) {
  const auto name = path.substr(path.find_last_of('/') + 1);
  const auto dot = name.find_last_of('.');
  std::string extension(dot == std::string_view::npos ? std::string_view() : name.substr(dot + 1));
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

bool is_word_of(std::string_view words, std::string_view word) {
  for (std::size_t begin = 0; begin < words.size();) {
    const auto end = std::min(words.find(' ', begin), words.size());
    if (words.substr(begin, end - begin) == word) return true;
    begin = end + 1;
  }
  return false;
}

template <class Condition>
std::string names_where(Condition condition) {
  std::string out;
  for (const auto& traits : table)
    if (condition(traits)) (out += out.empty() ? "" : ", ") += traits.name;
  return out;
}

// Whether this is a .node or .ele file by how it goes on: a line "N d …" of 2 to 4 counts, then records numbered from 0
// or 1 that are as long as the counts say. At least three of them, or a list of facets could look the same.
bool looks_like_tetgen(Cursor file) {
  constexpr std::int64_t most_looked_at = 100;
  const auto numbers_of_line = [&] {
    std::vector<double> numbers;
    while (!file.at_line_end() && numbers.size() < 1000) numbers.push_back(file.real("a number"));
    return numbers;
  };
  try {
    if (!file.next_line()) return false;
    const auto counts = numbers_of_line();
    if (counts.size() < 2 || counts.size() > 4 || counts[0] < 3) return false;
    double length = 1;
    for (std::size_t i = 1; i < counts.size(); ++i) length += counts[i];
    double base = 0;
    for (std::int64_t i = 0; i < most_looked_at && static_cast<double>(i) < counts[0]; ++i) {
      if (!file.next_line()) return false;
      const auto record = numbers_of_line();
      if (i == 0) base = record[0];
      if (static_cast<double>(record.size()) != length || record[0] != base + static_cast<double>(i)) return false;
    }
    return base == 0 || base == 1;
  } catch (const Error&) {
    return false;  // a word, or a number that is none
  }
}

bool is_read(const FormatTraits& traits) { return traits.read != nullptr || traits.format == MeshFormat::tetgen; }

}  // namespace

std::span<const FormatTraits> format_table() noexcept { return table; }
const FormatTraits& format_traits(MeshFormat format) noexcept { return table[static_cast<std::size_t>(format)]; }

const char* format_name(MeshFormat format) noexcept { return format_traits(format).name.data(); }

std::string readable_formats() { return names_where(is_read); }
std::string writable_formats() {
  return names_where([](const auto& t) { return t.write != nullptr || t.format == MeshFormat::tetgen; });
}

std::optional<MeshFormat> format_by_name(std::string_view name) noexcept {
  for (const auto& traits : table)
    if (name == traits.name) return traits.format;
  return {};
}

std::optional<MeshFormat> format_by_extension(std::string_view path) {
  const auto extension = extension_of(path);
  for (const auto& traits : table)
    if (!extension.empty() && is_word_of(traits.extensions, extension)) return traits.format;
  return {};
}

MeshFormat detect_format(const std::string& path, std::string_view bytes) {
  if (is_binary_stl(bytes)) return MeshFormat::stl;  // its first 80 bytes may be anything
  Cursor cursor(bytes, path, '#');
  std::string_view first;
  if (cursor.next_line()) first = cursor.word("a token");
  // As the file begins, then as it goes on after comments: a VTK file begins with one, and any title may follow.
  for (const auto& beginning : {bytes, first})
    for (const auto& traits : table)
      if (!traits.magic.empty() && is_read(traits) && beginning.starts_with(traits.magic)) return traits.format;
  if (is_obj_keyword(first)) return MeshFormat::obj;

  const auto format = format_by_extension(path);
  if (format && is_read(format_traits(*format))) return *format;
  const auto extension = extension_of(path);
  if (extension == "meshb")
    throw FileError(FileError::Action::read, path, 0,
                    "derham does not read binary Medit files (.meshb); convert it to .mesh");
  constexpr std::array unread{"vtp", "poly", "face", "edge", "neigh", "vol", "var", "smesh",
                              "inp", "xdmf", "stp",  "step", "iges",  "bdf", "cgns"};
  if (!format && std::ranges::find(unread, extension) == unread.end() && !first.empty() && first[0] >= '0' &&
      first[0] <= '9')
    return looks_like_tetgen(Cursor(bytes, path, '#')) ? MeshFormat::tetgen : MeshFormat::facets;
  throw FileError(FileError::Action::read, path, 0,
                  text("not a mesh format that derham reads: ",
                       first.empty() ? "the file has no content" : "it begins with " + quoted_token(first),
                       "; expected one of ", readable_formats()));
}

}  // namespace derham
