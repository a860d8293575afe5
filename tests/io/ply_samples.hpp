#pragma once

#include <string_view>

// One mesh three times: a square of two triangles with an edge, scalar and list properties that are skipped, real ones
// that become fields, and an element of which derham knows nothing.
namespace derham::io_test {

/// As text.
inline constexpr std::string_view ply_ascii_sample{
    "ply\n"
    "format ascii 1.0\n"
    "comment two triangles\n"
    "element vertex 4\n"
    "property float x\n"
    "property double y\n"
    "property float32 z\n"
    "property uchar red\n"
    "property float quality\n"
    "element face 2\n"
    "property uchar flags\n"
    "property list uchar int vertex_indices\n"
    "property list uint8 float texcoord\n"
    "property double area\n"
    "element edge 1\n"
    "property int vertex1\n"
    "property int vertex2\n"
    "element material 1\n"
    "property list ushort short numbers\n"
    "end_header\n"
    "0 0 0 255 0.5\n"
    "1 0 0 0 -1\n"
    "1 1 0.25 7 2\n"
    "0 1.1 0 8 3\n"
    "1 3 0 1 2 1 0.5 0.5\n"
    "2 3 0 2 3 0 0.75\n"
    "0 2\n"
    "2 -1 300\n",
    509};

/// As bytes, the lowest first.
inline constexpr std::string_view ply_little_sample{
    "ply\n"
    "format binary_little_endian 1.0\n"
    "comment two triangles\n"
    "element vertex 4\n"
    "property float x\n"
    "property double y\n"
    "property float32 z\n"
    "property uchar red\n"
    "property float quality\n"
    "element face 2\n"
    "property uchar flags\n"
    "property list uchar int vertex_indices\n"
    "property list uint8 float texcoord\n"
    "property double area\n"
    "element edge 1\n"
    "property int vertex1\n"
    "property int vertex2\n"
    "element material 1\n"
    "property list ushort short numbers\n"
    "end_header\n"
    "\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\xff\x00\x00\x00?\x00\x00\x80"
    "?\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x80\xbf\x00\x00\x80?\x00\x00\x00"
    "\x00\x00\x00\xf0?\x00\x00\x80>\x07\x00\x00\x00@\x00\x00\x00\x00\x9a\x99\x99\x99\x99\x99\xf1"
    "?\x00\x00\x00\x00\x08\x00\x00@@\x01\x03\x00\x00\x00\x00\x01\x00\x00\x00\x02\x00\x00\x00\x01"
    "\x00\x00\x00?\x00\x00\x00\x00\x00\x00\xe0?\x02\x03\x00\x00\x00\x00\x02\x00\x00\x00\x03\x00\x00"
    "\x00\x00\x00\x00\x00\x00\x00\x00\xe8?\x00\x00\x00\x00\x02\x00\x00\x00\x02\x00\xff\xff,\x01",
    572};

/// As bytes, the highest first.
inline constexpr std::string_view ply_big_sample{
    "ply\n"
    "format binary_big_endian 1.0\n"
    "comment two triangles\n"
    "element vertex 4\n"
    "property float x\n"
    "property double y\n"
    "property float32 z\n"
    "property uchar red\n"
    "property float quality\n"
    "element face 2\n"
    "property uchar flags\n"
    "property list uchar int vertex_indices\n"
    "property list uint8 float texcoord\n"
    "property double area\n"
    "element edge 1\n"
    "property int vertex1\n"
    "property int vertex2\n"
    "element material 1\n"
    "property list ushort short numbers\n"
    "end_header\n"
    "\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\xff?\x00\x00\x00?\x80\x00\x00"
    "\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\xbf\x80\x00\x00?\x80\x00\x00?\xf0\x00\x00"
    "\x00\x00\x00\x00>\x80\x00\x00\x07@\x00\x00\x00\x00\x00\x00\x00?\xf1\x99\x99\x99\x99\x99\x9a"
    "\x00\x00\x00\x00\x08@@\x00\x00\x01\x03\x00\x00\x00\x00\x00\x00\x00\x01\x00\x00\x00\x02\x01?"
    "\x00\x00\x00?\xe0\x00\x00\x00\x00\x00\x00\x02\x03\x00\x00\x00\x00\x00\x00\x00\x02\x00\x00\x00"
    "\x03\x00?\xe8\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x02\x00\x02\xff\xff\x01,",
    569};

}  // namespace derham::io_test
