#pragma once

#include "derham/geometry/mesh_data.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

namespace derham::meshes {

/// A set of unit cubes of a grid.
struct VoxelSet {
  std::vector<Index> shape;          ///< cubes along each axis, 1 to 6 axes
  std::vector<std::uint8_t> filled;  ///< (shape[0]·shape[1]·…,) axis 0 fastest; non-zero: the cube is in the set
};

/// A set written as a full box and then boxes taken away or put back, from left to right:
///   spec = shape { ("-" | "+") cells }     shape = count { "x" count }      cells = range { "," range }
///   range = number | number ":" number     (0-based, both ends included; one range per axis)
/// "3x3x1-1,1,0" is a square ring; "5x5x3-1:3,1:3,1+2,2,1" a box with a ring-shaped hole inside.
/// Throws   InputError naming the place in `spec` and what was expected there; LimitError
[[nodiscard]] VoxelSet parse_voxels(std::string_view spec);

/// The filled cubes, each cut into n! simplices along its main diagonal, positively oriented. Only vertices of filled
/// cubes are numbered, axis 0 fastest. Cubes that meet in an edge or a vertex only make a mesh that is no manifold.
/// Throws   InputError if the sizes of shape and filled disagree or no cube is filled; LimitError
[[nodiscard]] MeshData voxels(const VoxelSet& set);
[[nodiscard]] inline MeshData voxels(std::string_view spec) { return voxels(parse_voxels(spec)); }

}  // namespace derham::meshes
