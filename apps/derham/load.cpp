#include "load.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/geometry/renumber_mesh.hpp"
#include "derham/io/read_mesh.hpp"
#include "derham/io/unused_vertices.hpp"

#include <algorithm>
#include <numeric>

namespace derham::cli {
namespace {

/// drop_unused_vertices, with the way back kept as positions.
Index compact(LoadedMesh& loaded) {
  MeshData& mesh = loaded.mesh;
  mesh.vertex_tags = loaded.file_vertex;
  const Index dropped = drop_unused_vertices(mesh);
  loaded.file_vertex = std::move(mesh.vertex_tags);
  mesh.vertex_tags.clear();
  return dropped;
}

}  // namespace

std::optional<MeshFormat> named_format(const std::string& name, const std::string& formats) {
  if (name.empty()) return {};
  if (const auto format = format_by_name(name)) return format;
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin < formats.size();) {
    const auto end = std::min(formats.find(", ", begin), formats.size());
    names.push_back(formats.substr(begin, end - begin));
    begin = end + 2;
  }
  throw Failure(Exit::usage, "usage",
                "unknown format '" + name + "'" + suggestion(name, names) + "; formats are " + formats);
}

MeshData read_input(const Input& input, Console& console) {
  const auto format = named_format(input.format, readable_formats());
  const std::string name = input.path == "-" ? "stdin" : input.path;
  console.stage("reading " + name);
  try {
    MeshData mesh = read_mesh(input.path, format, input.options);
    console.clear_stage();
    for (const auto& note : mesh.notes) console.message(text(name, ": ", note));
    return mesh;
  } catch (const LimitError& error) {
    throw Failure(Exit::limit, error.kind(), error.what(), name);
  }
}

std::string LoadedMesh::tags_text(std::span<const Index> simplex) const {
  if (file_tags.empty()) return {};
  std::string out = "file numbers ";
  for (std::size_t i = 0; i < simplex.size(); ++i)
    out += (i ? ", " : "") + std::to_string(file_tags[static_cast<std::size_t>(position(simplex[i]))]);
  return out;
}

std::string LoadedMesh::row_text(Offset row) const {
  if (mesh.row_tags.empty()) return {};
  return text(" (simplex ", mesh.row_tags[static_cast<std::size_t>(row)], " in the file)");
}

void LoadedMesh::remove_rows(std::span<const Offset> rows) {
  MeshData kept = mesh;
  kept.simplices = SimplexList();
  kept.corners.clear();
  kept.row_tags.clear();
  kept.lower.clear();  // what names the rows is of no use to the commands that remove some
  kept.parts.clear();
  kept.fields.clear();
  std::size_t next = 0;
  for (Offset row = 0; row < mesh.simplices.size(); ++row) {
    if (next < rows.size() && rows[next] == row) {
      ++next;
      continue;
    }
    kept.simplices.push_back(mesh.simplices[row]);
    if (!mesh.row_tags.empty()) kept.row_tags.push_back(mesh.row_tags[static_cast<std::size_t>(row)]);
  }
  mesh = std::move(kept);
  compact(*this);
}

LoadedMesh read_only(const Input& input, Console& console) {
  LoadedMesh loaded;
  loaded.path = input.path == "-" ? "stdin" : input.path;
  loaded.mesh = read_input(input, console);
  const MeshData& mesh = loaded.mesh;
  if (mesh.ambient_dimension > 0 && mesh.simplices.dimension() > mesh.ambient_dimension)
    throw Failure(
        Exit::unreadable, "input",
        text(loaded.path, ": simplices of dimension ", mesh.simplices.dimension(), " with positions in dimension ",
             mesh.ambient_dimension, "; a complex in space needs at least its own dimension"),
        loaded.path);
  loaded.file_tags = std::move(loaded.mesh.vertex_tags);
  loaded.mesh.vertex_tags.clear();
  if (loaded.mesh.lower_count() > 0)
    console.message(text(loaded.path, ": ", loaded.mesh.lower_count(),
                         " simplices of lower dimension are tags, not part of the complex"));
  return loaded;
}

void settle_unused(LoadedMesh& loaded, bool drop, Console& console) {
  const Index unused = first_unused_vertex(loaded.mesh);
  if (unused < 0) return;
  if (!drop) {
    const Index one[] = {unused};
    const std::string tags = loaded.tags_text(one);
    throw Failure(Exit::unreadable, "input",
                  text(loaded.path, ": vertex ", unused, tags.empty() ? "" : " (" + tags + ")",
                       " is in no simplex; every vertex must be used. Give --drop-unused to leave such vertices out"),
                  loaded.path);
  }
  const std::size_t notes = loaded.mesh.notes.size();
  console.message(text(loaded.path, ": dropped ", compact(loaded), " unused vertices"));
  for (std::size_t i = notes; i < loaded.mesh.notes.size(); ++i)
    console.message(loaded.path + ": " + loaded.mesh.notes[i]);
}

Reordering reorder(MeshData& mesh, const std::string& path, Console& console) {
  console.stage("reordering");
  const bool has_positions = mesh.has_points() || mesh.has_corners();
  Reordering result{has_positions ? "Hilbert" : "reverse Cuthill-McKee", vertex_gaps(mesh.simplices).mean, 0};
  renumber(mesh, has_positions ? hilbert_order(mesh) : reverse_cuthill_mckee(mesh.simplices, mesh.vertex_count));
  result.gap_after = vertex_gaps(mesh.simplices).mean;
  console.clear_stage();
  console.message(text(path, ": reordered (", result.method, "): vertices of a simplex differ by ", result.gap_after,
                       " on average, before by ", result.gap_before));
  return result;
}

void reorder_if_asked(LoadedMesh& loaded, const Input& input, Console& console) {
  if (!input.reorder || loaded.mesh.simplices.empty()) return;
  loaded.mesh.vertex_tags = loaded.file_vertex;
  reorder(loaded.mesh, loaded.path, console);
  loaded.file_vertex = std::move(loaded.mesh.vertex_tags);
  loaded.mesh.vertex_tags.clear();
}

LoadedMesh load_mesh(const Input& input, Console& console) {
  LoadedMesh loaded = read_only(input, console);
  settle_unused(loaded, input.drop_unused, console);
  reorder_if_asked(loaded, input, console);
  return loaded;
}

template <int n>
SimplicialComplex<n> build_complex(const LoadedMesh& loaded) {
  if (loaded.mesh.simplices.empty()) return SimplicialComplex<n>();
  try {
    return SimplicialComplex<n>(loaded.mesh.simplices, loaded.mesh.vertex_count);
  } catch (const InputError& error) {
    const std::string where = error.row() >= 0 ? loaded.row_text(error.row()) : std::string();
    throw Failure(Exit::unreadable, "input", loaded.path + ": " + error.what() + where, loaded.path);
  }
}

template SimplicialComplex<0> build_complex(const LoadedMesh&);
template SimplicialComplex<1> build_complex(const LoadedMesh&);
template SimplicialComplex<2> build_complex(const LoadedMesh&);
template SimplicialComplex<3> build_complex(const LoadedMesh&);
template SimplicialComplex<4> build_complex(const LoadedMesh&);
template SimplicialComplex<5> build_complex(const LoadedMesh&);
template SimplicialComplex<6> build_complex(const LoadedMesh&);

}  // namespace derham::cli
