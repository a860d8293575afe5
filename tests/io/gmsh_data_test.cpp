#include "io/io_fixture.hpp"

#include <string>
#include <vector>

namespace derham::io_test {
namespace {

MeshData read(std::string_view bytes) { return read_mesh_from_memory(bytes, MeshFormat::gmsh, "mesh"); }

const std::string mesh_22 =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n"
    "$Elements\n3\n1 2 0 1 2 3\n2 1 0 1 2\n4 2 0 3 2 1\n$EndElements\n";  // 15 lines

void refused(const std::string& section, std::int64_t line, const std::string& part) {
  expect_refused(mesh_22 + section, MeshFormat::gmsh, 15 + line, part);
}
std::string names(const std::string& lines) { return "$PhysicalNames\n" + lines + "$EndPhysicalNames\n"; }
std::string node_data(const std::string& lines) { return "$NodeData\n" + lines + "$EndNodeData\n"; }
std::string element_data(const std::string& lines) { return "$ElementData\n" + lines + "$EndElementData\n"; }

TEST(GmshNames, MayHoldQuotesAndBlanksAndAnyBytes) {
  const auto name = [](const std::string& quoted) {
    const auto mesh = read(mesh_22 + names("1\n2 5 " + quoted + "\n"));
    EXPECT_EQ(mesh.parts.size(), 1U);
    return mesh.parts.at(0).name;
  };
  EXPECT_EQ(name("\"a b\""), "a b");
  EXPECT_EQ(name("\"say \"hello\" twice\" \t\r"), "say \"hello\" twice");
  EXPECT_EQ(name("\"\""), "");
  EXPECT_EQ(name("\"\"\""), "\"");
  EXPECT_EQ(name("\"gr\xc3\xbc\xc3\x9f $EndPhysicalNames\""), "gr\xc3\xbc\xc3\x9f $EndPhysicalNames");
}

TEST(GmshNames, OfGroupsThatCannotHaveMembersAreDropped) {
  const auto mesh = read(mesh_22 + names("2\n3 5 \"solid\"\n1 6 \"edge\"\n"));
  EXPECT_EQ(mesh.parts, (std::vector<MeshPart>{{"edge", 6, 1, {}}}));
  EXPECT_EQ(mesh.notes,
            (std::vector<std::string>{"dropped physical group 5 of dimension 3 ('solid'): it has no elements"}));
}

TEST(GmshNames, RefusesDamage) {
  refused(names("1\n2 5 solid\n"), 3, "found 'solid', expected a name in double quotes");
  refused(names("1\n2 5 \"solid\n"), 3, "in double quotes");
  refused(names("1\n2 5 \"solid\" x\n"), 3, "nothing behind it");
  refused(names("1\n2 5\n"), 3, "the end of the line, expected a name");
  refused(names("1\n2 5 \"a\x01z\"\n"), 3, "found '\"a\\x01z\"', expected a name without control characters");
  refused(names("1\n2 5 \"a" + std::string(1, '\0') + "z\"\n"), 3, "without control characters");
  refused(names("1\n4 5 \"a\"\n"), 3, "the dimension of a physical group is 4, expected 0 to 3");
  refused(names("1\n2 0 \"a\"\n"), 3, "the number of a physical group is 0");
  refused(names("2\n2 5 \"a\"\n2 5 \"b\"\n"), 4, "physical group 5 of dimension 2 is named twice");
  refused(names("9999\n2 5 \"a\"\n"), 2, "cannot hold so many");
  refused(names("2\n2 5 \"a\"\n"), 4, "'$EndPhysicalNames', expected an integer");
  refused(names("0\n") + names("0\n"), 4, "a second section $PhysicalNames");
}

TEST(GmshFields, KeepTheLastTimeStep) {
  const auto step = [](const std::string& number, const std::string& value) {
    return node_data("1\n\"T\"\n1\n" + number + "\n3\n" + number + "\n1\n3\n3 " + value + "\n1 0\n2 0\n");
  };
  const auto mesh = read(mesh_22 + step("0", "5") + step("1", "6"));
  EXPECT_EQ(mesh.fields, (std::vector<MeshField>{{"T", MeshField::On::vertices, 1, {0, 0, 6}}}));
  EXPECT_EQ(mesh.notes, (std::vector<std::string>{"field 'T' is given 2 times (time steps): kept the last"}));
}

TEST(GmshFields, OnNodesAndRowsMayShareAName) {
  const auto mesh = read(mesh_22 + node_data("1\n\"T\"\n0\n3\n0\n1\n3\n1 1\n2 2\n3 3\n") +
                         element_data("1\n\"T\"\n0\n4\n0\n1\n2\n0\n4 1e-3\n1 7\n"));
  EXPECT_EQ(mesh.fields, (std::vector<MeshField>{{"T", MeshField::On::vertices, 1, {1, 2, 3}},
                                                 {"T", MeshField::On::rows, 1, {7, 1e-3}}}));
  EXPECT_TRUE(mesh.notes.empty());
}

TEST(GmshFields, OnLowerSimplicesAloneAreDropped) {
  const auto mesh = read(mesh_22 + element_data("1\n\"T\"\n0\n3\n0\n1\n1\n2 5\n"));
  EXPECT_TRUE(mesh.fields.empty());
  EXPECT_EQ(mesh.notes, (std::vector<std::string>{"field 'T': dropped 1 values on simplices of lower dimension"}));
}

TEST(GmshFields, OfSomeNodesOrRowsAreDroppedByName) {
  const auto mesh =
      read(mesh_22 + node_data("1\n\"T\"\n0\n3\n0\n1\n2\n1 1\n2 2\n") +
           node_data("1\n\"U\"\n0\n3\n0\n1\n3\n1 1\n2 2\n3 4\n") + element_data("1\n\"V\"\n0\n3\n0\n1\n2\n1 1\n2 2\n") +
           element_data("1\n\"W\"\n0\n3\n0\n1\n0\n"));
  EXPECT_EQ(mesh.fields, (std::vector<MeshField>{{"U", MeshField::On::vertices, 1, {1, 2, 4}}}));
  EXPECT_EQ(mesh.notes,
            (std::vector<std::string>{"field 'T' has values for 2 of 3 nodes: not kept",
                                      "field 'V': dropped 1 values on simplices of lower dimension",
                                      "field 'V' has values for 1 of 2 simplices of the highest dimension: not kept",
                                      "field 'W' has values for 0 of 2 simplices of the highest dimension: not kept"}));
}

TEST(GmshFields, RefusesDamage) {
  refused(node_data("1\n\"T\"\n0\n3\n0\n1\n3\n1 1\n2 2\n1 2\n"), 11, "number 1 has two values in field 'T'");
  refused(node_data("1\n\"T\"\n0\n3\n0\n1\n3\n1 1\n2 2\n4 2\n"), 11, "node number 4 is not among");
  refused(element_data("1\n\"T\"\n0\n3\n0\n1\n2\n1 1\n3 2\n"), 10, "element number 3 is not among");
  refused(node_data("1\n\"T\"\n0\n3\n0\n1\n3\n1 1\n2 nan\n3 2\n"), 10, "finite");
  refused(node_data("1\n\"T\"\n0\n3\n0\n1\n3\n1 1\n2 2 2\n3 2\n"), 10, "the end of the line");
  refused(node_data("1\n\"T\"\n0\n3\n0\n3\n3\n1 1\n"), 8, "cannot hold so many");
  refused(node_data("1\n\"T\"\n0\n3\n0\n0\n3\n"), 7, "the number of components is 0");
  refused(node_data("1\n\"T\"\n0\n2\n0\n1\n"), 5, "the number of integer tags is 2, expected at least 3");
  refused(node_data("1\nT\n0\n3\n0\n1\n3\n"), 3, "in double quotes");
  refused(node_data("1\n\"T\"\n1\nx\n3\n0\n1\n3\n"), 5, "found 'x', expected a number as a real tag");
  expect_refused(node_data(""), MeshFormat::gmsh, 1, "expected $MeshFormat");
  expect_refused(mesh_22.substr(0, mesh_22.find("$Elements")) + node_data(""), MeshFormat::gmsh, 10,
                 "data stand before $Elements");
}

}  // namespace
}  // namespace derham::io_test
