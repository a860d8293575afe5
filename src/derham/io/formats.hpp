#pragma once

#include "derham/geometry/mesh_data.hpp"
#include "derham/io/cursor.hpp"
#include "derham/io/mesh_format.hpp"
#include "derham/io/options.hpp"
#include "derham/io/text_writer.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// One reader and one writer per format; read_mesh.hpp and write_mesh.hpp say what they do. Not installed.
namespace derham {

/// The files of a TetGen mesh. Nodes and simplices may be in one: then both are the same cursor.
struct TetgenFiles {
  Cursor &nodes, &simplices;
  Cursor* faces = nullptr;
  Cursor* edges = nullptr;
};
[[nodiscard]] MeshData read_tetgen(const TetgenFiles& files, const ReadOptions& options);
[[nodiscard]] MeshData read_gmsh(Cursor& file, const ReadOptions& options);
[[nodiscard]] MeshData read_medit(Cursor& file, const ReadOptions& options);
[[nodiscard]] MeshData read_vtk(Cursor& file, const ReadOptions& options);
[[nodiscard]] MeshData read_vtu(Cursor& file, const ReadOptions& options);
[[nodiscard]] MeshData read_off(Cursor& file, const ReadOptions& options);
[[nodiscard]] MeshData read_obj(Cursor& file, const ReadOptions& options);
[[nodiscard]] MeshData read_ply(Cursor& file, const ReadOptions& options);
[[nodiscard]] MeshData read_stl(Cursor& file, const ReadOptions& options);
[[nodiscard]] MeshData read_facets(Cursor& file, const ReadOptions& options);
[[nodiscard]] MeshData read_npz(Cursor& file, const ReadOptions& options);

struct TetgenWriters {
  TextWriter &nodes, &simplices;
  TextWriter* faces = nullptr;
  TextWriter* edges = nullptr;
};
void write_tetgen(const TetgenWriters& files, const MeshData& mesh);
void write_gmsh(TextWriter& file, const MeshData& mesh, const WriteOptions& options);
void write_medit(TextWriter& file, const MeshData& mesh, const WriteOptions& options);
void write_vtk(TextWriter& file, const MeshData& mesh, const WriteOptions& options);
void write_off(TextWriter& file, const MeshData& mesh, const WriteOptions& options);
void write_obj(TextWriter& file, const MeshData& mesh, const WriteOptions& options);
void write_ply(TextWriter& file, const MeshData& mesh, const WriteOptions& options);
void write_stl(TextWriter& file, const MeshData& mesh, const WriteOptions& options);
void write_facets(TextWriter& file, const MeshData& mesh, const WriteOptions& options);
void write_npz(TextWriter& file, const MeshData& mesh, const WriteOptions& options);
void write_vtu(TextWriter& file, const MeshData& mesh, const WriteOptions& options);

// What each writer cannot carry, see FormatTraits::lost.
[[nodiscard]] std::vector<std::string> lost_in_tetgen(const MeshData& mesh, const WriteOptions& options);
[[nodiscard]] std::vector<std::string> lost_in_gmsh(const MeshData& mesh, const WriteOptions& options);
[[nodiscard]] std::vector<std::string> lost_in_medit(const MeshData& mesh, const WriteOptions& options);
[[nodiscard]] std::vector<std::string> lost_in_vtk(const MeshData& mesh, const WriteOptions& options);
[[nodiscard]] std::vector<std::string> lost_in_vtu(const MeshData& mesh, const WriteOptions& options);
[[nodiscard]] std::vector<std::string> lost_in_ply(const MeshData& mesh, const WriteOptions& options);
[[nodiscard]] std::vector<std::string> lost_in_stl(const MeshData& mesh, const WriteOptions& options);
[[nodiscard]] std::vector<std::string> lost_in_facets(const MeshData& mesh, const WriteOptions& options);

/// What a format is called, how its files are found, and what they can hold.
struct FormatTraits {
  MeshFormat format;
  std::string_view name;
  std::string_view extensions;  ///< separated by blanks
  std::string_view magic;       ///< how every file begins; empty: not by anything fixed
  char comment;                 ///< Cursor::no_comment if there are none, or the reader sees to them
  MeshData (*read)(Cursor&, const ReadOptions&);
  void (*write)(TextWriter&, const MeshData&, const WriteOptions&);
  /// What a file loses of a mesh beside what the flags below say, one phrase each that goes on "format NAME …".
  std::vector<std::string> (*lost)(const MeshData&, const WriteOptions&);

  int least_dimension, largest_dimension;  ///< n of the meshes it can hold
  int least_ambient, largest_ambient;      ///< m of its files; positions of fewer numbers are padded with zeros
  bool holds_parts, holds_lower, holds_fields;
};

/// All formats, in the order of the enumerators. Null functions: not read, not written, or (tetgen) in several files;
/// nothing more is lost.
[[nodiscard]] std::span<const FormatTraits> format_table() noexcept;
[[nodiscard]] const FormatTraits& format_traits(MeshFormat format) noexcept;

/// Whether a line of an OBJ file may begin with `word`.
[[nodiscard]] bool is_obj_keyword(std::string_view word) noexcept;

/// Whether these are all the bytes of a binary STL file: its length fits the number of triangles it gives.
[[nodiscard]] bool is_binary_stl(std::string_view bytes) noexcept;

/// NAME.node, NAME.ele and their companions for either of the two, or for NAME itself. The others' extensions have the
/// letter case of the one that is given.
struct TetgenPaths {
  std::string node, ele, face, edge;
};
[[nodiscard]] TetgenPaths tetgen_paths(const std::string& path);

/// How the field is called that column `number` = 1, 2… of the attributes becomes.
[[nodiscard]] std::string tetgen_attribute_name(Offset number);

/// The region that an attribute names: an integer of 64 bits, or a real number that is one of at most 53 bits.
[[nodiscard]] std::optional<std::int64_t> tetgen_region(std::string_view attribute);

/// Writes the files of a mesh: .face and .edge if there is something to write into them; else those of an older mesh are
/// removed, for they would be read with this one. At every moment there is the old mesh, the new one, or no .ele.
void write_tetgen_files(const TetgenPaths& paths, const MeshData& mesh);
/// The files that it writes.
[[nodiscard]] std::vector<std::string> tetgen_files(const TetgenPaths& paths, const MeshData& mesh);

}  // namespace derham
