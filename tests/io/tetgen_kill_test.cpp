// A TetGen mesh is in several files, which no process can replace at once: it may be killed before any of its steps.
#include "derham/io/write_mesh.hpp"
#include "io/io_fixture.hpp"

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

int steps_until_kill = -1;  // never

void count_step() {
  if (steps_until_kill >= 0 && steps_until_kill-- == 0) (void)::raise(SIGKILL);
}

}  // namespace

// These two stand before those of the C library, and do the same.
extern "C" int rename(const char* from, const char* to) noexcept {  // NOLINT(readability-*)
  count_step();
  return ::renameat(AT_FDCWD, from, AT_FDCWD, to);
}
extern "C" int unlink(const char* path) noexcept {  // NOLINT(readability-*)
  count_step();
  return ::unlinkat(AT_FDCWD, path, 0);
}

namespace derham::io_test {
namespace {

MeshData two_tetrahedra(double size, bool has_faces, bool has_edges) {
  MeshData mesh;
  mesh.simplices = size < 2 ? SimplexList{{0, 1, 2, 3}, {1, 2, 3, 4}} : SimplexList{{0, 1, 2, 4}, {0, 2, 3, 4}};
  mesh.vertex_count = 5;
  mesh.ambient_dimension = 3;
  mesh.points = {0, 0, 0, size, 0, 0, 0, size, 0, 0, 0, size, size, size, size};
  const int first = size < 2 ? 0 : 2;
  if (has_edges || has_faces) mesh.lower.resize(has_faces ? 3 : 2);
  if (has_edges) mesh.lower[1] = SimplexList{{static_cast<Index>(first), 4}};
  if (has_faces) mesh.lower[2] = SimplexList{{static_cast<Index>(first), 3, 4}};
  return mesh;
}

bool are_same(const MeshData& a, const MeshData& b) {
  return a.simplices == b.simplices && a.points == b.points && a.lower == b.lower;
}

// Whether the writer was killed; if not, it had fewer steps.
bool is_killed_at(int step, const std::string& path, const MeshData& mesh) {
  const auto child = ::fork();
  if (child == 0) {
    steps_until_kill = step;
    write_mesh(path, mesh);
    ::_exit(0);
  }
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  return WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
}

TEST(TetgenKilledWriter, LeavesTheOldMeshNoneOrTheNew) {
  for (const int kinds : {0, 3, 6, 9, 12, 15}) {  // bits: faces and edges of the old mesh, of the new one
    const auto old_mesh = two_tetrahedra(1, (kinds & 1) != 0, (kinds & 2) != 0);
    const auto new_mesh = two_tetrahedra(2, (kinds & 4) != 0, (kinds & 8) != 0);
    int as_old = 0, absent = 0;
    for (int step = 0;; ++step) {
      const TemporaryDirectory directory;
      const auto path = directory / "a.node";
      write_mesh(path, old_mesh);
      const bool is_killed = is_killed_at(step, path, new_mesh);
      if (!std::filesystem::exists(directory / "a.ele")) {
        ++absent;
        EXPECT_TRUE(is_killed);
        EXPECT_THROW((void)read_mesh(path), FileError);
        continue;
      }
      const auto found = read_mesh(path);
      as_old += are_same(found, old_mesh);
      EXPECT_TRUE(are_same(found, old_mesh) || are_same(found, new_mesh)) << "step " << step << ", kinds " << kinds;
      if (is_killed) continue;
      EXPECT_TRUE(are_same(found, new_mesh));
      break;
    }
    EXPECT_EQ(as_old, 1);  // killed before the first step
    EXPECT_GE(absent, 2);  // before each later one
  }
}

TEST(TetgenKilledWriter, WhatCannotBeReplacedIsRefusedBeforeAnythingIsLost) {
  for (const bool is_written : {false, true})
    for (const auto* obstacle : {"a.face", "a.edge", "a.ele", "a.node"}) {
      const TemporaryDirectory directory;
      write_mesh(directory / "a.node", two_tetrahedra(1, false, false));
      std::filesystem::remove(directory / obstacle);
      std::filesystem::create_directory(directory / obstacle);
      const auto count = directory.file_count();
      const auto contents = [&] {
        std::vector<std::string> out;
        for (const auto* name : {"a.node", "a.ele"})
          if (std::filesystem::is_regular_file(directory / name)) out.push_back(read_bytes(directory / name));
        return out;
      };
      const auto before = contents();
      EXPECT_THROW(write_mesh(directory / "a.node", two_tetrahedra(2, is_written, is_written)), FileError) << obstacle;
      EXPECT_EQ(directory.file_count(), count) << obstacle;
      EXPECT_TRUE(std::filesystem::is_directory(directory / obstacle)) << obstacle;
      EXPECT_EQ(contents(), before) << obstacle;
    }
}

TEST(TetgenKilledWriter, KeepsALinkToTheSimplices) {
  const TemporaryDirectory directory;
  const auto new_mesh = two_tetrahedra(2, true, false);
  write_mesh(directory / "a.node", two_tetrahedra(1, false, true));
  std::filesystem::rename(directory / "a.ele", directory / "target");
  std::filesystem::create_symlink("target", directory / "a.ele");
  write_mesh(directory / "a.node", new_mesh);
  EXPECT_TRUE(std::filesystem::is_symlink(directory / "a.ele"));
  EXPECT_TRUE(are_same(read_mesh(directory / "a.node"), new_mesh));
}

}  // namespace
}  // namespace derham::io_test
