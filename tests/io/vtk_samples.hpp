#pragma once

#include <string_view>

namespace derham::io_test {

using namespace std::string_view_literals;

// clang-format off
// Two tetrahedra and a triangle on five points; in VTK legacy files bytes stand highest first.
inline constexpr std::string_view vtk_ascii_51_sample =
    "# vtk DataFile Version 5.1\n"
    "two tetrahedra\n"
    "ASCII\n"
    "DATASET UNSTRUCTURED_GRID\n"
    "FIELD FieldData 1\n"
    "TIME 1 1 double\n"
    "0.5\n"
    "POINTS 5 float\n"
    "0 0 0 1 0 0 0 1 0\n"
    "0 0 1 1 1 1\n"
    "METADATA\n"
    "INFORMATION 1\n"
    "NAME L2_NORM_RANGE LOCATION vtkDataArray\n"
    "DATA 2 0 1.7\n"
    "\n"
    "CELLS 4 11\n"
    "OFFSETS vtktypeint64\n"
    "0 4 8 11\n"
    "CONNECTIVITY vtktypeint64\n"
    "0 1 2 3 1 2 3 4 0 1 2\n"
    "CELL_TYPES 3\n"
    "10 10 5\n"
    "POINT_DATA 5\n"
    "SCALARS u double 1\n"
    "LOOKUP_TABLE default\n"
    "0 1 2 nan 4\n"
    "VECTORS w%20v float\n"
    "1 0 0 2 0 0 3 0 0 4 0 0 5 0 0\n"
    "CELL_DATA 3\n"
    "FIELD FieldData 1\n"
    "r 2 3 int\n"
    "1 2 3 4 5 6\n"sv;

inline constexpr std::string_view vtk_ascii_30_sample =
    "# vtk DataFile Version 3.0\n"
    "two tetrahedra\n"
    "ASCII\n"
    "DATASET UNSTRUCTURED_GRID\n"
    "POINTS 5 double\n"
    "0 0 0 1 0 0 0 1 0 0 0 1 1 1 1\n"
    "CELLS 3 14\n"
    "4 0 1 2 3\n"
    "4 1 2 3 4\n"
    "3 0 1 2\n"
    "CELL_TYPES 3\n"
    "10 10 5\n"sv;

inline constexpr std::string_view vtk_binary_30_sample =
    "# vtk DataFile Version 3.0\n"
    "two tetrahedra\n"
    "BINARY\n"
    "DATASET UNSTRUCTURED_GRID\n"
    "POINTS 5 double\n"
    "\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000?\360"
    "\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000"
    "\000\000\000\000\000?\360\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000"
    "\000\000\000\000\000\000\000\000\000\000\000?\360\000\000\000\000\000\000?\360\000\000\000\000\000\000"
    "?\360\000\000\000\000\000\000?\360\000\000\000\000\000\000\n"
    "CELLS 3 14\n"
    "\000\000\000\004\000\000\000\000\000\000\000\001\000\000\000\002\000\000\000\003\000\000\000\004\000"
    "\000\000\001\000\000\000\002\000\000\000\003\000\000\000\004\000\000\000\003\000\000\000\000\000\000"
    "\000\001\000\000\000\002\n"
    "CELL_TYPES 3\n"
    "\000\000\000\n"
    "\000\000\000\n"
    "\000\000\000\005\n"
    "POINT_DATA 5\n"
    "SCALARS u float\n"
    "LOOKUP_TABLE default\n"
    "\000\000\000\000?\200\000\000@\000\000\000\177\300\000\000@\200\000\000\n"
    "CELL_DATA 3\n"
    "FIELD FieldData 1\n"
    "r 2 3 vtktypeint64\n"
    "\000\000\000\000\000\000\000\001\000\000\000\000\000\000\000\002\000\000\000\000\000\000\000\003\000"
    "\000\000\000\000\000\000\004\000\000\000\000\000\000\000\005\000\000\000\000\000\000\000\006\n"sv;

inline constexpr std::string_view vtk_binary_51_sample =
    "# vtk DataFile Version 5.1\n"
    "two tetrahedra\n"
    "BINARY\n"
    "DATASET UNSTRUCTURED_GRID\n"
    "POINTS 5 float\n"
    "\000\000\000\000\000\000\000\000\000\000\000\000?\200\000\000\000\000\000\000\000\000\000\000\000\000"
    "\000\000?\200\000\000\000\000\000\000\000\000\000\000\000\000\000\000?\200\000\000?\200\000\000?\200"
    "\000\000?\200\000\000\n"
    "CELLS 4 11\n"
    "OFFSETS vtktypeint64\n"
    "\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\004\000\000\000\000\000\000\000\010\000"
    "\000\000\000\000\000\000\013\n"
    "CONNECTIVITY vtktypeint64\n"
    "\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\001\000\000\000\000\000\000\000\002\000"
    "\000\000\000\000\000\000\003\000\000\000\000\000\000\000\001\000\000\000\000\000\000\000\002\000\000"
    "\000\000\000\000\000\003\000\000\000\000\000\000\000\004\000\000\000\000\000\000\000\000\000\000\000"
    "\000\000\000\000\001\000\000\000\000\000\000\000\002\n"
    "CELL_TYPES 3\n"
    "\000\000\000\n"
    "\000\000\000\n"
    "\000\000\000\005\n"sv;

inline constexpr std::string_view vtk_polydata_sample =
    "# vtk DataFile Version 2.0\n"
    "a triangle, a square, a line\n"
    "ASCII\n"
    "DATASET POLYDATA\n"
    "POINTS 4 int\n"
    "0 0 0 1 0 0 1 1 0 0 1 0\n"
    "LINES 1 3\n"
    "2 0 1\n"
    "POLYGONS 2 8\n"
    "3 0 1 2\n"
    "3 0 2 3\n"
    "CELL_DATA 3\n"
    "SCALARS c unsigned_char\n"
    "LOOKUP_TABLE mine\n"
    "1 2 3\n"
    "LOOKUP_TABLE mine 1\n"
    "0.5 0.5 0.5 1\n"sv;
// clang-format on

}  // namespace derham::io_test
