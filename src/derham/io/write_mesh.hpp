#pragma once

#include "derham/geometry/mesh_data.hpp"
#include "derham/io/mesh_format.hpp"
#include "derham/io/options.hpp"

#include <string>
#include <vector>

namespace derham {

/// Writes `mesh` to `path` ("-": standard output) in the given format. Files appear complete or not at all
/// (AtomicFile); doubles are written so that they read back to the same bits. Vertices and rows are numbered afresh in
/// their order.
///
/// tetgen   both NAME.node and NAME.ele, whichever `path` names (a `path` of neither kind is NAME itself);
///          triangles with m = 2 or 3, tetrahedra with m = 3. NAME.face and NAME.edge if `lower` has faces or edges; if
///          not, those of an older mesh are removed, lest they be read with this one. Files cannot be replaced together:
///          once all are complete, the old NAME.ele is removed and the new one appears last. A process killed in between
///          leaves no mesh (a .node without its .ele is refused), never old files beside new ones. Parts are markers (of
///          the rows: an attribute, if there are no fields on rows), as for medit; fields are attributes. To standard
///          output only nodes and simplices
/// gmsh     dimension n <= 3; m <= 3, padded with zeros to 3; text unless `encoding` is binary (in this machine's byte
///          order), 2.2 unless `gmsh_41`. Row i is element i+1; lower simplices, parts and fields follow, a vertex in a
///          part as a point. Parts whose number is not from 1 to 2^31-1 get the next free one. Names are written as they
///          are; the programs of others may end a name at a quote within it. A name with control characters or more than 127
///          bytes is left out of its part, and so are whole fields of such a name, with values that are not finite or with
///          more than 9 components (`not_carried` names them); the others are padded with zeros to 1, 3 or 9. A simplex in
///          several parts is listed once for each in 2.2; in 4.1 it is not, but there may not be thousands of parts on many
///          of them (InputError).
/// medit    n = 1 to 3; m <= 3 (padded to 2); parts as references: the number of the first part a simplex is in
/// off, obj n <= 2
/// ply      n <= 2; doubles, binary unless asked otherwise; fields are properties, one per component, whose
///          names are one word and distinct (`not_carried` says what becomes of others)
/// stl      n = 2; binary unless asked otherwise: then positions are rounded to 32-bit numbers (`not_carried` says so).
///          Reading it back numbers the vertices afresh and makes one of those at the same place; vertices that no
///          triangle uses are not in the file (`not_carried` counts both)
/// vtk      n <= 3; text, or bytes if asked for. `lower` follows the rows, with NaN in fields on rows (as text only new
///          VTK reads it, 9.7 does); fields become arrays of doubles; parts, for which VTK has no word, are not written
/// vtu      as vtk, but bytes unless text is asked for (then arrays with NaN are in base64: VTK reads none as text); also
///          periodic meshes, one point per corner
/// facets   everything, positions are dropped
/// npz      everything but simplices of several dimensions, without loss (read_mesh.hpp names the arrays): stored, not
///          compressed, in this machine's types and order of bytes, every array at a multiple of 64 bytes
/// Throws   InputError if the format cannot hold the mesh or the mesh is unsound (ids outside [0, vertex_count), wrong
///          number of positions, two fields of one name on the vertices or on the rows where the format holds fields);
///          FileError if the file cannot be written
void write_mesh(const std::string& path, const MeshData& mesh, MeshFormat format, const WriteOptions& options = {});

/// The files that `write_mesh` then leaves: `path`, or those of a TetGen mesh.
[[nodiscard]] std::vector<std::string> written_files(const std::string& path, const MeshData& mesh, MeshFormat format);

/// What of `mesh` a file of this format cannot hold though it can hold the mesh, one sentence each: parts, fields, …. All
/// that is not named there comes back when the file is read (but for notes, the order of parts and of fields, and
/// numbers of vertices or rows that only count from 0 or 1).
[[nodiscard]] std::vector<std::string> not_carried(const MeshData& mesh, MeshFormat format,
                                                   const WriteOptions& options = {});

/// As `write_mesh`, in the format that the extension of `path` names. Throws InputError if it names none.
void write_mesh(const std::string& path, const MeshData& mesh);

}  // namespace derham
