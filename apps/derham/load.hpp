#pragma once

#include "cli.hpp"

#include "derham/complex/simplicial_complex.hpp"
#include "derham/complex/validation.hpp"
#include "derham/geometry/mesh_data.hpp"
#include "derham/io/mesh_format.hpp"
#include "derham/io/options.hpp"

#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace derham::cli {

/// How a mesh on the command line is read.
struct Input {
  std::string path;
  std::string format;  // empty: detected
  bool drop_unused = false;
  bool reorder = false;
  ReadOptions options;
};

/// The format of that name, none for the empty one. Anything else is refused with Exit::usage, `formats` listing those
/// that would do.
[[nodiscard]] std::optional<MeshFormat> named_format(const std::string& name, const std::string& formats);

/// The mesh as the file has it. What the reader notes goes to the console.
[[nodiscard]] MeshData read_input(const Input& input, Console& console);

/// What `reorder` did: the mean difference of the highest and the lowest vertex of a row, before and after.
struct Reordering {
  std::string method;
  double gap_before = 0, gap_after = 0;
};

/// Renumbers the mesh along a Hilbert curve, or by reverse Cuthill-McKee if it has no positions, and says so on the console.
Reordering reorder(MeshData& mesh, const std::string& path, Console& console);

/// A mesh and the way back from its vertices to the file.
struct LoadedMesh {
  MeshData mesh;
  std::string path;
  std::vector<std::int64_t> file_vertex;  // 0-based position in the file of each vertex; empty: the same
  std::vector<std::int64_t> file_tags;    // the file's own number of each position; empty: the same

  [[nodiscard]] std::int64_t position(Index v) const {
    return file_vertex.empty() ? std::int64_t{v} : file_vertex[static_cast<std::size_t>(v)];
  }
  /// "file numbers 7, 9" of a simplex, or nothing if the file counts from 0.
  [[nodiscard]] std::string tags_text(std::span<const Index> simplex) const;

  /// The file's own number of a row, as " (simplex 17 in the file)", or nothing if the file counts from 0.
  [[nodiscard]] std::string row_text(Offset row) const;

  /// Removes rows (increasing) and the vertices that are then unused.
  void remove_rows(std::span<const Offset> rows);
};

/// Reads the mesh. Unused vertices are refused with Exit::unreadable unless dropped (and counted on the console). Reordered
/// if that is asked for.
[[nodiscard]] LoadedMesh load_mesh(const Input& input, Console& console);

/// The three steps of load_mesh.
[[nodiscard]] LoadedMesh read_only(const Input& input, Console& console);
void settle_unused(LoadedMesh& loaded, bool drop, Console& console);
void reorder_if_asked(LoadedMesh& loaded, const Input& input, Console& console);

/// The complex of a loaded mesh. Bad rows are refused with Exit::unreadable.
template <int n>
[[nodiscard]] SimplicialComplex<n> build_complex(const LoadedMesh& loaded);

/// Calls action(std::integral_constant<int, n>) for the dimension of the mesh; the empty mesh counts as n = 0.
template <class Action>
auto with_dimension(const LoadedMesh& loaded, Action&& action) {
  switch (loaded.mesh.simplices.dimension()) {
    case -1:
    case 0:
      return action(std::integral_constant<int, 0>());
    case 1:
      return action(std::integral_constant<int, 1>());
    case 2:
      return action(std::integral_constant<int, 2>());
    case 3:
      return action(std::integral_constant<int, 3>());
    case 4:
      return action(std::integral_constant<int, 4>());
    case 5:
      return action(std::integral_constant<int, 5>());
    case 6:
      return action(std::integral_constant<int, 6>());
    default:
      throw Failure(
          Exit::unreadable, "input",
          "the mesh has dimension " + std::to_string(loaded.mesh.simplices.dimension()) + "; at most 6 is supported",
          loaded.path);
  }
}

}  // namespace derham::cli
