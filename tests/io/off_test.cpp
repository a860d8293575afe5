#include "io/io_fixture.hpp"
#include "io/sample_files.hpp"

#include <string>
#include <vector>

namespace derham::io_test {
namespace {

MeshData read(std::string_view bytes) { return read_mesh_from_memory(bytes, MeshFormat::off, "mesh"); }
void refused(std::string_view bytes, std::int64_t line, const std::string& part) {
  expect_refused(bytes, MeshFormat::off, line, part);
}

const std::string three = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";

TEST(Off, ReadsTrianglesWithAndWithoutColours) {
  const auto mesh = read(off_sample);
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}));
  EXPECT_EQ(mesh.points, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}));
  EXPECT_EQ(mesh.ambient_dimension, 3);
  EXPECT_EQ(mesh.vertex_count, 4);
  EXPECT_EQ(mesh.lower_count(), 0);
  EXPECT_EQ(mesh.notes, std::vector<std::string>{"skipped the colours of 2 faces"});
  EXPECT_TRUE(read(three + "3 0 1 2\n").notes.empty());
}

TEST(Off, CountsMayStandBesideTheHeaderAndWithoutEdges) {
  EXPECT_EQ(read("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").simplices.size(), 1);
  EXPECT_EQ(read("# hello\nOFF # off\n# counts\n3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 7").simplices.size(), 1);
}

TEST(Off, EdgesAndPointsAreOfLowerDimension) {
  const auto mesh = read("OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n3 0 1 2\n1 2\n");
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2}}));
  EXPECT_EQ(mesh.lower_count(), 2);
  EXPECT_EQ(read("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n2 1 2\n").simplices, (SimplexList{{0, 1}, {1, 2}}));
}

TEST(Off, RefusesDamage) {
  refused("# only this\n", 1, "the header OFF");
  refused("3 1 0\n", 1, "'3', expected the header OFF");
  refused("COFF\n3 1 0\n", 1, "'COFF', a variant");
  refused("OFF BINARY\n", 1, "binary OFF");
  refused("OFF\n", 1, "the number of vertices");
  refused("OFF\n1\n0 0 0 0\n", 2, "the number of faces");
  refused("OFF\n3 1 0 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", 2, "the end of the line");
  refused("OFF\n999999999999 1 0\n0 0 0\n", 2, "cannot hold so many");
  refused("OFF\n1 999999999999 0\n0 0 0\n", 2, "cannot hold so many");
  refused("OFF\n1 0 -1\n0 0 0\n", 2, "the number of edges is -1");
  refused("OFF\n2 0 0\n0 0 0     \n", 3, "after 1 of 2 vertices");
  refused("OFF\n1 0 0\n0 0 0 0\n", 3, "the end of the line");
  refused("OFF\n1 0 0\n0 0\n", 3, "the end of the line, expected a number");
  refused("OFF\n1 0 0\n0 NaN 0\n", 3, "finite");
  refused(three, 5, "the file ends after 0 of 1 faces");
  refused(three + "4 0 1 2 0\n", 6, "a face with 4 vertices; expected triangles");
  refused(three + "0 0 1 2 0\n", 6, "the number of vertices of a face is 0");
  refused(three + "3 0 1 3\n", 6, "a vertex id is 3, expected 0 to 2");
  refused(three + "3 0 1 -1\n", 6, "a vertex id is -1");
  refused(three + "3 0 1\n", 6, "the end of the line");
  refused(three + "3 0 1 2 1 2 3 4 5\n", 6, "'5', expected the end of the line");
  refused(three + "3 0 1 2 red\n", 6, "'red'");
  refused(three + "3 0 1 2\n3 0 1 2\n", 7, "the end of the file");
  refused("OFF\n0 1 0\n3 0 0 0\n", 3, "but there are none");
}

TEST(Off, PolygonsAreSplitOnRequest) {
  const auto mesh =
      read_mesh_from_memory("OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 2 0\n4 0 1 2 3 255 0 0\n3 0 1 2\n5 4 3 2 1 0\n",
                            MeshFormat::off, "mesh", {.triangulate = true});
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {4, 3, 2}, {4, 2, 1}, {4, 1, 0}}));
  EXPECT_EQ(mesh.notes, (std::vector<std::string>{"split 2 polygons into 5 triangles, fans about first vertices",
                                                  "skipped the colours of 1 faces"}));
}

}  // namespace
}  // namespace derham::io_test
