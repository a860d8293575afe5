#include "derham/geometry/refined_mesh.hpp"

#include "derham/core/error.hpp"
#include "derham/geometry/volumes.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/classics.hpp"
#include "derham/meshes/tori.hpp"

#include <gtest/gtest.h>

namespace derham {
namespace {

/// Volumes of the rows and of their pieces.
template <int n>
void expect_equal_pieces(const MeshData& mesh, double total) {
  SimplicialComplex<n> K(mesh.simplices, mesh.vertex_count);
  const auto geometry = Geometry<n>::from_mesh(K, mesh);
  orient_by_volume(K, geometry);
  const Refinement<n> refinement(K);
  const MeshData fine = refined_mesh(mesh, refinement);
  const SimplicialComplex<n> L(fine.simplices, fine.vertex_count);
  for (int k = 0; k <= n; ++k)
    ASSERT_TRUE(std::ranges::equal(L.simplices(k), refinement.fine().simplices(k))) << "the same complex";
  EXPECT_EQ(L.orientation().sign, refinement.fine().orientation().sign);
  const auto fine_geometry = Geometry<n>::from_mesh(L, fine);
  const auto volumes = primal_volumes(K, geometry)[n], pieces = primal_volumes(L, fine_geometry)[n];
  for (std::size_t t = 0; t < pieces.size(); ++t) EXPECT_NEAR(pieces[t] * (1 << n), volumes[t >> n], 1e-13 * total);
  EXPECT_NEAR(total_volume(L, fine_geometry), total, 1e-12 * total);
  if (fine_geometry.has_signed_volume()) {
    SimplicialComplex<n> by_volume(fine.simplices, fine.vertex_count);
    orient_by_volume(by_volume, fine_geometry);
    EXPECT_EQ(by_volume.orientation().sign, L.orientation().sign);
  }
}

TEST(RefinedMesh, HasPiecesOfEqualVolume) {
  expect_equal_pieces<1>(meshes::box(1, 4, {.jitter = 0.5}), 1);
  expect_equal_pieces<2>(meshes::box(2, 4, {.jitter = 0.4}), 1);
  expect_equal_pieces<3>(meshes::box(3, 3, {.jitter = 0.3}), 1);
  expect_equal_pieces<4>(meshes::box(4, 2, {.jitter = 0.2}), 1);
  expect_equal_pieces<2>(meshes::periodic_box(2, 3, {.jitter = 0.4}), 1);
  expect_equal_pieces<3>(meshes::periodic_box(3, 3, {.jitter = 0.3}), 1);
  expect_equal_pieces<4>(meshes::periodic_box(4, 3), 1);
}

TEST(RefinedMesh, OfASurfaceInSpaceKeepsItsArea) {
  const MeshData mesh = meshes::torus(7, 5);
  const SimplicialComplex<2> K(mesh.simplices);
  expect_equal_pieces<2>(mesh, total_volume(K, Geometry<2>::from_mesh(K, mesh)));
}

TEST(RefinedMesh, RefinesEdgeLengthsAsPositions) {
  for (const MeshData& mesh : {meshes::box(3, 2, {.jitter = 0.3}), meshes::periodic_box(3, 3, {.jitter = 0.3})}) {
    const SimplicialComplex<3> K(mesh.simplices);
    const Refinement<3> refinement(K);
    MeshData lengths;
    lengths.simplices = mesh.simplices;
    lengths.vertex_count = mesh.vertex_count;
    lengths.edge_lengths_squared = squared_lengths(K, Geometry<3>::from_mesh(K, mesh));
    const auto found = refined_mesh(lengths, refinement).edge_lengths_squared;
    const auto& L = refinement.fine();
    const auto expected = squared_lengths(L, Geometry<3>::from_mesh(L, refined_mesh(mesh, refinement)));
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t e = 0; e < found.size(); ++e) EXPECT_NEAR(found[e], expected[e], 1e-14);
  }
}

TEST(RefinedMesh, CarriesPartsAndFields) {
  MeshData mesh = meshes::box(2, 1);  // (0, 0), (1, 0), (0, 1), (1, 1)
  mesh.lower = {{}, SimplexList{{3, 1}, {0, 1}}};
  mesh.parts = {{"half", 1, 2, {1}}, {"side", 2, 1, {0}}, {"corner", 3, 0, {2}}};
  mesh.fields = {{"x", MeshField::On::vertices, 1, {0, 1, 0, 1}}, {"row", MeshField::On::rows, 2, {1, 2, 3, 4}}};
  mesh.forms = {{"w", 0, false, {1, 2, 3, 4}}};
  const MeshData fine = refined_mesh(mesh);
  EXPECT_EQ(fine.parts[0].members, (std::vector<Index>{4, 5, 6, 7}));
  EXPECT_EQ(fine.parts[1].members, (std::vector<Index>{0, 1}));
  ASSERT_EQ(fine.parts[2].members.size(), 1u);
  const auto corner = static_cast<std::size_t>(fine.parts[2].members[0]);
  EXPECT_EQ(fine.points[2 * corner], 0);
  EXPECT_EQ(fine.points[2 * corner + 1], 1);
  ASSERT_EQ(fine.lower[1].size(), 4);
  for (Offset i = 0; i < 2; ++i) {
    const auto edge = fine.lower[1][i];
    EXPECT_EQ(fine.points[static_cast<std::size_t>(2 * edge[0])], 1) << "still the side x = 1";
    EXPECT_GT(fine.points[static_cast<std::size_t>(2 * edge[0] + 1)],
              fine.points[static_cast<std::size_t>(2 * edge[1] + 1)])
        << "oriented downwards, as it was";
  }
  for (std::size_t v = 0; v < fine.fields[0].values.size(); ++v)
    EXPECT_EQ(fine.fields[0].values[v], fine.points[2 * v]);
  EXPECT_EQ(fine.fields[1].values.size(), 16u);
  EXPECT_EQ(fine.fields[1].values[6], 1);
  EXPECT_EQ(fine.fields[1].values[9], 4);
  EXPECT_EQ(fine.notes.size(), 1u);
}

/// Three refinements of a tetrahedron: 512 pieces of at most three shapes, told apart by their edge lengths.
TEST(RefinedMesh, HasFewShapes) {
  MeshData mesh;
  mesh.simplices = SimplexList{{0, 1, 2, 3}};
  mesh.vertex_count = 4;
  mesh.ambient_dimension = 3;
  mesh.points = {0, 0, 0, 1.1, 0, 0, 0.2, 0.9, 0, 0.3, 0.1, 0.7};
  for (int round = 0; round < 3; ++round) mesh = refined_mesh(mesh);
  ASSERT_EQ(mesh.simplices.size(), 512);
  const auto lengths = meshes::squared_edge_lengths(mesh);
  std::vector<std::vector<double>> shapes;
  for (std::size_t row = 0; row < 512; ++row) {
    std::vector<double> shape(lengths.begin() + static_cast<int>(row) * 6,
                              lengths.begin() + static_cast<int>(row) * 6 + 6);
    std::ranges::sort(shape);
    const bool known = std::ranges::any_of(shapes, [&](const auto& other) {
      return std::ranges::equal(shape, other, [](double a, double b) { return std::abs(a - b) < 1e-12; });
    });
    if (!known) shapes.push_back(shape);
  }
  EXPECT_EQ(shapes.size(), 3u);
}

TEST(RefinedMesh, RefusesWhatDoesNotBelongTogether) {
  const MeshData mesh = meshes::box(2, 2);
  const SimplicialComplex<2> other(meshes::sphere(2));
  EXPECT_THROW((void)refined_mesh(mesh, Refinement<2>(other)), InputError);
  MeshData wrong = mesh;
  wrong.lower = {{}, SimplexList{{0, 8}}};
  EXPECT_THROW((void)refined_mesh(wrong), InputError);
  EXPECT_THROW((void)refined_mesh(MeshData{}), InputError);
}

}  // namespace
}  // namespace derham
