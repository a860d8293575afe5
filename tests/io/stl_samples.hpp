#pragma once

#include <string_view>

// A tetrahedron as four triangles.
namespace derham::io_test {

/// As text, in two solids.
inline constexpr std::string_view stl_ascii_sample{
    "solid lower part\n"
    "  facet normal 0 0 1e0\n"
    "    outer loop\n"
    "      vertex 0 0 0\n"
    "      vertex 0 1 0\n"
    "      vertex 1 0 0\n"
    "    endloop\n"
    "  endfacet\n"
    "  facet normal 0 0 1e0\n"
    "    outer loop\n"
    "      vertex 0 0 0\n"
    "      vertex 1 0 0\n"
    "      vertex 0 0 1\n"
    "    endloop\n"
    "  endfacet\n"
    "endsolid lower part\n"
    "solid upper\n"
    "  facet normal 0 0 1e0\n"
    "    outer loop\n"
    "      vertex 0 0 0\n"
    "      vertex 0 0 1\n"
    "      vertex 0 1 0\n"
    "    endloop\n"
    "  endfacet\n"
    "  facet normal 0 0 1e0\n"
    "    outer loop\n"
    "      vertex 1 0 0\n"
    "      vertex 0 1 0\n"
    "      vertex 0 0 1\n"
    "    endloop\n"
    "  endfacet\n"
    "endsolid\n",
    530};

/// As bytes; its header begins as a text file would.
inline constexpr std::string_view stl_binary_sample{
    "solid is what this file is called                                               \x04\x00\x00"
    "\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00"
    "\x00\x00\x00\x00\x00\x00\x00\x00\x80?\x00\x00\x00\x00\x00\x00\x80?\x00\x00\x00\x00\x00\x00\x00"
    "\x00M\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00"
    "\x00\x00\x00\x00\x00\x80?\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00"
    "\x00\x80?M\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00"
    "\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x80?\x00\x00\x00\x00\x00\x00\x80?\x00"
    "\x00\x00\x00M\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x80?\x00\x00\x00\x00"
    "\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x80?\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00"
    "\x00\x00\x80?M\x00",
    284};

}  // namespace derham::io_test
