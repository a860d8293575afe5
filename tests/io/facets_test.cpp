#include "io/io_fixture.hpp"
#include "io/sample_files.hpp"

#include <string>

namespace derham::io_test {
namespace {

MeshData read(std::string_view bytes) { return read_mesh_from_memory(bytes, MeshFormat::facets, "mesh"); }
void refused(std::string_view bytes, std::int64_t line, const std::string& part) {
  expect_refused(bytes, MeshFormat::facets, line, part);
}

TEST(Facets, ReadsMixedDimensions) {
  const auto mesh = read(facets_sample);
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2}, {2, 3}, {4}}));
  EXPECT_EQ(mesh.vertex_count, 5);
  EXPECT_EQ(mesh.ambient_dimension, 0);
  EXPECT_FALSE(mesh.has_points());
}

TEST(Facets, ReadsDimensionsUpToSix) {
  EXPECT_EQ(read("6 5 4 3 2 1 0").simplices.dimension(), 6);
  refused("0 1\n0 1 2 3 4 5 6 7\n", 2, "dimension at most 6");
}

TEST(Facets, NothingOrCommentsAloneAreTheEmptyComplex) {
  for (const char* bytes : {"", "# nothing\n\n"}) {
    const auto mesh = read(bytes);
    EXPECT_TRUE(mesh.simplices.empty());
    EXPECT_EQ(mesh.vertex_count, 0);
  }
}

TEST(Facets, RefusesDamage) {
  refused("0 1\n1 -2\n", 2, "a vertex id is -2, expected at least 0");
  refused("0 1\n1 2.0\n", 2, "'2.0'");
  refused("0 1\n1,2\n", 2, "'1,2'");
  refused("0 1\nx\n", 2, "'x'");
  refused("0 1\n1 99999999999999999999\n", 2, "64 bits");
  refused(std::string_view("0 1\n1 \0 2\n", 10), 2, "'\\x00'");
}

TEST(Facets, IdsBeyondTheIndexTypeAreOverTheLimit) {
  EXPECT_THROW((void)read("0 1 9223372036854775807\n"), LimitError);
  if constexpr (sizeof(Index) == 4) {
    EXPECT_THROW((void)read("0 1 2147483647\n"), LimitError);
    EXPECT_EQ(read("0 1 2147483646\n").vertex_count, 2147483647);
  }
}

}  // namespace
}  // namespace derham::io_test
