#pragma once

#include "derham/geometry/mesh_data.hpp"
#include "derham/io/mesh_format.hpp"
#include "derham/io/options.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace derham {

/// The mesh in a file; `path` "-" is standard input. Without `format` it is detected (see `detect_format`).
///
/// tetgen   `path` is NAME.node or NAME.ele, the other is found beside it (NAME.NODE beside NAME.ELE), NAME.face and
///          NAME.edge where they exist (they become `lower`). Nodes are numbered from 0 or 1, as the first one says. Triangles (m = 2 or 3) or tetrahedra
///          (m = 3). Markers other than 0 become parts. Attributes become fields "attribute 1"…; but a single attribute
///          of the simplices whose values all are integers (of 64 bits; written as reals, of 53) is TetGen's region: parts, 0
///          being none. Simplices of 6 or 10 nodes see `corner_nodes` (as for gmsh). On standard input the .ele file
///          follows the .node file; faces and edges cannot.
/// gmsh     .msh 2.2 and 4.1, text and binary of either byte order, m = 3 also for planar meshes. Points, lines, triangles
///          and tetrahedra; quadrangles see `triangulate`: both triangles have the number, groups and data. Physical groups are parts (a negative number is that of the group), $NodeData and $ElementData
///          are fields; those without a value for every node or row are dropped and noted; of several time steps the last is
///          kept. An element that is
///          listed again (2.2 does so for every group it is in) is one simplex. Partitions are read as one mesh; sections
///          without a place in MeshData ($Periodic, $ElementNodeData, …) are skipped, with a note. Simplices of higher
///          order only with `corner_nodes`: then nodes that no simplex of the highest dimension uses are dropped. In 4.1 the
///          elements may be in 16 groups in all per byte of the file.
/// medit    .mesh, ASCII, m = 2 or 3: edges, triangles, tetrahedra, each in one section or in several; references other
///          than 0 become parts, also those of the vertices. Corners, ridges, normals and the like are skipped and noted;
///          quadrilaterals see `triangulate`, EdgesP2, TrianglesP2 and TetrahedraP2 `corner_nodes` (as for gmsh).
/// vtk      legacy, ASCII and binary, versions 1.0 to 5.1; UNSTRUCTURED_GRID and POLYDATA, m = 3. Vertices, lines,
///          triangles, tetrahedra; polygons and quadrilaterals see `triangulate`, cells of higher order `corner_nodes` (as
///          for gmsh). Arrays of numbers on points and cells become fields, integers that no double holds being rounded
///          and noted; where cells of several dimensions are mixed, those of the rows alone keep theirs. Arrays of bits
///          or strings and those of the whole data set are dropped and noted.
/// vtu      as vtk, one piece: numbers as text, base64 or appended (raw, base64), plain or compressed by zlib, either
///          byte order.
/// off      m = 3; faces of 1 to 3 vertices, with or without colours, which are skipped and noted; larger ones see
///          ReadOptions::triangulate, as in all surface formats.
/// obj      m = 3; p, l and f lines; texture coordinates, normals, groups, materials, colours and the like are skipped
///          and noted.
/// ply      m = 1 to 3, as there are x, y, z; ASCII and both byte orders. Elements vertex, face (vertex_indices or
///          vertex_index: 1 to 3 vertices) and edge, in any order; other scalar properties of vertices and faces are
///          fields, one each; all else is checked, skipped and noted.
/// stl      m = 3, ASCII and binary. Corners at exactly the same place (0 = -0) are one vertex, numbered as they first
///          appear, and the notes say so; triangles that become flat stay. Several solids are parts. Normals are skipped.
/// facets   m = 0 (abstract): one simplex of 1 to 7 vertex ids per line, dimensions may be mixed; no line: empty complex.
/// npz      arrays of numpy in a zip archive, stored or deflated, of any integer type, float64 or float32, either byte order
///          and either order of axes; integers may stand for real numbers where a double holds them. `simplices`
///          (rows, n+1); `points` (vertices, m), or for periodic meshes `corners` (rows, n+1, m), or neither: abstract;
///          `vertex_count` () where there are no points; `edge_lengths_squared` (edges,), none negative; `vertex_tags`,
///          `row_tags`; `lower_<k>` (count, k+1); `point_data_<name>` and `row_data_<name>` (items,) or (items,
///          components); `form_<name>_<degree>_<primal|dual>` (simplices,), the count checked for values on vertices and
///          on rows. Parts: `part_numbers`, `part_degrees`, `part_names` (P,), and `part_members`, of which part i has
///          those from part_offsets[i] up to part_offsets[i+1]. Other arrays are skipped and noted.
///
/// The simplices of the highest dimension in the file are the rows, in the file's order (facets: every line is a row);
/// `lower` and `parts` hold the others and what they name. `vertex_tags` and `row_tags` hold the numbers that the file
/// gives to vertices and rows, where they are not 0, 1, 2….
/// Fields of the same name are all kept, and noted: `write_mesh` wants distinct names.
/// Vertex ids are positions in the file and lie in [0, vertex_count); whether rows repeat or vertices are unused is not
/// checked here.
/// Throws   FileError (file, line, what was found, what was expected) for everything else that is wrong, among it wrong
///          counts, truncation, positions that are not finite, polygons and elements that are no simplices;
///          LimitError if the mesh overflows the index type or the file half of the memory
[[nodiscard]] MeshData read_mesh(const std::string& path, std::optional<MeshFormat> format = {},
                                 const ReadOptions& options = {});

/// As `read_mesh`, from bytes in memory; `name` stands for the file in messages. For tetgen the bytes of the .ele file
/// follow those of the .node file.
[[nodiscard]] MeshData read_mesh_from_memory(std::string_view bytes, MeshFormat format, const std::string& name,
                                             const ReadOptions& options = {});

/// Makes a mesh in space whose third coordinates are all zero one in the plane. False if it is no such mesh.
bool flatten_plane(MeshData& mesh);

}  // namespace derham
