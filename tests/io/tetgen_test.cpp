#include "derham/io/write_mesh.hpp"

#include "io/io_fixture.hpp"
#include "io/sample_files.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace derham::io_test {
namespace {

MeshData read(std::string_view bytes) { return read_mesh_from_memory(bytes, MeshFormat::tetgen, "mesh"); }
void refused(std::string_view bytes, std::int64_t line, const std::string& part) {
  expect_refused(bytes, MeshFormat::tetgen, line, part);
}

const std::string square = "4 2 0 0\n0 0 0\n1 1 0\n2 1 1\n3 0 1\n";

TEST(Tetgen, ReadsTetrahedraNumberedFromOne) {
  const auto mesh = read(tetgen_sample);
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2, 3}, {1, 2, 3, 4}}));
  EXPECT_EQ(mesh.ambient_dimension, 3);
  EXPECT_EQ(mesh.vertex_count, 5);
  EXPECT_EQ(mesh.points, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(mesh.vertex_tags, (std::vector<std::int64_t>{1, 2, 3, 4, 5}));
  EXPECT_EQ(mesh.row_tags, (std::vector<std::int64_t>{1, 2}));
}

TEST(Tetgen, ReadsPlanarTrianglesNumberedFromZero) {
  const auto mesh = read(square + "2 3 0\n0 0 1 2\n1 0 2 3\n");
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(mesh.ambient_dimension, 2);
  EXPECT_EQ(mesh.points, (std::vector<double>{0, 0, 1, 0, 1, 1, 0, 1}));
  EXPECT_TRUE(mesh.vertex_tags.empty());
  EXPECT_TRUE(mesh.row_tags.empty());
}

TEST(Tetgen, HeaderMayEndAfterTheDimension) {
  EXPECT_EQ(read("3 2\n0 0 0\n1 1 0\n2 0 1\n1 3\n0 0 1 2\n").simplices.size(), 1);
}

TEST(Tetgen, ReadsTrianglesInSpace) {
  const auto mesh = read("3 3\n0 0 0 0\n1 1 0 0\n2 0 1 1\n1 3 0\n0 0 1 2\n");
  EXPECT_EQ(mesh.simplices.dimension(), 2);
  EXPECT_EQ(mesh.ambient_dimension, 3);
}

TEST(Tetgen, RefusesDamage) {
  refused("# nothing\n", 1, "the number of nodes");
  refused("four 2 0 0\n", 1, "'four'");
  refused("-1 2 0 0\n", 1, "the number of nodes is -1");
  refused("9000000000000000000 3 0 0\n0 0 0 0\n", 1, "cannot hold so many");
  refused("4 5 0 0\n0 0 0\n1 1 0\n2 1 1\n3 0 1\n", 1, "the dimension is 5, expected 2 to 3");
  refused("1 2 0 2\n0 0 0\n", 1, "boundary markers is 2");
  refused("1 2 0 0 7\n0 0 0\n", 1, "'7', expected the end of the line");
  refused("2 2 0 0\n0 0 0\n2 0 0\n0 3 0\n", 3, "the node number is 2, expected 1");
  refused("2 2 0 0\n2 0 0\n3 0 0\n0 3 0\n", 2, "the node number is 2, expected 0 to 1");
  refused("2 2 0 0\n0 0\n1 0 0\n0 3 0\n", 2, "the end of the line, expected a number");
  refused("2 2 0 0\n0 0 0\n1 0 0 5\n0 3 0\n", 3, "'5', expected the end of the line");
  refused("2 2 0 0\n0 0 0\n1 nan 0\n0 3 0\n", 3, "finite");
  refused("2 2 0 0\n0 0 0\n1 1e999 0\n0 3 0\n", 3, "range of a double");
  refused("2 2 1 0\n0 0 0 7\n1 0 0\n0 3 0\n", 3, "an attribute");
  refused("2 2 0 1\n0 0 0 7\n1 0 0 x\n0 3 0\n", 3, "a boundary marker");
  refused(square, 5, "the number of simplices");
  refused(square + "1 6 0\n0 0 1 2 3 0 1\n", 6, "quadratic triangles");
  refused("4 3\n0 0 0 0\n1 0 0 0\n2 0 0 0\n3 0 0 0\n1 10 0\n0 0 1 2 3 0 1 2 3 0 1\n", 6, "quadratic tetrahedra");
  refused(square + "1 4 0\n0 0 1 2 3\n", 6, "4 nodes per simplex, expected 3 in dimension 2");
  refused(square + "1 3 0\n0 0 1 4\n", 7, "a node number is 4, expected 0 to 3");
  refused(square + "1 3 0\n0 0 1 -1\n", 7, "a node number is -1");
  refused(square + "1 3 0\n0 0 1\n", 7, "the end of the line");
  refused(square + "1 3 0\n0 0 1 2 3\n", 7, "the end of the line");
  refused(square + "2 3 0\n0 0 1 2\n# end of it\n", 8, "the file ends after 1 of 2 simplices");
  refused(square + "1 3 0\n0 0 1 2\n1 0 2 3\n", 8, "expected the end of the file");
  refused(square + "2 3 0\n0 0 1 2\n2 0 2 3\n", 8, "the number of the simplex is 2, expected 1");
}

TEST(Tetgen, FindsTheOtherFileOfThePair) {
  const TemporaryDirectory directory;
  write_bytes(directory / "a.1.node", square);
  write_bytes(directory / "a.1.ele", "2 3 0\n0 0 1 2\n1 0 2 3\n");
  EXPECT_EQ(read_mesh(directory / "a.1.node").simplices, read_mesh(directory / "a.1.ele").simplices);
  EXPECT_EQ(read_mesh(directory / "a.1.ele").simplices.size(), 2);
  write_bytes(directory / "b.node", square);
  write_bytes(directory / "c.node", square + "1 3 0\n");
  write_bytes(directory / "c.ele", "1 3 0\n0 0 1 9\n");
  try {
    (void)read_mesh(directory / "b.node");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_EQ(error.path(), directory / "b.ele");
  }
  try {
    (void)read_mesh(directory / "c.ele");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_EQ(error.path(), directory / "c.node");
    EXPECT_EQ(error.line(), 6);
  }
  write_bytes(directory / "c.node", square);
  try {
    (void)read_mesh(directory / "c.node");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_EQ(error.path(), directory / "c.ele");
    EXPECT_EQ(error.line(), 2);
  }
}

TEST(Tetgen, AttributesAreFieldsAndMarkersParts) {
  const auto mesh = read(tetgen_sample);
  EXPECT_EQ(mesh.fields, (std::vector<MeshField>{{"attribute 1", MeshField::On::vertices, 1, {0.5, 0.5, -1, 7, 7}},
                                                 {"attribute 1", MeshField::On::rows, 1, {-3, 1.5}}}));
  EXPECT_EQ(mesh.parts, (std::vector<MeshPart>{{"", 1, 0, {0, 2, 3, 4}}}));
  // A single integral attribute of the simplices is a region.
  const auto regions = read(square + "2 3 1\n0 0 1 2 4\n1 0 2 3 0\n");
  EXPECT_EQ(regions.parts, (std::vector<MeshPart>{{"", 4, 2, {0}}}));
  EXPECT_TRUE(regions.fields.empty());
  EXPECT_EQ(read(square + "1 3 2\n0 0 1 2 4 5\n").fields.size(), 2u);
  EXPECT_TRUE(std::isnan(read(square + "1 3 1\n0 0 1 2 nan\n").fields.at(0).values[0]));
  refused("1 2 1001 0\n", 1, "the number of attributes is 1001");
}

const std::string four_nodes = "4 3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";

TEST(Tetgen, ReadsFacesAndEdgesBesideTheMesh) {
  const TemporaryDirectory directory;
  write_bytes(directory / "a.node", four_nodes);
  write_bytes(directory / "a.ele", "1 4\n1 1 2 3 4\n");
  write_bytes(directory / "a.face", "# two of them\n2 1\n1 1 2 3 -1\n2 4 3 2 6\n");
  auto mesh = read_mesh(directory / "a.ele");
  ASSERT_EQ(mesh.lower.size(), 3u);
  EXPECT_EQ(mesh.lower[2], (SimplexList{{0, 1, 2}, {3, 2, 1}}));
  EXPECT_EQ(mesh.parts, (std::vector<MeshPart>{{"", -1, 2, {0}}, {"", 6, 2, {1}}}));
  write_bytes(directory / "a.edge", "1 1\n1 4 1 3\n");
  mesh = read_mesh(directory / "a.node");
  EXPECT_EQ(mesh.lower[1], (SimplexList{{3, 0}}));
  EXPECT_EQ(mesh.parts.back(), (MeshPart{"", 3, 1, {0}}));
  // With the tetrahedra beside them, and without markers.
  write_bytes(directory / "a.face", "1 1\n1 1 2 3 5 1 -1\n");
  write_bytes(directory / "a.edge", "1 0\n1 4 1 1\n");
  mesh = read_mesh(directory / "a.node");
  EXPECT_EQ(mesh.parts, (std::vector<MeshPart>{{"", 5, 2, {0}}}));
  EXPECT_EQ(mesh.lower_count(), 2);

  const auto expect_face_refused = [&](const std::string& bytes, std::int64_t line, const std::string& part) {
    write_bytes(directory / "a.face", bytes);
    try {
      (void)read_mesh(directory / "a.node");
      ADD_FAILURE() << bytes;
    } catch (const FileError& error) {
      EXPECT_EQ(error.path(), directory / "a.face");
      EXPECT_EQ(error.line(), line);
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  expect_face_refused("", 1, "the number of faces");
  expect_face_refused("3 1\n1 1 2 3 0\n", 2, "the file ends after 1 of 3 faces");
  expect_face_refused("300 1\n1 1 2 3 0\n", 1, "cannot hold so many");
  expect_face_refused("1 1\n1 1 2 5 0\n", 2, "a node number is 5, expected 1 to 4");
  expect_face_refused("1 1\n1 1 2 3\n", 2, "the end of the line");
  expect_face_refused("1 1\n1 1 2 3 0 7\n", 2, "'7', expected the end of the line");
  expect_face_refused("1 0\n1 1 2 3 1 2 3\n", 2, "a quadratic face");
  expect_face_refused("1 0\n1 1 2 3\n2 1 2 4\n", 3, "expected the end of the file");
}

TEST(Tetgen, FacesBesideTrianglesAreNotRead) {
  const TemporaryDirectory directory;
  write_bytes(directory / "a.node", square);
  write_bytes(directory / "a.ele", "1 3\n0 0 1 2\n");
  write_bytes(directory / "a.face", "1 0\n0 0 1 3\n");
  const auto mesh = read_mesh(directory / "a.node");
  EXPECT_TRUE(mesh.lower.empty());
  ASSERT_EQ(mesh.notes.size(), 1u);
  EXPECT_NE(mesh.notes[0].find("a.face is not read"), std::string::npos);
}

TEST(Tetgen, RegionsAreExact) {
  const auto numbers = [](const std::string& attribute) {
    std::vector<std::int64_t> out;
    for (const auto& part : read(square + "1 3 1\n0 0 1 2 " + attribute + "\n").parts) out.push_back(part.number);
    return out;
  };
  EXPECT_EQ(numbers("9007199254740993"), (std::vector<std::int64_t>{9007199254740993}));
  EXPECT_EQ(numbers("-9223372036854775808"), (std::vector<std::int64_t>{std::numeric_limits<std::int64_t>::min()}));
  EXPECT_EQ(numbers("+3.0"), (std::vector<std::int64_t>{3}));
  EXPECT_EQ(numbers("1e3"), (std::vector<std::int64_t>{1000}));
  for (const auto* real : {"9223372036854775808", "1e17", "-0", "0.5", "inf"}) {
    EXPECT_TRUE(numbers(real).empty()) << real;
    EXPECT_EQ(read(square + "1 3 1\n0 0 1 2 " + real + "\n").fields.size(), 1u) << real;
  }
  // One that is none makes all of them a field.
  const auto mixed = read(square + "2 3 1\n0 0 1 2 9007199254740993\n1 0 2 3 .5\n");
  EXPECT_TRUE(mixed.parts.empty());
  EXPECT_EQ(mixed.fields.at(0).values, (std::vector<double>{9007199254740992, 0.5}));
  refused(square + "1 3 1\n0 0 1 2 x\n", 7, "'x', expected a number as an attribute");
  refused(square + "1 3 1\n0 0 1 2\n", 7, "the end of the line");
}

TEST(Tetgen, SaysThatIntegersOnRowsBecomeParts) {
  auto mesh = read(square + "2 3 0\n0 0 1 2\n1 0 2 3\n");
  mesh.fields = {{"attribute 1", MeshField::On::rows, 1, {1, 2}}};
  EXPECT_EQ(not_carried(mesh, MeshFormat::tetgen),
            (std::vector<std::string>{
                "format tetgen holds a single field of integers on the rows ('attribute 1') as regions: it reads back "
                "as parts"}));
  mesh.fields[0].values[1] = 0.5;
  EXPECT_TRUE(not_carried(mesh, MeshFormat::tetgen).empty());
}

TEST(Tetgen, KeepsCornerNodesOnlyWhenAsked) {
  const std::string nodes = "7 2 0 1\n1 0 0 0\n2 1 0 0\n3 0 1 5\n4 .5 .5 0\n5 0 .5 6\n6 .5 0 0\n7 9 9 0\n";
  refused(nodes + "1 6\n1 1 2 3 4 5 6\n", 9, "keep only the corner nodes (--corner-nodes, ReadOptions::corner_nodes)");
  const auto mesh =
      read_mesh_from_memory(nodes + "1 6 1\n1 1 2 3 4 5 6 8\n", MeshFormat::tetgen, "mesh", {.corner_nodes = true});
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2}}));
  EXPECT_EQ(mesh.points, (std::vector<double>{0, 0, 1, 0, 0, 1}));
  EXPECT_EQ(mesh.parts, (std::vector<MeshPart>{{"", 8, 2, {0}}, {"", 5, 0, {2}}, {"", 6, 0, {}}}));
  EXPECT_EQ(mesh.notes.back(),
            "kept the corner nodes of 1 elements of higher order; dropped 4 nodes that no simplex uses");
  EXPECT_THROW(
      (void)read_mesh_from_memory(nodes + "1 6\n1 1 2 3 4 5 8\n", MeshFormat::tetgen, "mesh", {.corner_nodes = true}),
      FileError);
}

TEST(Tetgen, ReadsQuadraticFacesAndEdgesBesideTheMesh) {
  const TemporaryDirectory directory;
  std::string nodes = "10 3\n";
  for (int i = 0; i < 10; ++i)
    nodes += std::to_string(i) + ' ' + std::to_string(i % 3) + ' ' + std::to_string(i % 2) + " 1\n";
  write_bytes(directory / "a.node", nodes);
  write_bytes(directory / "a.ele", "1 10\n0 0 1 2 3 4 5 6 7 8 9\n");
  for (const auto* face : {"1 1\n0 0 1 2 4 5 6 7\n", "1 1\n0 0 1 2 4 5 6 7 0 -1\n"}) {
    write_bytes(directory / "a.face", face);
    write_bytes(directory / "a.edge", "1 1\n0 3 1 9 4\n");
    const auto mesh = read_mesh(directory / "a.node", {}, {.corner_nodes = true});
    EXPECT_EQ(mesh.lower, (std::vector<SimplexList>{{}, SimplexList{{3, 1}}, SimplexList{{0, 1, 2}}}));
    EXPECT_EQ(mesh.parts, (std::vector<MeshPart>{{"", 7, 2, {0}}, {"", 4, 1, {0}}}));
  }
  EXPECT_THROW((void)read_mesh(directory / "a.node"), FileError);
}

TEST(Tetgen, FilesOfAPairHaveTheSameLetterCase) {
  const TemporaryDirectory directory;
  const auto mesh = read(square + "1 3 0\n0 0 1 2\n");
  for (const auto& [node, ele] :
       {std::pair("a.NODE", "a.ELE"), std::pair("B.Node", "B.Ele"), std::pair("c.node", "c.ele")}) {
    write_mesh(directory / ele, mesh);
    EXPECT_EQ(read_mesh(directory / node).simplices, mesh.simplices);
    EXPECT_EQ(read_mesh(directory / ele).simplices, mesh.simplices);
  }
  EXPECT_EQ(directory.file_count(), 6);
  write_mesh(directory / "d.1", mesh, MeshFormat::tetgen);
  EXPECT_EQ(written_files("d.1", mesh, MeshFormat::tetgen), (std::vector<std::string>{"d.1.node", "d.1.ele"}));
  EXPECT_EQ(written_files("d.ELE", mesh, MeshFormat::tetgen), (std::vector<std::string>{"d.NODE", "d.ELE"}));
  EXPECT_EQ(written_files("-", mesh, MeshFormat::tetgen), (std::vector<std::string>{"-"}));
  EXPECT_EQ(read_mesh(directory / "d.1.node").simplices, mesh.simplices);
}

TEST(Tetgen, WritesWhatItReadsAndLeavesNothingStale) {
  const TemporaryDirectory directory;
  MeshData mesh;
  mesh.simplices = SimplexList{{0, 1, 2, 3}, {1, 2, 3, 4}};
  mesh.vertex_count = 5;
  mesh.ambient_dimension = 3;
  mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1.0 / 3};
  mesh.lower = {SimplexList(), SimplexList{{0, 3}}, SimplexList{{0, 1, 2}, {1, 2, 3}}};
  mesh.parts = {{"", 7, 3, {1}}, {"", 2, 2, {0, 1}}, {"", 4, 1, {0}}, {"", -1, 0, {0, 4}}};
  mesh.fields = {{"attribute 1", MeshField::On::vertices, 1, {1, 2, 3, 4, 0.1}}};
  EXPECT_TRUE(not_carried(mesh, MeshFormat::tetgen).empty());
  write_mesh(directory / "a.node", mesh);
  EXPECT_EQ(directory.file_count(), 4);
  auto back = read_mesh(directory / "a.ele");
  EXPECT_EQ(back.simplices, mesh.simplices);
  EXPECT_EQ(back.points, mesh.points);
  EXPECT_EQ(back.lower, mesh.lower);
  EXPECT_EQ(back.parts, mesh.parts);
  EXPECT_EQ(back.fields, mesh.fields);

  mesh.fields.push_back({"w", MeshField::On::rows, 2, {1, 2, 3, 4}});
  mesh.lower[1] = mesh.lower[2] = SimplexList();
  mesh.parts.resize(1);
  EXPECT_EQ(not_carried(mesh, MeshFormat::tetgen).size(), 2u);
  write_mesh(directory / "a.node", mesh);
  EXPECT_EQ(directory.file_count(), 2);
  back = read_mesh(directory / "a.node");
  EXPECT_EQ(back.lower_count(), 0);
  ASSERT_EQ(back.fields.size(), 3u);
  EXPECT_EQ(back.fields[2], (MeshField{"attribute 2", MeshField::On::rows, 1, {2, 4}}));
}

}  // namespace
}  // namespace derham::io_test
