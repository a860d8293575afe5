#pragma once

#include <cstdint>

namespace derham {

/// What a reader may do beyond taking the file as it is. By default it does nothing of the kind.
struct ReadOptions {
  /// Split polygons into triangles (a fan about the first vertex); otherwise they are refused.
  bool triangulate = false;
  /// Of elements of higher order keep the corner nodes; otherwise they are refused.
  bool corner_nodes = false;
  /// Read a mesh whose third coordinates are all zero as a mesh in the plane, ambient dimension 2.
  bool planar = false;
};

/// How a writer writes, where the format leaves a choice.
struct WriteOptions {
  /// Numbers as text or as bytes. By default what the format is mostly used with: bytes for vtu, ply, stl, npz.
  enum class Encoding : std::uint8_t { usual, ascii, binary };
  Encoding encoding = Encoding::usual;
  /// Gmsh 4.1 instead of 2.2.
  bool gmsh_41 = false;
};

}  // namespace derham
