#pragma once

#include "derham/complex/refinement.hpp"
#include "derham/geometry/mesh_data.hpp"

namespace derham {

/// The mesh of refinement.fine(), for a mesh whose rows the coarse complex was built from. New vertices are the midpoints
/// of their edges; pieces of a row stay together, in the order of the rows, and are oriented as the complex.
///
/// Carried  positions or corners, squared edge lengths; parts, with the listed simplices of lower dimension cut in the
///          same way and oriented as they were; fields on vertices (the mean of the ends) and on rows (the same number)
/// Left     vertex and row tags; forms (`prolongation` brings them along), which a note says
/// Law      every piece of a flat row has 2^-n of its volume
/// Throws   InputError unless the coarse complex can be that of the rows, or if a listed simplex is not in it
template <int n>
[[nodiscard]] MeshData refined_mesh(const MeshData& mesh, const Refinement<n>& refinement);

/// The mesh alone, once refined.
/// Throws   as above; InputError unless all rows have the same dimension, 1 to 4, and make a complex
[[nodiscard]] MeshData refined_mesh(const MeshData& mesh);

}  // namespace derham
