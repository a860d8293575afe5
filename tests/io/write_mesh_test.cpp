#include "derham/io/write_mesh.hpp"

#include "io/io_fixture.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace derham::io_test {
namespace {

// Random rows of dimension n on random points of R^m, over the whole range of doubles.
MeshData random_mesh(int n, int m, unsigned seed) {
  std::mt19937_64 random(seed);
  MeshData mesh;
  mesh.vertex_count = 50;
  mesh.ambient_dimension = m;
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-1060, 1000);
  for (int i = 0; i < mesh.vertex_count * m; ++i) mesh.points.push_back(std::ldexp(mantissa(random), exponent(random)));
  mesh.points[0] = -0.0;
  mesh.points[1] = std::numeric_limits<double>::denorm_min();
  std::vector<Index> ids;
  for (int i = 0; i < 40 * (n + 1); ++i) ids.push_back(static_cast<Index>(random() % 50));
  mesh.simplices = SimplexList(n, ids);
  return mesh;
}

struct RoundTrip {
  const char* extension;
  int n, m, read_m;
};

class WriteMesh : public ::testing::TestWithParam<RoundTrip> {};

TEST_P(WriteMesh, ReadsBackToTheSameBits) {
  const auto [extension, n, m, read_m] = GetParam();
  const TemporaryDirectory directory;
  const auto path = directory / (std::string("mesh.") + extension);
  const auto mesh = random_mesh(n, m, 3);
  write_mesh(path, mesh);
  const auto back = read_mesh(path);
  EXPECT_EQ(back.simplices, mesh.simplices);
  EXPECT_EQ(back.vertex_count, mesh.vertex_count);
  EXPECT_EQ(back.ambient_dimension, read_m);
  ASSERT_EQ(back.points.size(), static_cast<std::size_t>(mesh.vertex_count * read_m));
  for (int i = 0; i < mesh.vertex_count; ++i)
    for (int axis = 0; axis < read_m; ++axis) {
      const double read = back.points[static_cast<std::size_t>(i * read_m + axis)];
      const double written = axis < m ? mesh.points[static_cast<std::size_t>(i * m + axis)] : 0.0;
      EXPECT_EQ(read, written);
      EXPECT_EQ(std::signbit(read), std::signbit(written));
    }
}

INSTANTIATE_TEST_SUITE_P(
    Formats, WriteMesh,
    ::testing::Values(RoundTrip{"node", 3, 3, 3}, RoundTrip{"ele", 2, 2, 2}, RoundTrip{"ele", 2, 3, 3},
                      RoundTrip{"msh", 3, 3, 3}, RoundTrip{"msh", 2, 2, 3}, RoundTrip{"msh", 1, 3, 3},
                      RoundTrip{"msh", 0, 1, 3}, RoundTrip{"mesh", 3, 3, 3}, RoundTrip{"mesh", 2, 2, 2},
                      RoundTrip{"mesh", 1, 1, 2}, RoundTrip{"off", 2, 3, 3}, RoundTrip{"off", 1, 2, 3},
                      RoundTrip{"obj", 2, 3, 3}, RoundTrip{"obj", 1, 2, 3}, RoundTrip{"obj", 0, 3, 3},
                      RoundTrip{"ply", 2, 3, 3}, RoundTrip{"ply", 1, 2, 3}, RoundTrip{"ply", 0, 3, 3}),
    [](const auto& test) {
      return std::string(test.param.extension) + std::to_string(test.param.n) + "in" + std::to_string(test.param.m);
    });

TEST(WriteMeshFacets, HoldsAnyComplex) {
  const TemporaryDirectory directory;
  MeshData mesh;
  mesh.simplices = SimplexList{{0, 1, 2, 3, 4, 5, 6}, {3, 7}, {8}};
  mesh.vertex_count = 9;
  write_mesh(directory / "a.facets", mesh);
  EXPECT_EQ(read_bytes(directory / "a.facets"), "0 1 2 3 4 5 6\n3 7\n8\n");
  EXPECT_EQ(read_mesh(directory / "a.facets").simplices, mesh.simplices);
}

TEST(WriteMeshRefusals, FieldsOfOneNameAreRefusedWhereTheyAreWritten) {
  const TemporaryDirectory directory;
  auto mesh = random_mesh(2, 3, 1);
  mesh.fields = {{"u", MeshField::On::vertices, 1, std::vector<double>(50, 1)},
                 {"u", MeshField::On::rows, 1, std::vector<double>(40, 2)}};
  for (const auto* name : {"a.vtk", "a.vtu", "a.npz", "a.ply", "a.msh"}) {
    write_mesh(directory / name, mesh);
    EXPECT_EQ(read_mesh(directory / name).fields, mesh.fields) << name;
  }
  mesh.fields.push_back(mesh.fields[0]);
  for (const auto* name : {"b.vtk", "b.vtu", "b.npz", "b.ply", "b.msh", "b.ele"}) {
    try {
      write_mesh(directory / name, mesh);
      ADD_FAILURE() << name;
    } catch (const InputError& error) {
      EXPECT_STREQ(error.what(), "two fields on vertices are called 'u'; give one another name") << name;
    }
  }
  write_mesh(directory / "c.off", mesh);
  EXPECT_EQ(not_carried(mesh, MeshFormat::off), std::vector<std::string>{"format off does not hold fields (3)"});
}

TEST(WriteMeshRefusals, NameFormatsThatHoldTheMesh) {
  const TemporaryDirectory directory;
  const auto message = [&](const MeshData& mesh) -> std::string {
    try {
      write_mesh(directory / "a.off", mesh);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const auto mesh = random_mesh(2, 4, 1);
  EXPECT_EQ(message(mesh),
            "format off holds positions in at most 3 dimensions, this mesh has 4; .facets holds any "
            "complex without positions, .npz this mesh with them");
  write_mesh(directory / "a.npz", mesh);
  MeshData mixed;
  mixed.simplices = SimplexList{{0, 1, 2}, {2, 3}};
  mixed.vertex_count = 4;
  EXPECT_TRUE(message(mixed).ends_with("; .facets holds any complex without positions")) << message(mixed);
}

TEST(WriteMesh, AnEmptyMeshComesBack) {
  const TemporaryDirectory directory;
  for (const auto* name :
       {"a.obj", "a.off", "a.ply", "a.stl", "a.msh", "a.mesh", "a.vtk", "a.vtu", "a.facets", "a.npz"}) {
    write_mesh(directory / name, MeshData());
    const auto back = read_mesh(directory / name);
    EXPECT_TRUE(back.simplices.empty()) << name;
    EXPECT_EQ(back.vertex_count, 0) << name;
  }
}

TEST(WriteMeshRefusals, SayWhatTheFormatHolds) {
  const TemporaryDirectory directory;
  const auto refused = [&](const char* name, const MeshData& mesh) {
    EXPECT_THROW(write_mesh(directory / name, mesh), InputError) << name;
  };
  auto mesh = random_mesh(3, 3, 1);
  refused("a.off", mesh);
  refused("a.obj", mesh);
  refused("a.ply", mesh);
  refused("a", mesh);
  for (const auto* name : {"a.node", "a.msh", "a.mesh", "a.off", "a.obj", "a.vtu"}) {
    refused(name, random_mesh(4, 4, 1));
    refused(name, random_mesh(2, 4, 1));
    MeshData abstract;
    abstract.simplices = SimplexList{{0, 1, 2}};
    abstract.vertex_count = 3;
    refused(name, abstract);
  }
  refused("a.node", random_mesh(1, 2, 1));
  MeshData periodic = random_mesh(2, 2, 1);
  periodic.points.clear();
  periodic.corners.resize(40 * 3 * 2);
  for (const auto* name : {"a.node", "a.msh", "a.off", "a.obj"}) refused(name, periodic);
  mesh.points.pop_back();
  refused("a.msh", mesh);
  mesh = random_mesh(3, 3, 1);
  mesh.simplices.vertices()[5] = 50;
  refused("a.facets", mesh);
  EXPECT_EQ(directory.file_count(), 0);
}

}  // namespace
}  // namespace derham::io_test
