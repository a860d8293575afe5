#include "derham/io/unused_vertices.hpp"

#include "io/io_fixture.hpp"

#include <string>
#include <vector>

namespace derham::io_test {
namespace {

TEST(UnusedVertices, FindsTheFirst) {
  EXPECT_EQ(first_unused_vertex(read_mesh_from_memory("0 1\n1 2\n", MeshFormat::facets, "f")), -1);
  EXPECT_EQ(first_unused_vertex(read_mesh_from_memory("0 1\n1 4\n3 1\n", MeshFormat::facets, "f")), 2);
  EXPECT_EQ(first_unused_vertex(read_mesh_from_memory("0 1 2000000000\n", MeshFormat::facets, "f")), 2);
  EXPECT_EQ(first_unused_vertex(MeshData{}), -1);
  MeshData mesh;
  mesh.vertex_count = 3;
  EXPECT_EQ(first_unused_vertex(mesh), 0);
  mesh.simplices = SimplexList{{0, 1}};
  EXPECT_EQ(first_unused_vertex(mesh), 2);
}

TEST(UnusedVertices, DropsThemAndKeepsTheirNames) {
  MeshData mesh;
  mesh.vertex_count = 5;
  mesh.ambient_dimension = 2;
  mesh.points = {0, 0, 10, 11, 20, 21, 30, 31, 40, 41};
  mesh.simplices = SimplexList{{4, 1}, {1, 3}};
  MeshData tagged = mesh;
  tagged.vertex_tags = {7, 8, 9, 10, 11};
  EXPECT_EQ(drop_unused_vertices(mesh), 2);
  EXPECT_EQ(mesh.vertex_count, 3);
  EXPECT_EQ(mesh.simplices, (SimplexList{{2, 0}, {0, 1}}));
  EXPECT_EQ(mesh.points, (std::vector<double>{10, 11, 30, 31, 40, 41}));
  EXPECT_EQ(mesh.vertex_tags, (std::vector<std::int64_t>{1, 3, 4}));
  EXPECT_EQ(drop_unused_vertices(mesh), 0);
  EXPECT_EQ(drop_unused_vertices(tagged), 2);
  EXPECT_EQ(tagged.vertex_tags, (std::vector<std::int64_t>{8, 10, 11}));
}

TEST(UnusedVertices, SaysWhatGoesWithThem) {
  MeshData mesh;
  mesh.vertex_count = 4;
  mesh.simplices = SimplexList{{0, 1, 3}};
  mesh.lower = {SimplexList{{2}, {3}}, SimplexList{{0, 1}, {1, 2}}};
  mesh.forms = {{"u", 0, false, {5, 6, 7, 8}}, {"v", 2, true, {5, 6, 7, 8}}, {"w", 2, false, {9}}};
  mesh.parts = {{"ends", 1, 0, {0, 2}}, {"sides", 1, 1, {0, 1}}};
  EXPECT_EQ(drop_unused_vertices(mesh), 1);
  EXPECT_EQ(mesh.lower, (std::vector<SimplexList>{SimplexList{{2}}, SimplexList{{0, 1}}}));
  EXPECT_EQ(mesh.parts, (std::vector<MeshPart>{{"ends", 1, 0, {0}}, {"sides", 1, 1, {0}}}));
  EXPECT_EQ(mesh.forms,
            (std::vector<MeshForm>{{"u", 0, false, {5, 6, 8}}, {"v", 2, true, {5, 6, 8}}, {"w", 2, false, {9}}}));
  EXPECT_EQ(mesh.notes, (std::vector<std::string>{
                            "with the unused vertices went 2 simplices of lower dimension and 2 members of parts"}));
  EXPECT_EQ(drop_unused_vertices(mesh), 0);
  EXPECT_EQ(mesh.notes.size(), 1u);
}

TEST(UnusedVertices, HugeIdsCostNothing) {
  auto mesh = read_mesh_from_memory("5 2000000000\n2000000000 7 5\n", MeshFormat::facets, "f");
  EXPECT_EQ(drop_unused_vertices(mesh), 2000000001 - 3);
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 2}, {2, 1, 0}}));
  EXPECT_EQ(mesh.vertex_tags, (std::vector<std::int64_t>{5, 7, 2000000000}));
}

TEST(UnusedVertices, RefuseIdsOutOfRange) {
  MeshData mesh;
  mesh.vertex_count = 2;
  mesh.simplices = SimplexList{{0, 2}};
  EXPECT_THROW((void)first_unused_vertex(mesh), InputError);
  EXPECT_THROW((void)drop_unused_vertices(mesh), InputError);
}

}  // namespace
}  // namespace derham::io_test
