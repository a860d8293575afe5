#include "derham/io/write_mesh.hpp"

#include "io/io_fixture.hpp"
#include "io/sample_files.hpp"
#include "io/vtk_checks.hpp"

#include <string>
#include <vector>

namespace derham::io_test {
namespace {

MeshData read(std::string_view bytes, const ReadOptions& options = {}) {
  return read_mesh_from_memory(bytes, MeshFormat::vtk, "mesh", options);
}
void refused(std::string_view bytes, std::int64_t line, const std::string& part) {
  expect_refused(bytes, MeshFormat::vtk, line, part);
}
TEST(Vtk, ReadsEveryLayout) {
  const auto text = read(vtk_ascii_51_sample);
  expect_two_tetrahedra(text);
  ASSERT_EQ(text.fields.size(), 3u);
  expect_field(text.fields[0], "u", MeshField::On::vertices, 1, {0, 1, 2, nan, 4});
  expect_field(text.fields[1], "w v", MeshField::On::vertices, 3, {1, 0, 0, 2, 0, 0, 3, 0, 0, 4, 0, 0, 5, 0, 0});
  expect_field(text.fields[2], "r", MeshField::On::rows, 2, {1, 2, 3, 4});
  EXPECT_EQ(text.notes, (std::vector<std::string>{"array 'TIME' of the whole data set is not kept",
                                                  "field 'r': 2 values on cells of lower dimension are not kept"}));
  expect_two_tetrahedra(read(vtk_ascii_30_sample));
  EXPECT_TRUE(read(vtk_ascii_30_sample).fields.empty());
  expect_two_tetrahedra(read(vtk_binary_51_sample));
  const auto bytes = read(vtk_binary_30_sample);
  expect_two_tetrahedra(bytes);
  ASSERT_EQ(bytes.fields.size(), 2u);
  expect_field(bytes.fields[0], "u", MeshField::On::vertices, 1, {0, 1, 2, nan, 4});
  expect_field(bytes.fields[1], "r", MeshField::On::rows, 2, {1, 2, 3, 4});
}

TEST(Vtk, ReadsPolydata) {
  const auto mesh = read(vtk_polydata_sample);
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2}, {0, 2, 3}}));
  ASSERT_EQ(mesh.lower.size(), 2u);
  EXPECT_EQ(mesh.lower[1], (SimplexList{{0, 1}}));
  ASSERT_EQ(mesh.fields.size(), 1u);
  expect_field(mesh.fields[0], "c", MeshField::On::rows, 1, {2, 3});
}

TEST(Vtk, SplitsPolygonsAndCutsHigherOrderOnlyWhenAsked) {
  ReadOptions options;
  const auto quad =
      replaced(replaced(replaced(vtk_ascii_30_sample, "CELLS 3 14", "CELLS 1 5"), "4 1 2 3 4\n3 0 1 2\n", ""),
               "CELL_TYPES 3\n10 10 5", "CELL_TYPES 1\n9");
  refused(quad, 9, "a quadrilateral of 4 points");
  options.triangulate = true;
  const auto data = std::string("CELL_DATA 1\nSCALARS c float\nLOOKUP_TABLE default\n7\n");
  const auto split = read(quad + data, options);
  EXPECT_EQ(split.simplices, (SimplexList{{0, 1, 2}, {0, 2, 3}}));
  ASSERT_EQ(split.fields.size(), 1u);
  expect_field(split.fields[0], "c", MeshField::On::rows, 1, {7, 7});
  EXPECT_EQ(split.notes, (std::vector<std::string>{"split 1 polygons into 2 triangles"}));
  EXPECT_EQ(read(replaced(quad, "\n9", "\n8"), options).simplices, (SimplexList{{0, 1, 3}, {0, 3, 2}}));

  const auto quadratic = replaced(quad, "CELLS 1 5\n4 0 1 2 3", "CELLS 1 4\n3 0 1 2");
  refused(replaced(quadratic, "\n9", "\n21"), 9, "of first order, or keep only the corner nodes (--corner-nodes");
  options.corner_nodes = true;
  const auto corners =
      read(replaced(quadratic, "\n9", "\n21") + "POINT_DATA 5\nVECTORS v int\n1 2 3 4 5 6 7 8 9 10 11 12 13 14 15\n",
           options);
  EXPECT_EQ(corners.simplices, (SimplexList{{0, 1}}));
  EXPECT_EQ(corners.points, (std::vector<double>{0, 0, 0, 1, 0, 0}));
  ASSERT_EQ(corners.fields.size(), 1u);
  expect_field(corners.fields[0], "v", MeshField::On::vertices, 3, {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(corners.notes,
            (std::vector<std::string>{"kept the corner nodes of 1 cells of higher order; dropped 3 nodes "
                                      "that no simplex uses"}));
}

// Nodes that were unused before any cell was cut stay, for `check` to find.
TEST(Vtk, UnusedPointsStayWhereNothingIsCut) {
  const auto bytes = replaced(replaced(vtk_ascii_30_sample, "CELLS 3 14\n4 0 1 2 3\n4 1 2 3 4\n", "CELLS 1 4\n"),
                              "CELL_TYPES 3\n10 10 5", "CELL_TYPES 1\n5");
  ReadOptions options;
  options.corner_nodes = true;
  EXPECT_EQ(read(bytes, options).vertex_count, 5);
}

// A sample with point data behind it.
std::string with_point_data(const std::string& data) {
  return std::string(vtk_ascii_30_sample) + "POINT_DATA 5\n" + data;
}

TEST(Vtk, IntegersOfTextAreIntegersOfTheirType) {
  const auto one = [](const std::string& type, const std::string& value) {
    return with_point_data("SCALARS a " + type + "\nLOOKUP_TABLE default\n0 1 2 3 " + value + "\n");
  };
  for (const auto* type : {"int", "long", "unsigned_long", "unsigned_char"}) {
    refused(one(type, "0.5"), 16, "'0.5'");
    refused(one(type, "1e3"), 16, "'1e3'");
    refused(one(type, "nan"), 16, "'nan'");
  }
  refused(one("unsigned_char", "256"), 16, "a value is 256, expected 0 to 255");
  refused(one("char", "-129"), 16, "a value is -129, expected -128 to 127");
  refused(one("long", "9223372036854775808"), 16, "9223372036854775808");
  refused(one("unsigned_long", "-1"), 16, "'-1', expected an integer from 0 to 18446744073709551615");
  refused(one("unsigned_long", "18446744073709551616"), 16, "'18446744073709551616'");
  const auto value_of = [&](const std::string& type, const std::string& value) {
    return read(one(type, value)).fields.at(0).values.at(4);
  };
  EXPECT_EQ(value_of("long", "-9223372036854775808"), -0x1p63);
  EXPECT_EQ(value_of("unsigned_long", "9223372036854775808"), 0x1p63);
  EXPECT_EQ(value_of("short", "-32768"), -32768);
}

TEST(Vtk, RoundedIntegersAreCounted) {
  const auto notes = [](const std::string& type, const std::string& values) {
    return read(with_point_data("SCALARS a " + type + "\nLOOKUP_TABLE default\n" + values + "\n")).notes;
  };
  EXPECT_TRUE(notes("long", "9007199254740992 -9007199254740992 9007199254740994 -9223372036854775808 0").empty());
  EXPECT_EQ(notes("long", "9007199254740993 -9007199254740993 3 4 5"),
            std::vector<std::string>{"array 'a': rounded 2 integers that no double holds"});
  EXPECT_EQ(notes("unsigned_long", "18446744073709551615 1 2 3 4"),
            std::vector<std::string>{"array 'a': rounded 1 integer that no double holds"});
}

TEST(Vtk, ArraysOfOneNameAreKept) {
  const auto mesh =
      read(with_point_data("SCALARS u int\nLOOKUP_TABLE default\n1 2 3 4 5\nFIELD F 2\n"
                           "u 1 5 int\n6 7 8 9 0\nv 1 5 int\n1 1 1 1 1\n"));
  ASSERT_EQ(mesh.fields.size(), 3u);
  expect_field(mesh.fields[0], "u", MeshField::On::vertices, 1, {1, 2, 3, 4, 5});
  expect_field(mesh.fields[1], "u", MeshField::On::vertices, 1, {6, 7, 8, 9, 0});
  EXPECT_EQ(mesh.notes, std::vector<std::string>{"2 fields on vertices are called 'u': all are kept"});
}

// Written by VTK 9.7.
TEST(Vtk, ArraysOfBitsAndStringsAreSkipped) {
  const std::vector<std::string> notes{"array 'b' of bits is not kept", "array 's' of strings is not kept"};
  const std::string data =
      "FIELD F 3\nb 2 5 bit\n0 1 0 1 0 1 0 1 1\n1\ns 1 5 string\none%20two\n\nthree\n4\n\n\nu 1 5 int\n1 2 3 4 5\n";
  const auto text = read(with_point_data(data));
  EXPECT_EQ(text.notes, notes);
  ASSERT_EQ(text.fields.size(), 1u);
  expect_field(text.fields[0], "u", MeshField::On::vertices, 1, {1, 2, 3, 4, 5});
  refused(with_point_data(replaced(data, "0 1 0 1 0 1 0 1 1", "0 1 0 1 0 1 0 1 2")), 16, "a bit is 2, expected 0 to 1");
  refused(with_point_data("FIELD F 1\ns 1 5 string\na\nb\nc\nd"), 19, "the end of the line takes 1 bytes");

  const auto head = std::string(vtk_binary_30_sample.substr(0, vtk_binary_30_sample.find("POINT_DATA")));
  const auto strings = "\xc7one two" + std::string("\xc0\x80\x46", 3) + std::string(70, 'x') +
                       std::string("\x40\0\0\x01y", 5) + std::string("\0\0\0\0\0\0\0\x02zz", 10);
  const auto bytes = read(head + "POINT_DATA 5\nFIELD F 2\nb 2 5 bit\n\x55\xc0\ns 1 5 string\n" + strings +
                          "\nSCALARS u char\nLOOKUP_TABLE default\n\x01\x02\x03\x04\x05\n");
  EXPECT_EQ(bytes.notes, notes);
  ASSERT_EQ(bytes.fields.size(), 1u);
  expect_field(bytes.fields[0], "u", MeshField::On::vertices, 1, {1, 2, 3, 4, 5});
  refused(head + "POINT_DATA 5\nFIELD F 1\ns 1 5 string\n\xff", 0, "a text takes 63 bytes, but the file ends");
}

TEST(Vtk, WritesWhatItReads) {
  const TemporaryDirectory directory;
  const auto mesh = read(vtk_ascii_51_sample);
  for (const auto encoding : {WriteOptions::Encoding::ascii, WriteOptions::Encoding::binary}) {
    WriteOptions options;
    options.encoding = encoding;
    write_mesh(directory / "a.vtk", mesh, MeshFormat::vtk, options);
    const auto back = read_mesh(directory / "a.vtk");
    EXPECT_EQ(back.simplices, mesh.simplices);
    EXPECT_EQ(back.points, mesh.points);
    EXPECT_EQ(back.lower, mesh.lower);
    EXPECT_TRUE(back.notes.empty());
    ASSERT_EQ(back.fields.size(), mesh.fields.size());
    for (std::size_t i = 0; i < mesh.fields.size(); ++i)
      expect_field(back.fields[i], mesh.fields[i].name, mesh.fields[i].on, mesh.fields[i].components,
                   mesh.fields[i].values);
  }
  auto named = mesh;
  named.fields[0].name = "a \"b\" % \xc3\xbc\n\x01";
  named.parts = {{"solid", 1, 3, {0}}};
  write_mesh(directory / "a.vtk", named, MeshFormat::vtk);
  EXPECT_EQ(read_mesh(directory / "a.vtk").fields[0].name, named.fields[0].name);
  EXPECT_EQ(not_carried(named, MeshFormat::vtk).size(), 1u);
  named.fields[1].name = "";
  EXPECT_EQ(not_carried(named, MeshFormat::vtk).at(1),
            "format vtk does not hold the name of the field '': it becomes 'unnamed'");
  write_mesh(directory / "a.vtk", named, MeshFormat::vtk);
  EXPECT_EQ(read_mesh(directory / "a.vtk").fields[1].name, "unnamed");
  named.fields[0].values.pop_back();
  EXPECT_THROW(write_mesh(directory / "b.vtk", named, MeshFormat::vtk), InputError);
}

TEST(Vtk, RoundedIntegersOfBytesAreCounted) {
  auto bytes = std::string(vtk_binary_30_sample);
  bytes[bytes.size() - 49] = '\x7f';
  const auto notes = read(bytes).notes;
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[0], "array 'r': rounded 1 integer that no double holds");
}

TEST(Vtk, RefusesDamageInText) {
  const auto sample = vtk_ascii_30_sample;
  const auto refused_with = [&](std::string_view what, std::string_view with, std::int64_t line, const char* part) {
    refused(replaced(sample, what, with), line, part);
  };
  refused("# vtk\n", 1, "expected DataFile");
  refused_with("3.0", "6.0", 1, "version '6.0'");
  refused_with("ASCII", "UTF8", 3, "expected ASCII or BINARY");
  refused_with("DATASET", "DATA", 4, "expected DATASET");
  refused_with("UNSTRUCTURED_GRID", "RECTILINEAR_GRID", 4, "'RECTILINEAR_GRID'");
  refused_with("POINTS 5 double\n0 0 0 1 0 0 0 1 0 0 0 1 1 1 1\n", "", 5, "expected POINTS first");
  refused_with("POINTS 5", "POINTS -5", 5, "the number of points is -5");
  refused_with("POINTS 5", "POINTS 5000000000000", 5, "cannot hold so many");
  refused_with("POINTS 5 double", "POINTS 5 string", 5, "found 'string' as the type of the points");
  refused_with("1 1 1\n", "1 1 nan\n", 6, "finite");
  refused_with("1 1 1\n", "1 1\n", 7, "'CELLS', expected a number");
  refused_with("1 1 1\n", "1 1 1 1\n", 6, "found '1', expected a section");
  refused_with("4 0 1 2 3", "4 0 1 2 5", 8, "an entry of the list of cells is 5");
  refused_with("4 0 1 2 3", "4 0 1 2 -1", 8, "is -1");
  refused_with("4 0 1 2 3", "0 0 1 2 3", 8, "an entry of the list of cells is 0");
  refused_with("CELLS 3 14", "CELLS 3 13", 10, "an entry of the list of cells is 3");
  refused_with("CELLS 3 14", "CELLS 4 14", 7, "holds 3 cells; expected 4");
  refused_with("CELLS 3 14", "CELLS 2 14", 10, "an entry of the list of cells is 3");
  refused_with("CELLS 3 14", "CELLS 3 1400000000000", 7, "cannot hold so many");
  refused_with("10 10 5\n", "10 10 10\n", 11, "cell 2 (counted from 0) is a tetrahedron of 3 points, VTK type 10");
  refused_with("10 10 5\n", "12 10 5\n", 11, "cell 0 (counted from 0) is a hexahedron of 4 points");
  refused_with("10 10 5\n", "10 256 5\n", 12, "a cell type is 256");
  refused_with("CELL_TYPES 3", "CELL_TYPES 2", 11, "2 cell types for 3 cells");
  refused_with("CELL_TYPES 3\n10 10 5\n", "", 10, "the file has no CELL_TYPES");
  const std::string whole(sample);
  refused(whole + "POINT_DATA 4\n", 13, "data for 4 points; the mesh has 5");
  refused(whole + "CELL_DATA 2\n", 13, "data for 2 cells; the mesh has 3");
  refused(whole + "CELL_DATA 3\nSCALARS a bite\nLOOKUP_TABLE default\n0 1 1\n", 14,
          "found 'bite' as the type of the array");
  refused(whole + "CELL_DATA 3\nSCALARS a int\nLOOKUP_TABLE default\n0 1\n", 16,
          "found the end of the file, expected an integer as a value");
  refused(whole + "CELL_DATA 3\nSCALARS a int\nLOOKUP_TABLE default\n0 1 x\n", 16,
          "'x', expected an integer as a value");
  refused(whole + "CELL_DATA 3\nFIELD F 1\na 1 2 int\n0 1\n", 15, "array 'a' has 2 tuples, expected 3");
  refused(whole + "CELL_DATA 3\nFIELD F 2\na 1 3 int\n0 1 2\n", 16, "the file ends after 1 of 2 arrays");
  refused(whole + "CELL_DATA 3\nPOTATOES a int\n", 14, "'POTATOES', expected a section");
  refused(whole + "POINTS 0 float\n", 13, "a second section 'POINTS'");
}

TEST(Vtk, RefusesDamageInOffsetsAndBytes) {
  const auto offsets = [](const char* with) { return replaced(vtk_ascii_51_sample, "0 4 8 11", with); };
  refused(offsets("1 4 8 11"), 18, "an offset is 1");
  refused(offsets("0 4 4 11"), 18, "an offset is 4");
  refused(offsets("0 4 8 12"), 18, "an offset is 12");
  refused(offsets("0 4 8 10"), 16, "the last offset is 10, expected the number of point ids, 11");
  refused(replaced(vtk_ascii_51_sample, "1 2 3 4 0 1 2", "1 2 3 4 0 1 5"), 20, "a point id is 5, expected 0 to 4");
  refused(replaced(vtk_ascii_51_sample, "OFFSETS vtktypeint64", "OFFSETS double"), 17, "expected integers");
  const auto bytes = vtk_binary_30_sample;
  auto damaged = std::string(bytes);
  const auto points = bytes.find("double\n") + 7;
  damaged.replace(points + 16, 2, "\x7f\xf0");
  refused(damaged, 0, "byte " + std::to_string(points + 16) + ": a coordinate is inf");
  damaged = bytes;
  const auto cells = bytes.find("3 14\n") + 5;
  damaged[cells + 7] = '\x09';
  refused(damaged, 0, "byte " + std::to_string(cells + 4) + ": an entry of the list of cells is 9");
  refused(replaced(bytes, "3 14", "3 99"), 0, "the list of cells");
  refused(replaced(vtk_binary_51_sample, "OFFSETS vtktypeint64", "OFFSETS double"), 0, "expected integers");
}

}  // namespace
}  // namespace derham::io_test
