#pragma once

#include "derham/io/formats.hpp"

#include <optional>
#include <string_view>

namespace derham::io_test {

using namespace std::string_view_literals;

/// Reads `bytes` as the .face and, behind the first zero byte, the .edge file beside sound nodes and simplices: two
/// tetrahedra on five nodes, or with `corner_nodes` a quadratic one. Without a zero byte there is no .edge file.
inline MeshData read_tetgen_faces(std::string_view bytes, const ReadOptions& options = {}) {
  constexpr auto linear_nodes = "5 3 0 1\n1 0 0 0 1\n2 1 0 0 0\n3 0 1 0 1\n4 0 0 1 1\n5 1 1 1 1\n"sv;
  constexpr auto linear_simplices = "2 4 0\n1 1 2 3 4\n2 2 3 4 5\n"sv;
  constexpr auto quadratic_nodes =
      "10 3\n1 0 0 0\n2 2 0 0\n3 0 2 0\n4 0 0 2\n5 1 0 0\n6 0 1 0\n7 0 0 1\n8 1 1 0\n9 1 0 1\n10 0 1 1\n"sv;
  constexpr auto quadratic_simplices = "1 10\n1 1 2 3 4 5 6 7 8 9 10\n"sv;
  const bool is_quadratic = options.corner_nodes;
  Cursor nodes(is_quadratic ? quadratic_nodes : linear_nodes, "mesh.node", '#');
  Cursor simplices(is_quadratic ? quadratic_simplices : linear_simplices, "mesh.ele", '#');

  const auto zero = bytes.find('\0');
  Cursor faces(bytes.substr(0, zero), "mesh.face", '#');
  std::optional<Cursor> edges;
  if (zero != std::string_view::npos) edges.emplace(bytes.substr(zero + 1), "mesh.edge", '#');
  return read_tetgen({nodes, simplices, &faces, edges ? &*edges : nullptr}, options);
}

inline constexpr auto tetgen_faces_sample =
    "# faces\n4 1\n1 1 2 3 5\n2 2 3 4 -7\n3 5 4 3 0\n4 2 4 5 5\n\0"
    "3 1\n1 1 2 8\n2 4 5 0\n3 3 1 8\n"sv;

/// With the nodes in the middle, and the tetrahedra beside a face and an edge.
inline constexpr auto tetgen_quadratic_faces_sample =
    "2 1\n1 1 2 3 5 8 6 4 1 -1\n2 4 3 2 10 8 9 0 -1 1\n\0"
    "2 0\n1 1 2 5 1\n2 4 3 9 1\n"sv;

}  // namespace derham::io_test
