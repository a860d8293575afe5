#include "io/io_fixture.hpp"
#include "io/sample_files.hpp"

#include <cstdlib>
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

TEST(ReadMesh, ReadsMeshesOfOthers) {
  const char* folder = std::getenv("DERHAM_SHARED_MESHES");
  if (folder == nullptr) GTEST_SKIP() << "DERHAM_SHARED_MESHES is not set";
  const auto expect = [&](const std::string& name, int n, int m, Index vertices, Offset rows, Offset lower) {
    const auto mesh = read_mesh(std::string(folder) + "/" + name);
    EXPECT_EQ(mesh.simplices.dimension(), n) << name;
    EXPECT_EQ(mesh.ambient_dimension, m) << name;
    EXPECT_EQ(mesh.vertex_count, vertices) << name;
    EXPECT_EQ(mesh.simplices.size(), rows) << name;
    EXPECT_EQ(mesh.lower_count(), lower) << name;
  };
  expect("cavity2d.ele", 2, 2, 191, 336, 0);
  expect("spot_tets.node", 3, 3, 36917, 173613, 0);
  expect("torus_tet.node", 3, 3, 204, 592, 0);
  expect("nested_cubes.msh", 3, 3, 138, 520, 240);
  expect("sphere.mesh", 3, 3, 4505, 24013, 2880);
  expect("sphere66.off", 2, 3, 66, 128, 0);
  expect("three_holes.obj", 2, 3, 1987, 3982, 0);
  expect("hourglass_ico.obj", 2, 3, 23, 40, 0);
  EXPECT_THROW((void)read_mesh(std::string(folder) + "/moebius.obj"), FileError);
  EXPECT_EQ(read_mesh(std::string(folder) + "/moebius.obj", {}, {.triangulate = true}).simplices.dimension(), 2);
  expect("spot.ply", 2, 3, 2930, 5856, 0);
  expect("bob_small.ply", 2, 3, 250, 500, 0);
  expect("box_ascii.stl", 2, 3, 8, 12, 0);
  expect("box_binary.stl", 2, 3, 8, 12, 0);
}

}  // namespace
}  // namespace derham::io_test
