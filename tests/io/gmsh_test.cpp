#include "io/io_fixture.hpp"
#include "io/sample_files.hpp"

#include <string>
#include <vector>

namespace derham::io_test {
namespace {

MeshData read(std::string_view bytes) { return read_mesh_from_memory(bytes, MeshFormat::gmsh, "mesh"); }
void refused(std::string_view bytes, std::int64_t line, const std::string& part) {
  expect_refused(bytes, MeshFormat::gmsh, line, part);
}

const std::string header = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string nodes = "$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n";
const std::string elements = "$Elements\n1\n1 2 0 1 2 3\n$EndElements\n";

TEST(Gmsh, KeepsTheHighestDimensionAndTheTags) {
  const auto mesh = read(gmsh_sample);
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2, 3}, {1, 2, 3, 4}}));
  EXPECT_EQ(mesh.vertex_tags, (std::vector<std::int64_t>{10, 12, 11, 40, 41}));
  EXPECT_EQ(mesh.row_tags, (std::vector<std::int64_t>{5, 9}));
  EXPECT_EQ(mesh.lower_count(), 2);
  EXPECT_EQ(mesh.ambient_dimension, 3);
  EXPECT_EQ(mesh.points, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}));
}

TEST(Gmsh, KeepsTheHighestDimensionInAnyOrder) {
  const auto mesh = read(header + nodes + "$Elements\n3\n1 1 0 1 2\n2 2 0 1 2 3\n3 1 0 2 3\n$EndElements\n");
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2}}));
  EXPECT_EQ(mesh.lower_count(), 2);
}

TEST(Gmsh, NodeNumbersMayHaveGapsOfAnySizeAndAnyOrder) {
  for (const auto* middle : {"2", "9", "9000000000000000000"}) {
    const auto number = std::string(middle);
    const auto mesh = read(header + "$Nodes\n3\n3 0 0 0\n" + number + " 1 0 0\n1 0 1 0\n$EndNodes\n" +
                           "$Elements\n1\n1 2 0 1 " + number + " 3\n$EndElements\n");
    EXPECT_EQ(mesh.simplices, (SimplexList{{2, 1, 0}})) << number;
    EXPECT_EQ(mesh.vertex_tags[1], std::stoll(number));
  }
}

TEST(Gmsh, ReadsPointsAndEmptyMeshes) {
  EXPECT_EQ(read(header + nodes + "$Elements\n1\n1 15 0 2\n$EndElements\n").simplices, (SimplexList{{1}}));
  EXPECT_TRUE(read(header + "$Nodes\n0\n$EndNodes\n$Elements\n0\n$EndElements\n").simplices.empty());
}

TEST(Gmsh, SkipsOtherSections) {
  EXPECT_EQ(read("$Comments\n$Nodes of all sorts\n$EndComments\n" + header + "$Periodic\n0\n$EndPeriodic\n" + nodes +
                 elements + "$ElementNodeData\n1\n\"x\"\n$EndElementNodeData\n")
                .simplices.size(),
            1);
}

TEST(Gmsh, RefusesOtherVersions) {
  refused("$MeshFormat\n4 0 8\n$EndMeshFormat\n", 2, "'4'; expected 2.2 or 4.1: convert it with gmsh");
  refused("$MeshFormat\n2.1 0 8\n$EndMeshFormat\n", 2, "'2.1'; expected 2.2 or 4.1");
  refused("$MeshFormat\n2.2 2 8\n", 2, "the file type is 2");
  refused("$MeshFormat\n4.1 0 16\n", 2, "the data size is 16, expected 4 or 8");
  refused("$NOD\n3\n", 1, "Gmsh format 1.0; expected 2.2 or 4.1: convert it with gmsh");
  refused("$Nodes\n3\n", 1, "expected $MeshFormat");
}

TEST(Gmsh, RefusesElementsThatAreNoSimplicesByName) {
  const auto with = [](const char* element) {
    return header + nodes + "$Elements\n1\n" + element + "\n$EndElements\n";
  };
  refused(with("1 3 0 1 2 3 1"), 12, "a quadrangle");
  refused(with("1 5 0 1 2 3 1 1 2 3 1"), 12, "a hexahedron");
  refused(with("1 6 0 1 2 3 1 2 3"), 12, "a prism");
  refused(with("1 7 0 1 2 3 1 2"), 12, "a pyramid");
  refused(with("1 11 0 1 2 3 1 2 3 1 2 3 1"), 12, "a 3-simplex of higher order with 10 nodes");
  refused(with("1 99 0 1 2 3"), 12, "no simplex");
}

TEST(Gmsh, AnElementOfSeveralGroupsIsOneSimplex) {
  const auto with = [](const char* list) { return header + nodes + "$Elements\n" + list + "$EndElements\n"; };
  // Group after group, and element after element.
  for (const auto* list : {"4\n8 1 2 5 1 1 2\n9 1 2 5 1 2 3\n8 1 2 6 1 1 2\n9 1 2 6 1 2 3\n",
                           "4\n8 1 2 5 1 1 2\n8 1 2 6 1 1 2\n9 1 2 6 1 2 3\n9 1 2 5 1 2 3\n"}) {
    const auto mesh = read(with(list));
    EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1}, {1, 2}}));
    EXPECT_EQ(mesh.row_tags, (std::vector<std::int64_t>{8, 9}));
    EXPECT_EQ(mesh.parts, (std::vector<MeshPart>{{"", 5, 1, {0, 1}}, {"", 6, 1, {0, 1}}}));
    ASSERT_EQ(mesh.notes.size(), 1U);
    EXPECT_EQ(mesh.notes[0].find("2 elements are listed again"), 0U);
  }
  // Members in the order of the simplices, not of the list.
  const auto mesh = read(with("4\n8 1 2 5 1 1 2\n9 1 2 5 1 2 3\n9 1 2 6 1 2 3\n8 1 2 6 1 1 2\n"));
  EXPECT_EQ(mesh.parts[1].members, (std::vector<Index>{0, 1}));
  // Other numbers are other rows; the complex will see that they repeat.
  EXPECT_EQ(read(with("2\n1 1 2 5 1 1 2\n2 1 2 5 1 1 2\n")).simplices.size(), 2);
  refused(with("3\n1 1 0 1 2\n2 1 0 2 3\n1 1 0 1 3\n"), 14, "element number 1 is given twice with other nodes");
  refused(with("2\n1 1 0 1 2\n1 1 0 2 1\n"), 13, "element number 1 is given twice with other nodes");
  refused(with("2\n1 1 0 1 2\n1 2 0 1 2 3\n"), 13, "element number 1 is given twice with other nodes");
}

TEST(Gmsh, SplitsQuadranglesOnlyWhenAsked) {
  const std::string square = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n";
  const std::string data = "$ElementData\n1\n\"T\"\n0\n3\n0\n1\n3\n5 .5\n6 .6\n7 .7\n$EndElementData\n";
  const std::string bytes = header + square +
                            "$Elements\n4\n5 2 2 1 1 1 2 3\n6 3 2 8 1 1 2 3 4\n7 2 2 1 1 4 2 3\n6 3 2 9 1 1 2 3 4\n"
                            "$EndElements\n" +
                            data;
  refused(bytes, 14, "a quadrangle; expected");
  refused(bytes, 14, "(--triangulate, ReadOptions::triangulate)");
  const ReadOptions options{.triangulate = true};
  const auto mesh = read_mesh_from_memory(bytes, MeshFormat::gmsh, "mesh", options);
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}, {3, 1, 2}}));
  EXPECT_EQ(mesh.row_tags, (std::vector<std::int64_t>{5, 6, 6, 7}));
  EXPECT_EQ(mesh.parts, (std::vector<MeshPart>{{"", 1, 2, {0, 3}}, {"", 8, 2, {1, 2}}, {"", 9, 2, {1, 2}}}));
  EXPECT_EQ(mesh.fields, (std::vector<MeshField>{{"T", MeshField::On::rows, 1, {0.5, 0.6, 0.6, 0.7}}}));
  EXPECT_EQ(mesh.notes.back(), "split 1 quadrangles into 2 triangles");
  // A number has one element: no other fourth corner, and no triangle.
  for (const auto* again : {"6 3 2 9 1 1 2 3 1", "6 2 2 9 1 1 2 3"}) {
    auto other = bytes;
    other.replace(other.find("6 3 2 9 1 1 2 3 4"), 17, again);
    EXPECT_THROW((void)read_mesh_from_memory(other, MeshFormat::gmsh, "mesh", options), FileError) << again;
  }
  // Beside tetrahedra; in format 4.1.
  const auto lower =
      read_mesh_from_memory(header + square + "$Elements\n2\n1 3 2 8 1 1 2 3 4\n2 4 2 0 1 1 2 3 4\n$EndElements\n",
                            MeshFormat::gmsh, "mesh", options);
  EXPECT_EQ(lower.lower.at(2), (SimplexList{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(lower.parts, (std::vector<MeshPart>{{"", 8, 2, {0, 1}}}));
  const auto blocks = read_mesh_from_memory(
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n2 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 "
      "0\n$EndNodes\n"
      "$Elements\n1 1 1 1\n2 1 3 1\n1 1 2 3 4\n$EndElements\n",
      MeshFormat::gmsh, "mesh", options);
  EXPECT_EQ(blocks.simplices, (SimplexList{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Gmsh, KeepsTheCornersOfElementsOfHigherOrderOnRequest) {
  const std::string bytes = header +
                            "$Nodes\n7\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 .5 0 0\n5 .5 .5 0\n6 0 .5 0\n7 9 9 9\n$EndNodes\n"
                            "$Elements\n3\n1 8 2 1 1 1 2 4\n2 9 2 1 1 1 2 3 4 5 6\n3 15 2 2 1 7\n$EndElements\n";
  refused(bytes, 16, "a 1-simplex of higher order with 3 nodes; expected first order");
  const auto mesh = read_mesh_from_memory(bytes, MeshFormat::gmsh, "mesh", {.corner_nodes = true});
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2}}));
  EXPECT_EQ(mesh.vertex_tags, (std::vector<std::int64_t>{1, 2, 3}));
  EXPECT_EQ(mesh.points, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0}));
  EXPECT_EQ(mesh.notes,
            (std::vector<std::string>{
                "with the unused vertices went 1 simplices of lower dimension and 1 members of parts",
                "kept the corner nodes of 2 elements of higher order; dropped 4 nodes that no simplex uses"}));
  // Without such elements nothing is dropped.
  EXPECT_EQ(read_mesh_from_memory(header + nodes + "$Elements\n1\n1 1 0 1 2\n$EndElements\n", MeshFormat::gmsh, "mesh",
                                  {.corner_nodes = true})
                .vertex_count,
            3);
}

TEST(Gmsh, RefusesDamage) {
  refused("", 0, "the file is empty");
  refused("\n", 1, "no section $Nodes");
  refused("$MeshFormat", 1, "the end of the file, expected the version");
  refused("$MeshFormat\n2.2 0 8\n", 2, "expected $EndMeshFormat");
  refused("$MeshFormat\n2.2 0 8 9\n$EndMeshFormat\n", 2, "the end of the line");
  refused(header + header, 4, "a second section");
  refused(header, 3, "no section $Nodes");
  refused(header + nodes, 9, "no section $Elements");
  refused(header + elements + nodes, 4, "before $Nodes");
  refused(header + nodes + nodes + elements, 10, "a second section $Nodes");
  refused(header + nodes + elements + elements, 14, "a second section $Elements");
  refused(header + nodes + elements + "junk\n", 14, "'junk'");
  refused(header + nodes + elements + "$Open\n1\n", 14, "is not closed");
  refused(header + nodes + elements + "$EndElements\n", 14, "start of a section");
  refused(header + "$Nodes 3\n", 4, "the end of the line");
  refused(header + "$Nodes\n9223372036854775807\n1 0 0 0\n$EndNodes\n", 5, "cannot hold so many");
  refused(header + "$Nodes\n2\n1 0 0 0\n$EndNodes\n", 7, "'$EndNodes', expected an integer");
  refused(header + "$Nodes\n1\n1 0 0 0\n2 0 0 0\n$EndNodes\n", 7, "expected $EndNodes");
  refused(header + "$Nodes\n2\n1 0 0 0\n1 0 0 0\n$EndNodes\n", 7, "node number 1 is given twice");
  refused(header + "$Nodes\n3\n7 0 0 0\n99999999 0 0 0\n\n7 0 0 0\n$EndNodes\n", 9, "node number 7 is given twice");
  refused(header + "$Nodes\n1\n0 0 0 0\n$EndNodes\n", 6, "a node number is 0");
  refused(header + "$Nodes\n1\n1 0 inf 0\n$EndNodes\n", 6, "finite");
  refused(header + "$Nodes\n1\n1 0 0\n$EndNodes\n", 6, "the end of the line");
  refused(header + "$Nodes\n1\n1 0 0 0 0\n$EndNodes\n", 6, "the end of the line");
  const auto with = [](const char* text) { return header + nodes + "$Elements\n" + text; };
  refused(with("1\n1 2 0 1 2 4\n$EndElements\n"), 12, "node number 4 is not among");
  refused(with("1\n1 1 0 1 0\n$EndElements\n"), 12, "node number 0 is not among");
  refused(with("1\n1 1 0 1 -9223372036854775808\n$EndElements\n"), 12, "is not among");
  refused(with("1\n1 2 5 1 2 3\n$EndElements\n"), 12, "a tag");
  refused(with("1\n1 2 -1 1 2 3\n$EndElements\n"), 12, "the number of tags is -1");
  refused(with("1\n1 2 9223372036854775807 1 2 3\n$EndElements\n"), 12, "the end of the line");
  refused(with("2\n1 2 0 1 2 3\n$EndElements\n"), 13, "'$EndElements'");
  refused(with("1\n1 2 0 1 2 3\n"), 12, "expected $EndElements");
  refused(with("3\n1 2 0 1 2 3\n2 2 0 1 2 3\n"), 13, "after 2 of 3 elements");
}

}  // namespace
}  // namespace derham::io_test
