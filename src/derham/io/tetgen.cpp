#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/formats.hpp"

#include <limits>
#include <numeric>
#include <utility>

namespace derham {
namespace {

constexpr auto any = std::numeric_limits<std::int64_t>::max();

// Moves to record `i` of `count`.
void next_record(Cursor& file, const char* what, Index i, Index count) {
  if (!file.next_line()) file.fail(text("the file ends after ", i, " of ", count, " ", what));
}

// The number at the start of record i: the first is 0 or 1 and says so for all.
void take_number(Cursor& file, const char* what, Index i, std::int64_t& base) {
  base = i == 0 ? file.integer(what, 0, 1) : base;
  if (i > 0) file.integer(what, base + i, base + i);
}

}  // namespace

TetgenPaths tetgen_paths(const std::string& path) {
  const auto stem = path.ends_with(".node") || path.ends_with(".ele") ? path.substr(0, path.find_last_of('.')) : path;
  return {stem + ".node", stem + ".ele"};
}

MeshData read_tetgen(Cursor& nodes, Cursor& simplices) {
  MeshData mesh;
  std::int64_t base = 0;

  if (!nodes.next_line()) nodes.fail_token("the number of nodes", nullptr);
  mesh.vertex_count = nodes.count("the number of nodes", 6);
  mesh.ambient_dimension = static_cast<int>(nodes.integer("the dimension", 2, 3));
  const auto attributes = nodes.at_line_end() ? 0 : nodes.integer("the number of attributes", 0, any);
  const auto markers = nodes.at_line_end() ? 0 : nodes.integer("the number of boundary markers", 0, 1);
  nodes.end_line();
  mesh.points.reserve(static_cast<std::size_t>(mesh.vertex_count) * static_cast<std::size_t>(mesh.ambient_dimension));
  for (Index i = 0; i < mesh.vertex_count; ++i) {
    next_record(nodes, "nodes", i, mesh.vertex_count);
    take_number(nodes, "the node number", i, base);
    for (int axis = 0; axis < mesh.ambient_dimension; ++axis) mesh.points.push_back(nodes.real("a coordinate"));
    for (std::int64_t a = 0; a < attributes; ++a) (void)nodes.real("an attribute");
    if (markers == 1) (void)nodes.integer("a boundary marker");
    nodes.end_line();
  }
  if (&nodes != &simplices) nodes.end_file();
  if (base == 1) {
    mesh.vertex_tags.resize(static_cast<std::size_t>(mesh.vertex_count));
    std::iota(mesh.vertex_tags.begin(), mesh.vertex_tags.end(), 1);
  }

  if (!simplices.next_line()) simplices.fail_token("the number of simplices", nullptr);
  const Index rows = simplices.count("the number of simplices", 8);
  const auto width = simplices.integer("the number of nodes per simplex");
  if (width == 6 || width == 10)
    simplices.fail(text(width, " nodes per simplex are quadratic ", width == 6 ? "triangles" : "tetrahedra",
                        "; expected ", width == 6 ? 3 : 4, ": make the mesh without second-order nodes (no -o2)"));
  if (width < 3 || width > mesh.ambient_dimension + 1)
    simplices.fail(text(width, " nodes per simplex, expected 3", mesh.ambient_dimension == 3 ? " or 4" : "",
                        " in dimension ", mesh.ambient_dimension));
  const auto row_attributes = simplices.at_line_end() ? 0 : simplices.integer("the number of attributes", 0, any);
  simplices.end_line();
  std::int64_t row_base = 0;
  std::vector<Index> ids;
  ids.reserve(static_cast<std::size_t>(rows) * static_cast<std::size_t>(width));
  for (Index i = 0; i < rows; ++i) {
    next_record(simplices, "simplices", i, rows);
    take_number(simplices, "the number of the simplex", i, row_base);
    for (std::int64_t v = 0; v < width; ++v)
      ids.push_back(static_cast<Index>(simplices.integer("a node number", base, base + mesh.vertex_count - 1) - base));
    for (std::int64_t a = 0; a < row_attributes; ++a) (void)simplices.real("an attribute");
    simplices.end_line();
  }
  simplices.end_file();
  mesh.simplices = SimplexList(static_cast<int>(width) - 1, std::move(ids));
  if (row_base == 1) {
    mesh.row_tags.resize(static_cast<std::size_t>(rows));
    std::iota(mesh.row_tags.begin(), mesh.row_tags.end(), 1);
  }
  return mesh;
}

void write_tetgen(TextWriter& nodes, TextWriter& simplices, const MeshData& mesh) {
  const int m = mesh.ambient_dimension;
  nodes.put(mesh.vertex_count).put(' ').put(m).put(" 0 0\n");
  for (Index i = 0; i < mesh.vertex_count; ++i) {
    nodes.put(i);
    for (int axis = 0; axis < m; ++axis)
      nodes.put(' ').put(
          mesh.points[static_cast<std::size_t>(i) * static_cast<std::size_t>(m) + static_cast<std::size_t>(axis)]);
    nodes.put('\n');
  }
  simplices.put(mesh.simplices.size())
      .put(' ')
      .put((mesh.simplices.empty() ? m : mesh.simplices.dimension()) + 1)
      .put(" 0\n");
  for (Offset i = 0; i < mesh.simplices.size(); ++i) {
    simplices.put(i);
    for (const Index v : mesh.simplices[i]) simplices.put(' ').put(v);
    simplices.put('\n');
  }
}

}  // namespace derham
