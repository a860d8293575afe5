#include "derham/io/mesh_format.hpp"

#include "io/io_fixture.hpp"
#include "io/sample_files.hpp"

namespace derham::io_test {
namespace {

TEST(MeshFormat, NamesAndExtensions) {
  EXPECT_EQ(format_by_extension("a/b.c/x.1.NODE"), MeshFormat::tetgen);
  EXPECT_EQ(format_by_extension("x.ele"), MeshFormat::tetgen);
  EXPECT_EQ(format_by_extension("x.msh"), MeshFormat::gmsh);
  EXPECT_EQ(format_by_extension("x.vtu"), MeshFormat::vtu);
  EXPECT_EQ(format_by_extension("x.off/y"), std::nullopt);
  EXPECT_EQ(format_by_extension("off"), std::nullopt);
  for (const auto& sample : sample_files) EXPECT_EQ(format_by_name(format_name(sample.format)), sample.format);
  EXPECT_EQ(format_by_name("msh"), std::nullopt);
}

TEST(MeshFormat, ContentComesBeforeTheName) {
  EXPECT_EQ(detect_format("x.obj", off_sample), MeshFormat::off);
  EXPECT_EQ(detect_format("x.off", gmsh_sample), MeshFormat::gmsh);
  EXPECT_EQ(detect_format("stdin", obj_sample), MeshFormat::obj);
  EXPECT_EQ(detect_format("stdin", facets_sample), MeshFormat::facets);
  EXPECT_EQ(detect_format("x.node", tetgen_sample), MeshFormat::tetgen);
  EXPECT_EQ(detect_format("x.facets", "# nothing\n"), MeshFormat::facets);
}

TEST(MeshFormat, RefusesWhatItDoesNotKnow) {
  for (const auto* name : {"x.vtp", "x.meshb"}) EXPECT_THROW((void)detect_format(name, "1 2 3\n"), FileError) << name;
  EXPECT_THROW((void)detect_format("x", "hello\n"), FileError);
  EXPECT_THROW((void)detect_format("x", ""), FileError);
  EXPECT_THROW((void)read_mesh_from_memory("1", MeshFormat::vtu, "x"), FileError);
}

}  // namespace
}  // namespace derham::io_test
