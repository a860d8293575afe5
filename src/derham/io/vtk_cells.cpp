#include "derham/io/vtk_cells.hpp"

#include "derham/core/text.hpp"
#include "derham/io/listed_simplices.hpp"
#include "derham/io/read_hints.hpp"
#include "derham/io/unused_vertices.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

namespace derham {
namespace {

// The dimension of the simplex whose corners are the first points of a cell of this type, -1 if it is none.
int simplex_degree(int type) noexcept {
  switch (type) {
    case 1:  // vertex, poly-vertex of one
    case 2:
      return 0;
    case 3:  // line, poly-line of one; quadratic, Lagrange, Bézier
    case 4:
    case 21:
    case 68:
    case 75:
      return 1;
    case 5:  // triangle, triangle strip of one, polygon; quadratic, Lagrange, Bézier
    case 6:
    case 7:
    case 22:
    case 34:
    case 69:
    case 76:
      return 2;
    case 10:
    case 24:
    case 71:
    case 78:
      return 3;
    default:
      return -1;
  }
}

bool is_higher_order(int type) noexcept { return type >= 21; }
bool is_polygon(int type) noexcept { return type == 7 || type == 8 || type == 9; }

const char* cell_name(int type) noexcept {
  constexpr std::array names{"an empty cell",
                             "a vertex",
                             "a set of vertices",
                             "a line",
                             "a poly-line",
                             "a triangle",
                             "a strip of triangles",
                             "a polygon",
                             "a pixel",
                             "a quadrilateral",
                             "a tetrahedron",
                             "a voxel",
                             "a hexahedron",
                             "a wedge",
                             "a pyramid",
                             "a pentagonal prism",
                             "a hexagonal prism"};
  if (type < static_cast<int>(names.size())) return names[static_cast<std::size_t>(type)];
  if (type == 42) return "a polyhedron";
  return "a cell of higher order";
}

// Of the fields on rows, which have a value for every cell, keeps those of the cells that are rows.
void keep_rows(MeshData& mesh, std::span<const Index> cell_of_row, Offset cells) {
  std::vector<char> is_row(static_cast<std::size_t>(cells), 0);
  for (const Index cell : cell_of_row) is_row[static_cast<std::size_t>(cell)] = 1;
  for (auto& field : mesh.fields) {
    if (field.on != MeshField::On::rows) continue;
    const auto width = static_cast<std::size_t>(field.components);
    std::vector<double> kept;
    kept.reserve(cell_of_row.size() * width);
    for (const Index cell : cell_of_row) {
      const auto first = field.values.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(cell) * width);
      kept.insert(kept.end(), first, first + field.components);
    }
    Offset lost = 0;
    for (std::size_t i = 0; i < is_row.size(); ++i)
      for (std::size_t c = 0; c < width && !is_row[i]; ++c) lost += !std::isnan(field.values[i * width + c]);
    if (lost > 0)
      mesh.notes.push_back(
          text("field ", quoted_token(field.name), ": ", lost, " values on cells of lower dimension are not kept"));
    field.values = std::move(kept);
  }
}

}  // namespace

void VtkCells::move_to(MeshData& mesh, const ReadOptions& options, Cursor& file) && {
  // The usual case: nothing but simplices of one dimension, whose ids are the rows already.
  const bool is_uniform = ends_.empty() && types_.empty() && count_ > 0 && width_ <= 4 &&
                          type_ == vtk_cell_types[static_cast<std::size_t>(width_) - 1];
  if (is_uniform) {
    mesh.simplices = SimplexList(static_cast<int>(width_) - 1, std::move(ids));
    return;
  }

  ListedSimplices list;
  std::array<std::vector<Index>, 4> cell_of;
  Offset split = 0, triangles = 0, cut = 0;
  for (Offset i = 0; i < count_; ++i) {
    const auto points = cell(i);
    const int type = this->type(i);
    const auto refuse = [&](const char* expected) {
      file.fail(text("cell ", i, " (counted from 0) is ", cell_name(type), " of ", points.size(), " points, VTK type ",
                     type, "; ", expected));
    };
    const auto add = [&](std::span<const Index> row) {
      list.add(row);
      cell_of[row.size() - 1].push_back(static_cast<Index>(i));
    };
    if (is_polygon(type) && points.size() > 3 && (type == 7 || points.size() == 4)) {
      if (!options.triangulate)
        refuse(text("expected simplices: split the mesh first, or have it ", split_on_reading).c_str());
      // A pixel has its points row by row, not around.
      const std::array<Index, 4> around{points[0], points[1], points[3], points[2]};
      const auto polygon = type == 8 ? std::span<const Index>(around) : points;
      for (std::size_t v = 2; v < polygon.size(); ++v) add(std::array{polygon[0], polygon[v - 1], polygon[v]});
      ++split;
      triangles += static_cast<Offset>(points.size()) - 2;
      continue;
    }
    const int degree = simplex_degree(type);
    const auto width = static_cast<std::size_t>(degree + 1);
    if (degree < 0) refuse("expected vertices, lines, triangles or tetrahedra");
    if (is_higher_order(type) && points.size() >= width) {
      if (!options.corner_nodes) refuse(text("expected simplices of first order, or ", keep_corner_nodes).c_str());
      add(points.first(width));
      ++cut;
      continue;
    }
    if (points.size() != width) refuse(text("expected ", width, " points").c_str());
    add(points);
  }
  if (split > 0) mesh.notes.push_back(text("split ", split, " polygons into ", triangles, " triangles"));

  std::move(list).move_to(mesh);
  const int top = mesh.simplices.dimension();
  const std::vector<Index> none;
  const auto& cell_of_row = top < 0 ? none : cell_of[static_cast<std::size_t>(top)];
  if (static_cast<Offset>(cell_of_row.size()) != count_ || split > 0) keep_rows(mesh, cell_of_row, count_);
  drop_mid_nodes(mesh, cut, "cells");
}

}  // namespace derham
