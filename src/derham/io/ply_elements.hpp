#pragma once

#include "derham/geometry/mesh_data.hpp"
#include "derham/io/listed_simplices.hpp"
#include "derham/io/options.hpp"
#include "derham/io/ply_numbers.hpp"
#include "derham/io/polygons.hpp"

#include <cstddef>
#include <string_view>
#include <vector>

// The elements of a PLY file that make a mesh. Not installed.
namespace derham::ply {

/// Positions, and fields from all other scalar properties.
void read_vertices(Numbers& numbers, const Element& element, MeshData& mesh);

/// Numbers on faces as they come; which of them are on rows shows only when all faces are known.
struct FaceFields {
  std::vector<MeshField> fields;  ///< one value per face
  std::vector<std::size_t> widths;

  /// Makes them fields of `mesh`, which has its rows already.
  void move_to(MeshData& mesh) &&;
};

/// Simplices into `rows`. The notes of `mesh` say which properties are skipped.
[[nodiscard]] FaceFields read_faces(Numbers& numbers, const Element& element, Polygons& polygons,
                                    const ReadOptions& options, ListedSimplices& rows, MeshData& mesh);
void read_edges(Numbers& numbers, const Element& element, ListedSimplices& rows, MeshData& mesh);

/// Says in the notes that a property (a list, if it is one) of `what` is skipped.
void note_skipped(const Property& property, std::string_view what, MeshData& mesh);

}  // namespace derham::ply
