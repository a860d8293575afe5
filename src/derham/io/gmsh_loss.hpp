#pragma once

#include "derham/geometry/mesh_data.hpp"

#include <string_view>

namespace derham {

/// Whether a .msh file holds the name of a part or a field: without control characters, at most 127 bytes.
[[nodiscard]] bool gmsh_holds_name(std::string_view name);

/// Whether a .msh file holds the field: a name it holds, up to 9 components, finite values. Others are left out.
[[nodiscard]] bool gmsh_holds_field(const MeshField& field);

/// To how many components a field of so many (1 to 9) is padded with zeros: Gmsh knows 1, 3 and 9.
[[nodiscard]] int gmsh_components(int components) noexcept;

}  // namespace derham
