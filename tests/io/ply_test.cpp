#include "io/ply_samples.hpp"

#include "derham/io/write_mesh.hpp"
#include "io/io_fixture.hpp"

#include <limits>
#include <string>
#include <vector>

namespace derham::io_test {
namespace {

MeshData read(std::string_view bytes, const ReadOptions& options = {}) {
  return read_mesh_from_memory(bytes, MeshFormat::ply, "mesh", options);
}
void refused(std::string_view bytes, std::int64_t line, const std::string& part) {
  expect_refused(bytes, MeshFormat::ply, line, part);
}

const std::string header = "ply\nformat ascii 1.0\n";
const std::string space = "property float x\nproperty float y\nproperty float z\n";
// A file of 4 vertices; the first face is on line 14.
std::string faces(const std::string& count, const std::string& lines) {
  return header + "element vertex 4\n" + space + "element face " + count +
         "\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n" + lines;
}

TEST(Ply, ReadsTextAndBothOrdersOfBytesAlike) {
  for (const auto sample : {ply_ascii_sample, ply_little_sample, ply_big_sample}) {
    const auto mesh = read(sample);
    EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(mesh.points, (std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0.25, 0, 1.1, 0}));
    EXPECT_EQ(mesh.ambient_dimension, 3);
    EXPECT_EQ(mesh.vertex_count, 4);
    ASSERT_EQ(mesh.lower.size(), 2U);
    EXPECT_EQ(mesh.lower[1], (SimplexList{{0, 2}}));
    ASSERT_EQ(mesh.fields.size(), 4U);
    EXPECT_EQ(mesh.fields[0], (MeshField{"red", MeshField::On::vertices, 1, {255, 0, 7, 8}}));
    EXPECT_EQ(mesh.fields[1], (MeshField{"quality", MeshField::On::vertices, 1, {0.5, -1, 2, 3}}));
    EXPECT_EQ(mesh.fields[2], (MeshField{"flags", MeshField::On::rows, 1, {1, 2}}));
    EXPECT_EQ(mesh.fields[3], (MeshField{"area", MeshField::On::rows, 1, {0.5, 0.75}}));
    EXPECT_EQ(mesh.notes, (std::vector<std::string>{"skipped the list 'texcoord' of the faces",
                                                    "skipped 1 records of the element 'material'"}));
  }
}

TEST(Ply, ElementsComeInAnyOrder) {
  const auto mesh = read(header + "element face 1\nproperty list int int vertex_index\nelement vertex 3\n" + space +
                         "end_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n");
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2}}));
}

TEST(Ply, ListsAmongTheNumbersOfVertices) {
  const std::string bytes =
      "ply\nformat binary_big_endian 1.0\nelement vertex 2\nproperty list uchar short a\nproperty char x\nelement face "
      "1\n"
      "property list uchar uchar vertex_index\nend_header\r\n" +
      std::string{1, 0, 9, 5, 0, -6, 2, 0, 1};
  const auto mesh = read(bytes);
  EXPECT_EQ(mesh.points, (std::vector<double>{5, -6}));
  EXPECT_EQ(mesh.ambient_dimension, 1);
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1}}));
}

TEST(Ply, IntegersAreFieldsWithTheirExtremes) {
  const std::string properties =
      "element vertex 2\nproperty float x\nproperty int a\nproperty uint b\nproperty char c\nend_header\n";
  const auto text = read(header + properties + "0 -2147483648 0 -128\n0 2147483647 4294967295 127\n");
  const auto bytes =
      read("ply\nformat binary_big_endian 1.0\n" + properties + std::string("\0\0\0\0\x80\0\0\0\0\0\0\0\x80", 13) +
           std::string("\0\0\0\0\x7f\xff\xff\xff\xff\xff\xff\xff\x7f", 13));
  for (const auto& mesh : {text, bytes}) {
    ASSERT_EQ(mesh.fields.size(), 3U);
    EXPECT_EQ(mesh.fields[0].values, (std::vector<double>{-2147483648.0, 2147483647}));
    EXPECT_EQ(mesh.fields[1].values, (std::vector<double>{0, 4294967295.0}));
    EXPECT_EQ(mesh.fields[2].values, (std::vector<double>{-128, 127}));
    EXPECT_TRUE(mesh.notes.empty());
  }
  refused(header + properties + "0 2147483648 0 0\n0 0 0 0\n", 9, "is 2147483648, expected -2147483648 to 2147483647");
}

TEST(Ply, WhatIsSkippedIsNamed) {
  const auto mesh = read(header + "element vertex 2\nproperty float x\nproperty list uchar float w\nelement edge 1\n" +
                         "property uchar red\nproperty int vertex2\nproperty int vertex1\nend_header\n" +
                         "0 2 nan inf\n1 0\n7 0 1\n");
  EXPECT_EQ(mesh.simplices, (SimplexList{{1, 0}}));
  EXPECT_EQ(mesh.notes, (std::vector<std::string>{"skipped the list 'w' of the vertices",
                                                  "skipped the property 'red' of the edges"}));
}

TEST(Ply, PolygonsAreSplitOnRequest) {
  const auto bytes = faces("3", "4 0 1 2 3\n3 0 1 2\n2 0 3\n");
  refused(bytes, 14, "a face with 4 vertices; expected triangles");
  const auto mesh = read(bytes, {.triangulate = true});
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}}));
  EXPECT_EQ(mesh.lower_count(), 1);
  EXPECT_EQ(mesh.notes, std::vector<std::string>{"split 1 polygon into 2 triangles, fans about first vertices"});
}

TEST(Ply, NumbersOnFacesFollowTheSplit) {
  const auto mesh = read(header + "element vertex 5\nproperty float x\nelement face 3\nproperty float a\n" +
                             "property list uchar int vertex_indices\nend_header\n0\n1\n2\n3\n4\n" +
                             "7 5 0 1 2 3 4\n8 2 0 1\n9 3 2 3 4\n",
                         {.triangulate = true});
  ASSERT_EQ(mesh.fields.size(), 1U);
  EXPECT_EQ(mesh.fields[0].values, (std::vector<double>{7, 7, 7, 9}));
}

TEST(Ply, RefusesBadHeaders) {
  refused("plY\n", 1, "expected the first line 'ply'");
  refused("ply\nelement vertex 1\n", 2, "'element', expected the line 'format");
  refused("ply\nformat binary 1.0\n", 2, "expected the format: ascii, binary_little_endian");
  refused("ply\nformat ascii 1.1\n", 2, "expected the version 1.0");
  refused(header + "format ascii 1.0\n", 3, "expected element, comment");
  refused(header + "property float x\n", 3, "expected element, comment");
  refused(header + "element vertex -1\n", 3, "the number of records is -1");
  refused(header + "element vertex\n", 3, "the end of the line");
  refused(header + "element vertex 1\nproperty real x\n", 4, "'real', expected a type such as float");
  for (const auto* type : {"int64", "uint64", "long", "list uchar int64"})
    refused(header + "element vertex 1\nproperty " + type + " x\n", 4,
            "is none of PLY, whose integers have at most 32 bits; expected int, or double");
  refused(header + "element vertex 1\nproperty list float int x\n", 4, "'float', expected an integer type");
  refused(header + "element vertex 1\nproperty float x\nproperty int x\n", 5, "has the property 'x' twice");
  refused(header + "element a 0\nproperty float x\nelement a 0\n", 5, "the element 'a' is there twice");
  refused(header + "element a 0\nend_header\n", 3, "has no properties");
  refused(header + "element vertex 1\nproperty float x\n", 4, "the end of the file, expected end_header");
  refused(header + "element vertex 99999999999\nproperty float x\nend_header\n0\n", 3, "cannot hold so many");
  refused(header + "element a 9223372036854775807\nproperty float x\nend_header\n0\n", 3, "cannot hold so many");
  refused(header + "element face 0\nproperty list int int vertex_index\nend_header\n", 5, "no element vertex");
  refused(header + "element vertex 1\nproperty float y\nend_header\n0\n", 6, "no property x");
}

TEST(Ply, RefusesDamagedRecords) {
  refused(faces("1", ""), 13, "the file ends after 0 of 1 records of 'face'");
  refused(faces("1", "3 0 1 4\n"), 14, "a vertex id is 4, expected 0 to 3");
  refused(faces("1", "3 0 1 -1\n"), 14, "a vertex id is -1");
  refused(faces("1", "3 0 1\n"), 14, "the end of the line");
  refused(faces("1", "3 0 1 2 3\n"), 14, "'3', expected the end of the line");
  refused(faces("1", "0\n"), 14, "face 0 has no vertices");
  refused(faces("1", "256 0 1\n"), 14, "the length of a list is 256, expected 0 to 255");
  refused(faces("1", "200 0 1\n"), 14, "the length of the list 'vertex_indices' is 200");
  refused(faces("1", "3 0 1 2\n1 0\n"), 15, "the end of the file");
  refused(header + "element vertex 1\nproperty float x\nend_header\nnan\n", 6, "finite");
  refused(header + "element vertex 1\nproperty uchar x\nend_header\n-1\n", 6, "is -1, expected 0 to 255");
  refused(header + "element vertex 1\nproperty float x\nelement face 1\nproperty int vertex_index\nend_header\n0\n1\n",
          8, "no list of integers called vertex_indices");
  refused(header + "element vertex 2\nproperty float x\nelement edge 1\nproperty int vertex1\nend_header\n0\n1\n0\n", 9,
          "no integer property vertex2");
  refused(
      header + "element vertex 1\nproperty float x\nelement tristrips 1\nproperty list int int a\nend_header\n0\n1 0\n",
      8, "strips of triangles");
}

TEST(Ply, NamesTheByteOfDamagedBinaryFiles) {
  const std::string little(ply_little_sample);
  refused(little + "x", 0, "byte " + std::to_string(little.size()) + ": 1 bytes follow");
  refused(little.substr(0, little.size() - 1), 0, "a property takes 4 bytes, but the file ends after 3");
  auto damaged = little;
  const auto body = little.find("end_header\n") + 11;
  damaged[body + 21 + 3] = '\x7f';  // of the second vertex, its x
  damaged[body + 21 + 2] = '\xc0';
  refused(damaged, 0,
          "byte " + std::to_string(body + 21) + ": found nan, expected a finite number as the property 'x'");
  damaged = little;
  damaged[body + 84 + 2] = 4;
  refused(damaged, 0, "byte " + std::to_string(body + 84 + 2) + ": a vertex id is 4, expected 0 to 3");
  damaged = little;
  damaged[body + 84 + 1] = 4;
  refused(damaged, 0, "a face with 4 vertices");
}

TEST(Ply, WritesFieldsAndReadsThemBack) {
  const TemporaryDirectory directory;
  constexpr double infinity = std::numeric_limits<double>::infinity();  // fields may have such values
  auto mesh = read(ply_ascii_sample);
  mesh.notes.clear();
  mesh.lower.clear();
  mesh.fields[1].values = {infinity, -infinity, -0.0, std::numeric_limits<double>::quiet_NaN()};
  mesh.fields[3].values = {-std::numeric_limits<double>::quiet_NaN(), infinity};
  EXPECT_TRUE(not_carried(mesh, MeshFormat::ply).empty());
  for (const auto encoding : {WriteOptions::Encoding::ascii, WriteOptions::Encoding::usual}) {
    write_mesh(directory / "a.ply", mesh, MeshFormat::ply, {.encoding = encoding});
    const auto back = read_mesh(directory / "a.ply");
    EXPECT_EQ(back.simplices, mesh.simplices);
    EXPECT_EQ(back.points, mesh.points);
    EXPECT_TRUE(back.notes.empty());
    ASSERT_EQ(back.fields.size(), mesh.fields.size());
    for (std::size_t i = 0; i < mesh.fields.size(); ++i)
      expect_field(back.fields[i], mesh.fields[i].name, mesh.fields[i].on, 1, mesh.fields[i].values);
  }
}

TEST(Ply, SaysWhichNamesItCannotHold) {
  const TemporaryDirectory directory;
  MeshData mesh;
  mesh.simplices = SimplexList{{0, 1, 2}};
  mesh.vertex_count = 3;
  mesh.ambient_dimension = 2;
  mesh.points = {0, 0, 1, 0, 0, 1};
  mesh.fields = {{"x", MeshField::On::vertices, 1, {1, 2, 3}},
                 {"a vector", MeshField::On::vertices, 2, {1, 2, 3, 4, 5, 6}},
                 {"a_vector_1", MeshField::On::vertices, 1, {7, 8, 9}},
                 {"\xc3\xbc", MeshField::On::vertices, 1, {1, 1, 1}},
                 {"", MeshField::On::rows, 1, {4}}};
  EXPECT_EQ(
      not_carried(mesh, MeshFormat::ply),
      (std::vector<std::string>{
          "format ply holds positions in space: written with z = 0, read back into the plane by --planar "
          "(ReadOptions::planar)",
          "format ply does not hold the name of the field 'x': it becomes 'x_'",
          "format ply does not hold the 2 components of the field 'a vector' together: they become 'a_vector_0' to "
          "'a_vector_1'",
          "format ply does not hold the name of the field 'a_vector_1': it becomes 'a_vector_1_'",
          "format ply does not hold the name of the field '': it becomes 'field'"}));
  write_mesh(directory / "a.ply", mesh);
  const auto back = read_mesh(directory / "a.ply").fields;
  ASSERT_EQ(back.size(), 6U);
  EXPECT_EQ(back[0], (MeshField{"x_", MeshField::On::vertices, 1, {1, 2, 3}}));
  EXPECT_EQ(back[1], (MeshField{"a_vector_0", MeshField::On::vertices, 1, {1, 3, 5}}));
  EXPECT_EQ(back[2], (MeshField{"a_vector_1", MeshField::On::vertices, 1, {2, 4, 6}}));
  EXPECT_EQ(back[3], (MeshField{"a_vector_1_", MeshField::On::vertices, 1, {7, 8, 9}}));
  EXPECT_EQ(back[4], mesh.fields[3]);
  EXPECT_EQ(back[5], (MeshField{"field", MeshField::On::rows, 1, {4}}));
}

}  // namespace
}  // namespace derham::io_test
