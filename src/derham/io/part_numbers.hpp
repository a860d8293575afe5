#pragma once

#include "derham/geometry/mesh_data.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace derham {

/// For formats that give every simplex one number (a reference, a marker): the number of the part of `degree` that each
/// of the `count` simplices is in, of the first one where there are several; 0: in none. Empty if there is no such part.
/// Throws   InputError if a member is outside [0, count)
[[nodiscard]] std::vector<std::int64_t> part_numbers(const MeshData& mesh, int degree, Offset count);

/// How many simplices (vertices, for degree 0) are in more than one part.
[[nodiscard]] Offset simplices_in_several_parts(const MeshData& mesh);

/// What such numbers do not carry of a mesh, one phrase each: names of parts, parts that overlap, parts numbered 0 or
/// without members, and simplices of dimension 0, which stand nowhere in these formats.
[[nodiscard]] std::vector<std::string> lost_in_part_numbers(const MeshData& mesh);

}  // namespace derham
