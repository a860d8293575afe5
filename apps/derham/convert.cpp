#include "commands.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/unused_vertices.hpp"
#include "derham/io/write_mesh.hpp"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace derham::cli {
namespace {

struct Conversion {
  Input from;
  std::string path, format, gmsh_version;
  bool binary = false, ascii = false;
};

MeshFormat output_format(const Conversion& c) {
  if (const auto format = named_format(c.format, writable_formats())) return *format;
  if (const auto format = format_by_extension(c.path)) return *format;
  throw Failure(Exit::usage, "usage",
                "the name '" + c.path + "' does not tell the format; use " + mesh_extensions + " or --to");
}

/// What was asked for, if the format leaves that choice.
WriteOptions write_options(const Conversion& c, MeshFormat format) {
  WriteOptions options;
  if (!c.gmsh_version.empty()) {
    if (format != MeshFormat::gmsh)
      throw Failure(Exit::usage, "usage", text("--gmsh-version is for gmsh files, this is ", format_name(format)));
    if (c.gmsh_version != "2.2" && c.gmsh_version != "4.1")
      throw Failure(Exit::usage, "usage", "--gmsh-version is '" + c.gmsh_version + "'; it is 2.2 or 4.1");
    options.gmsh_41 = c.gmsh_version == "4.1";
  }
  if (!c.binary && !c.ascii) return options;
  constexpr std::array two_ways{MeshFormat::gmsh, MeshFormat::vtk, MeshFormat::vtu, MeshFormat::ply, MeshFormat::stl};
  if (std::ranges::find(two_ways, format) == two_ways.end())
    throw Failure(Exit::usage, "usage",
                  text(c.binary ? "--binary" : "--ascii", " is for gmsh, vtk, vtu, ply and stl; ", format_name(format),
                       " files are of one kind"));
  options.encoding = c.binary ? WriteOptions::Encoding::binary : WriteOptions::Encoding::ascii;
  return options;
}

std::string joined(const std::vector<std::string>& names) {
  std::string out;
  for (const auto& name : names) (out += out.empty() ? "" : ", ") += name;
  return out;
}

Exit convert(const Conversion& c, const Common& common) {
  Console console(common);
  const MeshFormat format = output_format(c);
  const WriteOptions options = write_options(c, format);
  MeshData mesh = read_input(c.from, console);
  const std::size_t notes = mesh.notes.size();
  const Index dropped = c.from.drop_unused ? drop_unused_vertices(mesh) : 0;
  if (dropped > 0) console.message(text(c.from.path, ": dropped ", dropped, " unused vertices"));
  for (std::size_t i = notes; i < mesh.notes.size(); ++i) console.message(c.from.path + ": " + mesh.notes[i]);

  std::optional<Reordering> reordering;
  if (c.from.reorder && !mesh.simplices.empty()) reordering = reorder(mesh, c.from.path, console);

  const auto lost = not_carried(mesh, format, options);
  const auto files = written_files(c.path, mesh, format);
  console.stage("writing " + c.path);
  try {
    write_mesh(c.path, mesh, format, options);
  } catch (const InputError& error) {
    throw Failure(Exit::unwritable, "input", c.path + ": " + error.what(), c.path);
  }
  console.clear_stage();
  for (const auto& what : lost) console.message(c.path + ": " + what);
  Json reordered;  // null
  if (reordering)
    reordered = {
        {"method", reordering->method}, {"gap_before", reordering->gap_before}, {"gap_after", reordering->gap_after}};
  if (common.json && c.path != "-")
    print(Json{{"file", c.path},
               {"files", files},
               {"format", format_name(format)},
               {"vertices", mesh.vertex_count},
               {"top_simplices", mesh.simplices.size()},
               {"dimension", mesh.simplices.dimension()},
               {"dropped_vertices", dropped},
               {"reordered", reordered},
               {"notes", mesh.notes},
               {"not_carried", lost}});
  else
    console.message(text(joined(files), ": ", mesh.vertex_count, " vertices, ", mesh.simplices.size(),
                         " simplices of dimension ", mesh.simplices.dimension()));
  return Exit::ok;
}

}  // namespace

Run add_convert(CLI::App& parent, Common& common) {
  CLI::App& command = *parent.add_subcommand("convert", "writes a mesh in another format and says what that loses");
  const auto conversion = std::make_shared<Conversion>();
  command.add_option("A", conversion->from.path, std::string("mesh file (") + mesh_extensions + "), - for stdin")
      ->required();
  command.add_option("B", conversion->path, "file to write, - for stdout")->required();
  command.add_option("--from,--format", conversion->from.format,
                     "format of A (" + readable_formats() + "), else detected");
  command.add_option("--to", conversion->format, "format of B (" + writable_formats() + "), else by its extension");
  CLI::Option* binary = command.add_flag("--binary", conversion->binary, "numbers as bytes (gmsh, vtk, vtu, ply, stl)");
  command.add_flag("--ascii", conversion->ascii, "numbers as text")->excludes(binary);
  command.add_option("--gmsh-version", conversion->gmsh_version, "2.2 (usual) or 4.1");
  add_reading_options(command, conversion->from);
  return [&common, conversion] { return convert(*conversion, common); };
}

}  // namespace derham::cli
