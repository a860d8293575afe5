#include "derham/io/write_mesh.hpp"

#include "io/io_fixture.hpp"
#include "io/sample_files.hpp"

#include <cmath>
#include <limits>
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
std::string replaced(std::string_view bytes, std::string_view what, std::string_view with) {
  std::string out(bytes);
  const auto at = out.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return out.replace(at, what.size(), with);
}

void expect_two_tetrahedra(const MeshData& mesh) {
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2, 3}, {1, 2, 3, 4}}));
  EXPECT_EQ(mesh.vertex_count, 5);
  EXPECT_EQ(mesh.ambient_dimension, 3);
  EXPECT_EQ(mesh.points, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}));
  ASSERT_EQ(mesh.lower.size(), 3u);
  EXPECT_EQ(mesh.lower[2], (SimplexList{{0, 1, 2}}));
  EXPECT_EQ(mesh.lower_count(), 1);
  EXPECT_TRUE(mesh.parts.empty());
}

void expect_field(const MeshField& field, const std::string& name, MeshField::On on, int components,
                  const std::vector<double>& values) {
  EXPECT_EQ(field.name, name);
  EXPECT_EQ(field.on, on);
  EXPECT_EQ(field.components, components);
  ASSERT_EQ(field.values.size(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isnan(values[i])) {
      EXPECT_TRUE(std::isnan(field.values[i])) << name << i;
    } else {
      EXPECT_EQ(field.values[i], values[i]) << name << i;
    }
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

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
  refused(replaced(quadratic, "\n9", "\n21"), 9, "of first order; corner_nodes");
  options.corner_nodes = true;
  EXPECT_EQ(read(replaced(quadratic, "\n9", "\n21"), options).simplices, (SimplexList{{0, 1}}));
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
  named.fields[0].values.pop_back();
  EXPECT_THROW(write_mesh(directory / "b.vtk", named, MeshFormat::vtk), InputError);
}

TEST(Vtk, LargeIntegersAreRoundedAndNoted) {
  auto bytes = std::string(vtk_binary_30_sample);
  bytes[bytes.size() - 49] = '\x7f';
  const auto notes = read(bytes).notes;
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[0], "field 'r': integers beyond 2^53 are rounded");
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
  refused(whole + "CELL_DATA 3\nSCALARS a bit\nLOOKUP_TABLE default\n0 1 1\n", 14,
          "found 'bit' as the type of the array");
  refused(whole + "CELL_DATA 3\nSCALARS a int\nLOOKUP_TABLE default\n0 1\n", 16,
          "found the end of the file, expected a number as a value");
  refused(whole + "CELL_DATA 3\nSCALARS a int\nLOOKUP_TABLE default\n0 1 x\n", 16, "'x', expected a number as a value");
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
