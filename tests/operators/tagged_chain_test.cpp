#include "derham/operators/tagged_chain.hpp"

#include "derham/forms/exterior_derivative.hpp"
#include "derham/forms/wedge.hpp"
#include "derham/geometry/volumes.hpp"
#include "derham/io/read_mesh.hpp"
#include "derham/meshes/boxes.hpp"
#include "support/random_forms.hpp"

#include <gtest/gtest.h>

#include <array>

namespace derham {
namespace {

/// The unit cube of 4^3 cells with the disk z = 1/2 tagged, its normal up, the closed curve about it, a slab and points.
MeshData tagged_cube() {
  MeshData mesh = meshes::box(3, 4);
  mesh.lower.resize(3);
  const auto vertex = [](Index x, Index y) { return x + 5 * y + 50; };  // z = 1/2
  MeshPart disk{"disk", 1, 2, {}}, rim{"rim", 2, 1, {}}, slab{"slab", 3, 3, {}}, ends{"ends", 4, 0, {}};
  for (Index y = 0; y < 4; ++y)
    for (Index x = 0; x < 4; ++x) {
      // the diagonals of the box, from the lowest corner; both counter-clockwise, written from different vertices
      mesh.lower[2].push_back({vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1)});
      mesh.lower[2].push_back({vertex(x + 1, y + 1), vertex(x, y + 1), vertex(x, y)});
    }
  for (Index i = 0; i < mesh.lower[2].size(); ++i) disk.members.push_back(i);
  for (Index i = 0; i < 4; ++i) {
    mesh.lower[1].push_back({vertex(i, 0), vertex(i + 1, 0)});
    mesh.lower[1].push_back({vertex(4, i), vertex(4, i + 1)});
    mesh.lower[1].push_back({vertex(i + 1, 4), vertex(i, 4)});
    mesh.lower[1].push_back({vertex(0, i + 1), vertex(0, i)});
  }
  for (Index i = 0; i < mesh.lower[1].size(); ++i) rim.members.push_back(i);
  for (Index i = 0; i < mesh.simplices.size() / 2; ++i) slab.members.push_back(i);
  ends.members = {0, 124};
  mesh.parts = {disk, rim, slab, ends};
  return mesh;
}

/// Coordinates as 0-forms.
std::array<PrimalForm<3, 0>, 3> coordinates(const SimplicialComplex<3>& K, const MeshData& mesh) {
  std::array<PrimalForm<3, 0>, 3> x{PrimalForm<3, 0>(K), PrimalForm<3, 0>(K), PrimalForm<3, 0>(K)};
  for (std::size_t v = 0; v < static_cast<std::size_t>(mesh.vertex_count); ++v)
    for (std::size_t axis = 0; axis < 3; ++axis) x[axis].values()[v] = mesh.points[3 * v + axis];
  return x;
}

TEST(TaggedChain, CirculationAboutTheRimIsTheFluxOfD) {
  const MeshData mesh = tagged_cube();
  const SimplicialComplex<3> K(mesh.simplices);
  const auto disk = tagged_chain<2>(K, mesh, "disk");
  const auto rim = tagged_chain<1>(K, mesh, "rim");
  EXPECT_EQ(boundary(disk), rim);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto w = support::random_integer_form<3, 1>(K, seed);
    EXPECT_EQ(pair(w, rim), pair(d(w), disk));
    EXPECT_NE(pair(w, rim), 0);
  }
}

TEST(TaggedChain, GivesFluxesCirculationsVolumesAndDifferences) {
  const MeshData mesh = tagged_cube();
  SimplicialComplex<3> K(mesh.simplices);
  orient_by_volume(K, Geometry<3>::from_mesh(K, mesh));
  const auto [x, y, z] = coordinates(K, mesh);
  EXPECT_NEAR(pair(wedge(d(x), d(y)), tagged_chain<2>(K, mesh, "disk")), 1, 1e-14) << "flux of ∂z through the disk";
  EXPECT_NEAR(pair(wedge(d(y), d(z)), tagged_chain<2>(K, mesh, "disk")), 0, 1e-14);
  EXPECT_NEAR(pair(wedge(x, d(y)), tagged_chain<1>(K, mesh, "rim")), 1, 1e-14) << "circulation of x ∂y";
  EXPECT_NEAR(pair(wedge(wedge(d(x), d(y)), d(z)), tagged_chain<3>(K, mesh, "slab")), 0.5, 1e-14);
  EXPECT_EQ(pair(x + y + z, tagged_chain<0>(K, mesh, "ends")), 3);
}

TEST(TaggedChain, TurnsWithTheRowsOfTheFile) {
  MeshData mesh = tagged_cube();
  const SimplicialComplex<3> K(mesh.simplices);
  const auto disk = tagged_chain<2>(K, mesh, "disk");
  const auto vertices = mesh.lower[2].vertices();
  for (std::size_t row = 0; row < vertices.size(); row += 3) std::swap(vertices[row], vertices[row + 1]);
  EXPECT_EQ(tagged_chain<2>(K, mesh, "disk"), -disk);
  for (std::size_t row = 6; row < vertices.size(); row += 6) std::swap(vertices[row], vertices[row + 1]);
  EXPECT_NE(boundary(tagged_chain<2>(K, mesh, "disk")), boundary(-disk)) << "oriented at random";
  const auto mended = coherent(tagged_chain<2>(K, mesh, "disk"));
  EXPECT_TRUE(mended == disk || mended == -disk);
}

TEST(TaggedChain, ComesFromAFile) {
  const auto mesh = read_mesh_from_memory(
      "MeshVersionFormatted 2\nDimension 3\nVertices\n5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 -1 0\n"
      "Tetrahedra\n2\n1 2 3 4 1\n1 3 2 5 1\nTriangles\n1\n2 1 3 7\nEdges\n3\n1 3 8\n3 2 8\n2 1 8\nEnd\n",
      MeshFormat::medit, "sample.mesh");
  const SimplicialComplex<3> K(mesh.simplices);
  const auto part = [&](int degree, std::int64_t number) {
    for (const MeshPart& p : mesh.parts)
      if (p.degree == degree && p.number == number) return p;
    return MeshPart{};
  };
  const auto triangle = tagged_chain<2>(K, mesh, part(2, 7));
  EXPECT_EQ(triangle({1, 0, 2}), 1);
  EXPECT_EQ(boundary(triangle), tagged_chain<1>(K, mesh, part(1, 8)));
}

TEST(TaggedChain, NamesThePartsThereAre) {
  const MeshData mesh = tagged_cube();
  const SimplicialComplex<3> K(mesh.simplices);
  try {
    (void)tagged_chain<2>(K, mesh, "disc");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("'disk' (1)"), std::string::npos) << error.what();
  }
  EXPECT_THROW((void)tagged_chain<1>(K, mesh, mesh.parts[0]), InputError) << "a surface is no curve";
  MeshData without = mesh;
  without.lower.clear();
  EXPECT_THROW((void)tagged_chain<2>(K, without, "disk"), InputError);
}

}  // namespace
}  // namespace derham
