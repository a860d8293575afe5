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

TEST(MeshFormat, TetgenIsKnownByItsRecords) {
  const auto detected = [](const char* bytes) { return detect_format("stdin", bytes); };
  EXPECT_EQ(detected("4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n1 4 0\n1 1 2 3 4\n"), MeshFormat::tetgen);
  EXPECT_EQ(detected("3 2 1 1\n0 0 0 0.5 1\n1 1 0 0.5 1\n2 0 1 0.5 1\n"), MeshFormat::tetgen);
  EXPECT_EQ(detected("# .ele\n3 4 0\n0 0 1 2 3\n1 1 2 3 4\n2 2 3 4 5\n"), MeshFormat::tetgen);
  EXPECT_EQ(detected("3 4 0\n0 0 1 2 3\n1 1 2 3 4\n3 2 3 4 5\n"), MeshFormat::facets);  // not numbered
  EXPECT_EQ(detected("1 2\n0 1 2\n"), MeshFormat::facets);                              // could be either
  EXPECT_EQ(detected("5 2 0\n1 2 3\n2 3 4\n3 4 0\n"), MeshFormat::facets);              // fewer than it counts
}

TEST(MeshFormat, TheTitleOfAVtkFileSaysNothing) {
  for (const std::string title : {"$x", "MeshVersionFormatted 2", "OFF", "ply"})
    EXPECT_EQ(detect_format("x", "# vtk DataFile Version 3.0\n" + title + "\nASCII\n"), MeshFormat::vtk) << title;
}

TEST(MeshFormat, RefusesWhatItDoesNotKnow) {
  EXPECT_THROW((void)detect_format("x.vtp", "1 2 3\n"), FileError);
  try {
    (void)detect_format("x.meshb", std::string_view("\1\0\0\0\2\0\0\0", 8));
    ADD_FAILURE();
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("binary Medit files (.meshb); convert it to .mesh"), std::string::npos);
  }
  EXPECT_THROW((void)detect_format("x", "hello\n"), FileError);
  EXPECT_THROW((void)detect_format("x", ""), FileError);
  EXPECT_THROW((void)read_mesh_from_memory("1", MeshFormat::vtu, "x"), FileError);
}

}  // namespace
}  // namespace derham::io_test
