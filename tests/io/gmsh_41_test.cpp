#include "io/io_fixture.hpp"

#include <string>
#include <vector>

namespace derham::io_test {
namespace {

MeshData read(std::string_view bytes) { return read_mesh_from_memory(bytes, MeshFormat::gmsh, "mesh"); }
void refused(std::string_view bytes, std::int64_t line, const std::string& part) {
  expect_refused(bytes, MeshFormat::gmsh, line, part);
}

const std::string header = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
const std::string entities =
    "$Entities\n0 1 1 0\n5 0 0 0 1 1 1 2 7 -8 0\n6 0 0 0 1 1 1 0 1 5\n$EndEntities\n";                // lines 4 to 8
const std::string nodes = "$Nodes\n1 3 1 3\n2 6 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n";      // 9 to 18
const std::string elements = "$Elements\n2 2 1 2\n1 5 1 1\n1 1 2\n2 6 2 1\n2 1 2 3\n$EndElements\n";  // 19 to 25
const std::string good = header + entities + nodes + elements;

// `good` with `old` once replaced.
std::string with(const std::string& old, const std::string& replacement) {
  auto out = good;
  const auto at = out.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return out.replace(at, old.size(), replacement);
}

TEST(Gmsh41, AnEntityMayBeInSeveralGroups) {
  const auto mesh = read(good);
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2}}));
  EXPECT_EQ(mesh.parts, (std::vector<MeshPart>{{"", 7, 1, {0}}, {"", 8, 1, {0}}}));
  EXPECT_TRUE(mesh.notes.empty());
}

TEST(Gmsh41, EntitiesMayBeMissing) {
  EXPECT_TRUE(read(header + nodes + elements).parts.empty());
  EXPECT_EQ(read(header + nodes + elements).lower_count(), 1);
  EXPECT_TRUE(read(header + "$Nodes\n0 0 0 0\n$EndNodes\n$Elements\n0 0 0 0\n$EndElements\n").simplices.empty());
}

TEST(Gmsh41, PartitionsAreReadAsOneMesh) {
  const auto mesh = read(header +
                         "$PartitionedEntities\n2\n1\n9 1\n0 0 2 0\n"
                         "6 2 1 1 1 0 0 0 1 1 1 1 4 1 5\n7 2 1 2 1 2 0 0 0 1 1 1 2 4 5 0\n$EndPartitionedEntities\n"
                         "$Nodes\n1 4 1 4\n2 6 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n$EndNodes\n"
                         "$Elements\n2 2 1 2\n2 6 2 1\n1 1 2 3\n2 7 2 1\n2 2 4 3\n$EndElements\n"
                         "$GhostElements\n1\n1 1 1 2\n$EndGhostElements\n");
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2}, {1, 3, 2}}));
  EXPECT_EQ(mesh.parts, (std::vector<MeshPart>{{"", 4, 2, {0, 1}}, {"", 5, 2, {1}}}));
  EXPECT_EQ(mesh.notes, (std::vector<std::string>{"the file is split into 2 partitions: read as one mesh",
                                                  "skipped the section '$GhostElements'"}));
}

TEST(Gmsh41, ManySmallBlocksAreOneMesh) {
  constexpr int count = 3000;
  std::string blocks = "$Elements\n3000 3000 1 3000\n";
  for (int i = 1; i <= count; ++i) blocks.append("1 5 1 1\n").append(std::to_string(i)).append(" 1 2\n");
  const auto mesh = read(header + entities + nodes + blocks + "$EndElements\n");
  EXPECT_EQ(mesh.simplices.size(), count);
  ASSERT_EQ(mesh.parts.size(), 2U);
  EXPECT_EQ(mesh.parts[1].members.size(), std::size_t{count});
}

TEST(Gmsh41, ElementsOfTwoEntitiesMayBeOne) {
  const auto mesh = read(header + "$Entities\n0 2 0 0\n5 0 0 0 1 1 1 1 7 0\n6 0 0 0 1 1 1 1 9 0\n$EndEntities\n" +
                         nodes + "$Elements\n2 2 1 1\n1 5 1 1\n1 1 2\n1 6 1 1\n1 1 2\n$EndElements\n");
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1}}));
  EXPECT_EQ(mesh.parts, (std::vector<MeshPart>{{"", 7, 1, {0}}, {"", 9, 1, {0}}}));
}

// `count` lines in each of `count` physical groups.
std::string lines_in_groups(int count) {
  std::string file = header + "$Entities\n0 1 0 0\n5 0 0 0 1 1 1 " + std::to_string(count);
  for (int g = 1; g <= count; ++g) file += std::string(" ").append(std::to_string(g));
  const auto n = std::to_string(count);
  file += " 0\n$EndEntities\n" + nodes + "$Elements\n1 " + n + " 1 1\n1 5 1 " + n + "\n";
  for (int e = 1; e <= count; ++e) file += std::to_string(e).append(" 1 2\n");
  return file + "$EndElements\n";
}

TEST(Gmsh41, AnEntityMayBeInManyGroupsAsTheFileIsLong) {
  EXPECT_EQ(read(lines_in_groups(100)).parts.size(), 100U);
  refused(lines_in_groups(300), 20, "the elements are in 90000 physical groups in all; expected at most");
}

TEST(Gmsh41, RefusesDamage) {
  refused(header + entities, 8, "no section $Nodes");
  refused(header + nodes + elements + entities, 21, "entities stand behind $Elements");
  refused(with("0 1 1 0\n", "0 1000000 1 0\n"), 5, "cannot hold so many");
  refused(with("0 1 1 0\n", "0 -1 1 0\n"), 5, "the number of entities is -1");
  refused(with("1 1 1 2 7 -8", "1 1 1 2 7 x"), 6, "found 'x', expected an integer as a physical group");
  refused(with("1 1 1 2 7 -8", "1 1 1 2 7 2147483648"), 6, "a physical group is 2147483648");
  refused(with("0 1 5\n$End", "0 2 5\n$End"), 8, "'$EndEntities', expected an integer as a bounding entity");
  refused(with("0 1 5\n$End", "0 0 5\n$End"), 7, "expected $EndEntities");
  refused(with("1 3 1 3\n", "1 3 1\n"), 10, "the end of the line");
  refused(with("1 3 1 3\n", "1 300 1 3\n"), 10, "cannot hold so many");
  refused(with("1 3 1 3\n", "1 4 1 3\n"), 17, "the blocks hold 3 nodes, the section said 4");
  refused(with("1 3 1 3\n", "2 3 1 3\n"), 18, "'$EndNodes', expected an integer");
  refused(with("1 3 1 3\n", "1 2 1 3\n"), 11, "the number of nodes of a block is 3, expected at most 2");
  refused(with("2 6 0 3\n", "4 6 0 3\n"), 11, "the dimension of an entity is 4, expected 0 to 3");
  refused(with("2 6 0 3\n", "2 6 2 3\n"), 11, "the flag of parameters is 2");
  refused(with("2 6 0 3\n", "2 6 1 3\n"), 15, "a parameter");
  refused(with("1\n2\n3\n0", "1\n2\n2\n0"), 14, "node number 2 is given twice");
  refused(with("1\n2\n3\n0", "1\n0\n3\n0"), 13, "a node number is 0");
  refused(with("1\n2\n3\n0", "1 4\n2\n3\n0"), 12, "the end of the line");
  refused(with("1 0 0\n0 1 0", "1 nan 0\n0 1 0"), 16, "finite");
  refused(with("1 0 0\n0 1 0", "1 0 0 0\n0 1 0"), 16, "the end of the line");

  refused(with("2 2 1 2\n", "2 3 1 2\n"), 24, "the blocks hold 2 elements, the section said 3");
  refused(with("2 2 1 2\n", "2 1 1 2\n"), 23, "the number of elements of a block is 1, expected at most 0");
  refused(with("1 5 1 1\n", "2 5 1 1\n"), 21, "elements of type 1, which has dimension 1, on an entity of dimension 2");
  refused(with("1 5 1 1\n", "1 5 3 1\n"), 21, "a quadrangle");
  refused(with("1 5 1 1\n", "1 5 1 2\n"), 23, "node number 6 is not among");
  refused(with("1 1 2\n2 6", "1 1 4\n2 6"), 22, "node number 4 is not among");
  refused(with("2 1 2 3\n$End", "1 1 2 3\n$End"), 24, "element number 1 is given twice with other nodes");
  refused(with("2 1 2 3\n$End", "2 1 2 3 1\n$End"), 24, "the end of the line");
}

}  // namespace
}  // namespace derham::io_test
