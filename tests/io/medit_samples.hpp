#pragma once

#include <string_view>

namespace derham::io_test {

inline constexpr std::string_view medit_sample =
    "MeshVersionFormatted 2\nDimension\n3\n# two tetrahedra\nVertices 5\n"
    "0 0 0 0\n1 0 0 3\n0 1 0 3\n0 0 1 0\n1 1 1 -2\n"
    "Corners\n2\n1 5\nNormals 1\n0 0 1.5\nSubDomainFromMesh 1\n4 1 1 2\n"
    "Triangles\n2\n1 2 3 7\n2 3 4 0\nEdges\n1\n1 2 4\nQuadrilaterals\n0\n"
    "Tetrahedra\n2\n1 2 3 4 5\n2 3 4 5 9\nEnd\n";

}  // namespace derham::io_test
