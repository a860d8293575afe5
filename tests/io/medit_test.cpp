#include "derham/io/write_mesh.hpp"

#include "io/io_fixture.hpp"
#include "io/sample_files.hpp"

#include <string>
#include <vector>

namespace derham::io_test {
namespace {

MeshData read(std::string_view bytes, const ReadOptions& options = {}) {
  return read_mesh_from_memory(bytes, MeshFormat::medit, "mesh", options);
}
void refused(std::string_view bytes, std::int64_t line, const std::string& part) {
  expect_refused(bytes, MeshFormat::medit, line, part);
}

const std::string head = "MeshVersionFormatted 2\nDimension 2\n";
const std::string square = head + "Vertices\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

TEST(Medit, ReadsSimplicesAndReferences) {
  const auto mesh = read(medit_sample);
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2, 3}, {1, 2, 3, 4}}));
  EXPECT_EQ(mesh.ambient_dimension, 3);
  EXPECT_EQ(mesh.points, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}));
  ASSERT_EQ(mesh.lower.size(), 3u);
  EXPECT_TRUE(mesh.lower[0].empty());
  EXPECT_EQ(mesh.lower[1], (SimplexList{{0, 1}}));
  EXPECT_EQ(mesh.lower[2], (SimplexList{{0, 1, 2}, {1, 2, 3}}));
  EXPECT_EQ(
      mesh.parts,
      (std::vector<MeshPart>{
          {"", 5, 3, {0}}, {"", 9, 3, {1}}, {"", 7, 2, {0}}, {"", 4, 1, {0}}, {"", -2, 0, {4}}, {"", 3, 0, {1, 2}}}));
  EXPECT_EQ(mesh.notes, (std::vector<std::string>{"section Corners (2) is not kept", "section Normals (1) is not kept",
                                                  "section SubDomainFromMesh (1) is not kept"}));
  EXPECT_TRUE(mesh.vertex_tags.empty());
}

TEST(Medit, LinesMeanNothing) {
  std::string one_line(medit_sample);
  one_line.erase(one_line.find("# two"), 17);
  for (char& c : one_line)
    if (c == '\n') c = ' ';
  const auto mesh = read(one_line);
  EXPECT_EQ(mesh.simplices, read(medit_sample).simplices);
  EXPECT_EQ(mesh.parts, read(medit_sample).parts);
}

TEST(Medit, EndMayBeMissing) {
  EXPECT_EQ(read(square + "Triangles 1 1 2 3 0").simplices, (SimplexList{{0, 1, 2}}));
  EXPECT_EQ(read(square).simplices.size(), 0);
  EXPECT_EQ(read(square).notes.size(), 1u);
  EXPECT_TRUE(read(square + "End").notes.empty());
  EXPECT_EQ(read(square).vertex_count, 4);
}

TEST(Medit, SplitsQuadrilateralsOnlyWhenAsked) {
  const std::string quads = square + "Quadrilaterals\n1\n1 2 3 4 6\nEnd\n";
  refused(quads, 9, "1 quadrilaterals");
  ReadOptions options;
  options.triangulate = true;
  const auto mesh = read(quads, options);
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(mesh.parts, (std::vector<MeshPart>{{"", 6, 2, {0, 1}}}));
  EXPECT_EQ(mesh.notes, (std::vector<std::string>{"split 1 quadrilaterals into 2 triangles"}));
}

TEST(Medit, SectionsOfOneKindAreOne) {
  const auto mesh = read(square + "Triangles\n1\n1 2 3 7\nEdges\n1\n1 2 0\nTriangles 2\n1 3 4 7 4 3 2 0\nEnd\n");
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2}, {0, 2, 3}, {3, 2, 1}}));
  EXPECT_EQ(mesh.parts, (std::vector<MeshPart>{{"", 7, 2, {0, 1}}}));
  EXPECT_TRUE(mesh.notes.empty());
}

TEST(Medit, KeepsCornerNodesOnlyWhenAsked) {
  const std::string quadratic = head + "Vertices\n7\n0 0 0\n.5 0 4\n1 0 0\n1 1 3\n.5 .5 0\n0 .5 0\n9 9 0\n" +
                                "TrianglesP2\n1\n1 3 4 2 5 6 8\nEdgesP2\n1\n1 3 2 0\nEdges\n1\n2 3 0\nEnd\n";
  const auto mesh = read(quadratic, {.corner_nodes = true});
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2}}));
  EXPECT_EQ(mesh.points, (std::vector<double>{0, 0, 1, 0, 1, 1}));
  EXPECT_EQ(mesh.vertex_tags, (std::vector<std::int64_t>{0, 2, 3}));
  EXPECT_EQ(mesh.parts, (std::vector<MeshPart>{{"", 8, 2, {0}}, {"", 3, 0, {2}}, {"", 4, 0, {}}}));
  EXPECT_EQ(mesh.notes,
            (std::vector<std::string>{
                "with the unused vertices went 1 simplices of lower dimension and 1 members of parts",
                "kept the corner nodes of 2 elements of higher order; dropped 4 nodes that no simplex uses"}));
}

TEST(Medit, WritesWhatItReads) {
  const TemporaryDirectory directory;
  auto mesh = read(medit_sample);
  write_mesh(directory / "a.mesh", mesh);
  const auto back = read_mesh(directory / "a.mesh");
  EXPECT_EQ(back.simplices, mesh.simplices);
  EXPECT_EQ(back.points, mesh.points);
  EXPECT_EQ(back.lower, mesh.lower);
  EXPECT_EQ(back.parts, mesh.parts);
  EXPECT_TRUE(not_carried(mesh, MeshFormat::medit).empty());
  mesh.parts[0] = {"solid", 5, 3, {0, 1}};
  mesh.parts[2].number = std::int64_t{1} << 40;
  write_mesh(directory / "a.mesh", mesh);
  EXPECT_EQ(read_bytes(directory / "a.mesh").find("MeshVersionFormatted 4\n"), 0u);
  EXPECT_EQ(read_mesh(directory / "a.mesh").parts[1].number, std::int64_t{1} << 40);
  EXPECT_EQ(read_mesh(directory / "a.mesh").parts[0].members, (std::vector<Index>{0, 1}));
  EXPECT_EQ(not_carried(mesh, MeshFormat::medit).size(), 2u);
}

TEST(Medit, RefusesDamage) {
  refused("MFEM mesh v1.0\n", 1, "'MFEM', expected MeshVersionFormatted");
  refused("MeshVersionUnformatted 1\n", 1, "binary Medit");
  refused("MeshVersionFormatted 5\n", 1, "the version of the format is 5, expected 1 to 4");
  refused("MeshVersionFormatted 2\nVertices\n0\n", 2, "'Vertices', expected Dimension");
  refused("MeshVersionFormatted 2\nDimension 4\n", 2, "the dimension is 4, expected 2 to 3");
  refused(head + "Dimension 2\n", 3, "a second section 'Dimension'");
  refused(head, 2, "no section Vertices");
  refused(head + "Triangles\n0\nVertices\n0\n", 3, "Triangles stand before Vertices");
  refused(head + "Vertices\n-1\n", 4, "the number of vertices is -1");
  refused(head + "Vertices\n1000000000000\n0 0 0\n", 4, "cannot hold so many");
  refused(head + "Vertices\n2\n0 0 0\n1 0  \n", 6,
          "the end of the file, expected an integer as the reference of a vertex");
  refused(head + "Vertices\n2\n0 0 0.5\n1 0 0\n", 5, "'0.5', expected an integer");
  refused(head + "Vertices\n1\n0 nan 0\n", 5, "finite");
  refused(head + "Vertices\n1\n0 1e400 0\n", 5, "range of a double");
  refused(square + "Triangles\n1\n1 2 5 0\n", 11, "a vertex number is 5, expected 1 to 4");
  refused(square + "Triangles\n1\n0 1 2 0\n", 11, "a vertex number is 0, expected 1 to 4");
  refused(square + "Triangles\n2\n1 2 3 0\n# and no more\n", 12, "the file ends after 1 of 2 triangles");
  refused(square + "Triangles\n1\n1 2 3 0\n4 3 2 0\n", 12, "'4', expected a keyword");
  refused(square + "Corners\n1\n1\nCorners\n0\n", 12, "a second section 'Corners'");
  refused(square + "Vertices\n0\n", 9, "a second section 'Vertices'");
  refused(square + "Triangles\n1\n1 2 3 0\nEnd\n1\n", 13, "'1', expected the end of the file");
  refused(square + "Hexahedra\n1\n", 9, "the file has Hexahedra");
  refused(square + "PrismsP2\n1\n", 9, "first order");
  refused(square + "TrianglesP2\n1\n1 2 3 1 2 3 0\n", 9,
          "the file has 1 TrianglesP2; expected simplices of first order, or "
          "keep only the corner nodes (--corner-nodes, ReadOptions::corner_nodes)");
  refused(square + "Corners\n2\n1\nTriangles\n0\n", 12, "'Triangles', expected a number");
  refused(square + "Corners\n9000000000\n1\n", 10, "cannot hold so many");
  refused(square + "SubDomainFromMesh\n2\n1 2 3\n", 11, "3 numbers in 2 records of the section SubDomainFromMesh");
  refused(square + "Potatoes\n0\n", 9, "'Potatoes', expected a keyword");
}

}  // namespace
}  // namespace derham::io_test
