#include "derham/io/write_mesh.hpp"
#include "io/io_fixture.hpp"
#include "io/sample_files.hpp"

#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace derham::io_test {
namespace {

TEST(ReadMesh, SaysWhyAFileCannotBeOpened) {
  const TemporaryDirectory directory;
  const auto message = [](const std::string& path) {
    try {
      (void)read_mesh(path);
    } catch (const FileError& error) {
      EXPECT_EQ(error.path(), path);
      EXPECT_EQ(error.line(), 0);
      EXPECT_STREQ(error.kind(), "read");
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_NE(message(directory / "absent.off").find("No such file"), std::string::npos);
  EXPECT_NE(message(directory / ".").find("directory"), std::string::npos);
  write_bytes(directory / "empty.off", "");
  EXPECT_NE(message(directory / "empty.off").find("empty"), std::string::npos);
}

TEST(ReadMesh, ADeviceNeedNotEnd) {
  EXPECT_THROW((void)read_mesh("/dev/zero", MeshFormat::facets), LimitError);
  EXPECT_TRUE(read_mesh("/dev/null", MeshFormat::facets).simplices.empty());
}

TEST(ReadMesh, CarriageReturnsOnlyBeforeNewlines) {
  const std::string obj = "# made by x\rv 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r";
  expect_refused(obj, MeshFormat::obj, 1, "carriage return");
  expect_refused("0 1 2\n1 2 3\r2 3 4\n", MeshFormat::facets, 2, "carriage return");
  expect_refused("# c\r\r0 1 2\n", MeshFormat::facets, 1, "carriage return");
  EXPECT_EQ(read_mesh_from_memory("0 1 2\r\n1 2 3\r\r\n\r\n2 3 4\r", MeshFormat::facets, "x").simplices.size(), 3);
}

TEST(ReadMesh, OnlyPlanarMeshesAreFlattened) {
  MeshData flat;
  flat.ambient_dimension = 3;
  flat.vertex_count = 4;
  flat.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  flat.simplices = SimplexList{{0, 1, 2, 3}};
  EXPECT_FALSE(flatten_plane(flat));
  flat.simplices = SimplexList{{0, 1, 2}, {1, 2, 3}};
  EXPECT_TRUE(flatten_plane(flat));
  EXPECT_EQ(flat.points, (std::vector<double>{0, 0, 1, 0, 0, 1, 1, 1}));
}

TEST(ReadMesh, ReadsAPipe) {
  const TemporaryDirectory directory;
  const auto path = directory / "pipe";
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  // Longer than the first guess of the buffer, so that it must grow.
  std::string bytes;
  for (int i = 0; i < 30000; ++i) bytes += std::to_string(i) + " " + std::to_string(i + 1) + "\n";
  std::thread writer([&] { write_bytes(path, bytes); });
  const auto mesh = read_mesh(path);
  writer.join();
  EXPECT_EQ(mesh.simplices.size(), 30000);
  EXPECT_EQ(mesh.vertex_count, 30001);
}

TEST(ReadMesh, ReadsStandardInput) {
  const TemporaryDirectory directory;
  write_bytes(directory / "mesh", tetgen_sample);
  const int kept = dup(STDIN_FILENO);
  const int file = open((directory / "mesh").c_str(), O_RDONLY);
  ASSERT_GE(file, 0);
  ASSERT_GE(dup2(file, STDIN_FILENO), 0);
  EXPECT_EQ(read_mesh("-", MeshFormat::tetgen).simplices.size(), 2);
  ASSERT_GE(lseek(STDIN_FILENO, 0, SEEK_SET), 0);
  try {
    (void)read_mesh("-", MeshFormat::gmsh);
    ADD_FAILURE();
  } catch (const FileError& error) {
    EXPECT_EQ(error.path(), "stdin");
  }
  dup2(kept, STDIN_FILENO);
  close(kept);
  close(file);
}

// Every mesh of a folder that nobody prepared is read, and the same after it was written in derham's own format.
TEST(ReadMesh, MeshesOfOthers) {
  const char* folder = std::getenv("DERHAM_MESHES");
  if (folder == nullptr) GTEST_SKIP() << "DERHAM_MESHES names no folder of meshes";
  const TemporaryDirectory directory;
  int read = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string path = entry.path().string();
    if (!entry.is_regular_file() || !format_by_extension(path)) continue;
    SCOPED_TRACE(path);
    const auto mesh = read_mesh(path, {}, {.triangulate = true, .corner_nodes = true});
    EXPECT_FALSE(mesh.simplices.empty());
    const auto copy = directory / "copy.npz";
    write_mesh(copy, mesh);
    const auto again = read_mesh(copy);
    EXPECT_EQ(again.simplices, mesh.simplices);
    EXPECT_EQ(again.points, mesh.points);
    EXPECT_EQ(again.lower_count(), mesh.lower_count());
    EXPECT_EQ(again.parts, mesh.parts);
    EXPECT_EQ(again.fields, mesh.fields);
    ++read;
  }
  EXPECT_GT(read, 0) << "no mesh in " << folder;
}

}  // namespace
}  // namespace derham::io_test
