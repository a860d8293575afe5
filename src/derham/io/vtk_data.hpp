#pragma once

#include "derham/geometry/mesh_data.hpp"
#include "derham/io/vtk_input.hpp"

// The data of a legacy VTK file. Not installed.
namespace derham {

/// Behind the line POINT_DATA or CELL_DATA: makes its arrays, of `items` values each, fields of `mesh`.
void read_vtk_data(VtkInput& input, MeshField::On on, Offset items, MeshData& mesh);

/// Behind the word FIELD, where it belongs to the whole data set: its arrays are dropped, with a note.
void skip_vtk_field_data(VtkInput& input, MeshData& mesh);

}  // namespace derham
