#include "io/io_fixture.hpp"
#include "io/sample_files.hpp"

#include <string>
#include <vector>

namespace derham::io_test {
namespace {

MeshData read(std::string_view bytes) { return read_mesh_from_memory(bytes, MeshFormat::obj, "mesh"); }
void refused(std::string_view bytes, std::int64_t line, const std::string& part) {
  expect_refused(bytes, MeshFormat::obj, line, part);
}

const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(Obj, ReadsAllFormsOfCorners) {
  const auto mesh = read(obj_sample);
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(mesh.points, (std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}));
  EXPECT_EQ(mesh.vertex_count, 4);
  EXPECT_EQ(mesh.vertex_tags, (std::vector<std::int64_t>{1, 2, 3, 4}));
  EXPECT_EQ(mesh.ambient_dimension, 3);
  EXPECT_EQ(mesh.lower_count(), 2);
  EXPECT_EQ(mesh.notes, (std::vector<std::string>{"skipped lines: 1 g, 1 mtllib, 1 o, 1 s, 1 usemtl, 1 vn, 1 vt",
                                                  "skipped the colours of 1 vertices"}));
}

TEST(Obj, FacesMayNameLaterVertices) {
  EXPECT_EQ(read("f 1 2 3\n" + three).simplices, (SimplexList{{0, 1, 2}}));
  refused("f 1 2 4\n" + three, 1, "vertex number 4, but the file has 3 vertices");
  refused(three + "f 1 2 3\nf 1 2 9\nf 1 2 4\n", 5, "vertex number 9");
}

TEST(Obj, LinesAloneAreAGraphAndPointsAlonePoints) {
  EXPECT_EQ(read(three + "l 1 2 3 1\n").simplices, (SimplexList{{0, 1}, {1, 2}, {2, 0}}));
  EXPECT_EQ(read(three + "p 1 3\n").simplices, (SimplexList{{0}, {2}}));
}

TEST(Obj, RefusesDamage) {
  refused(three + "f 1 2 3 1\n", 4, "a face with 4 vertices; expected triangles");
  refused(three + "f 1 2\n", 4, "the end of the line");
  refused(three + "l 1\n", 4, "the end of the line");
  refused(three + "p\n", 4, "the end of the line");
  refused(three + "f 0 1 2\n", 4, "'0', expected a vertex number");
  refused(three + "f -4 1 2\n", 4, "'-4', expected a vertex number from -3");
  refused(three + "f 1 2 99999999999999\n", 4, "99999999999999");
  refused(three + "f 1 2 99999999999999999999\n", 4, "expected a vertex number");
  for (const auto* corner : {"1.0", "a", "1/a", "1/1/a", "1/1/1/1", "1\\1", "/1"})
    refused(three + "f 1 2 " + corner + "\n", 4, "expected a vertex number");
  refused("v 0 0\n", 1, "the end of the line");
  refused("v 0 0 nan\n", 1, "finite");
  refused("v 0 0 1e400\n", 1, "range of a double");
  refused("v 0 0 0 2\n", 1, "weight 2");
  refused("v 0 0 0 1 1\n", 1, "5 numbers");
  refused("v 0 0 0 1 1 1 1 1\n", 1, "the end of the line");
  refused("v 0 0 0 red\n", 1, "'red'");
  refused("vertex 0 0 0\n", 1, "'vertex', expected an OBJ keyword");
  refused(three + "\xff\xfe\n", 4, "'\\xff\\xfe'");
}

TEST(Obj, AcceptsWeightOneColoursAndEmptyParts) {
  const auto mesh = read("v 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0 1 1 1 1\nf 1/ 2// 3//\n");
  EXPECT_EQ(mesh.simplices.size(), 1);
  EXPECT_EQ(mesh.notes, std::vector<std::string>{"skipped the colours of 2 vertices"});
  EXPECT_TRUE(read("v 0 0 0 1\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").notes.empty());
}

TEST(Obj, PolygonsAreSplitOnRequest) {
  const auto mesh = read_mesh_from_memory(three + "f 1/1 3//2 -2 1\n", MeshFormat::obj, "mesh", {.triangulate = true});
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 2, 1}, {0, 1, 0}}));
  EXPECT_EQ(mesh.notes, std::vector<std::string>{"split 1 polygon into 2 triangles, fans about first vertices"});
}

}  // namespace
}  // namespace derham::io_test
