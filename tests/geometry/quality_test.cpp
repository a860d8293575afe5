#include "derham/geometry/quality.hpp"

#include "derham/geometry/volumes.hpp"
#include "derham/meshes/boxes.hpp"
#include "geometry/mesh_kit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace derham {
namespace {

template <int n>
bool is_degenerate(const MeshData& mesh) {
  const SimplicialComplex<n> K(mesh.simplices);
  return !quality(K, Geometry<n>::from_mesh(K, mesh)).degenerate.empty();
}

TEST(Quality, FlatSliversAreFoundInAnyPositionAndAtAnyScale) {
  const MeshData square = test::single({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, 3);
  const MeshData nearly = test::single({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1e-17}, 3);
  const MeshData needle = test::single({0, 0, 0, 1, 0, 0, 0.5, 1e-6, 0, 0.3, 0.4, 0}, 3);
  const MeshData line = test::single({0, 0, 1, 1, 2, 2}, 2);
  const MeshData coincident = test::single({0, 0, 1, 0, 1, 0}, 2);
  for (std::uint32_t seed = 0; seed < 50; ++seed)
    for (const double scale : {1e-40, 1e-3, 1.0, 1e5, 1e40})
      for (const double shift : {0.0, 1.0, 1e6}) {
        const auto in = [&](const MeshData& mesh, int m) { return test::moved(mesh, m, scale, shift * scale, seed); };
        EXPECT_TRUE(is_degenerate<3>(in(square, 3)));
        EXPECT_TRUE(is_degenerate<3>(in(nearly, 4)));
        EXPECT_TRUE(is_degenerate<3>(in(needle, 3)));
        EXPECT_TRUE(is_degenerate<2>(in(line, 2)));
        EXPECT_TRUE(is_degenerate<2>(in(coincident, 5)));
      }
}

TEST(Quality, ThinSimplicesAreNotFlat) {
  const MeshData thin = test::single({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1e-9}, 3);
  for (std::uint32_t seed = 0; seed < 20; ++seed)
    for (const double scale : {1e-40, 1.0, 1e40})
      EXPECT_FALSE(is_degenerate<3>(test::moved(thin, 3, scale, scale, seed)));
  EXPECT_FALSE(is_degenerate<1>(test::single({0, 1e-150}, 1)));
  EXPECT_TRUE(is_degenerate<1>(test::single({1, 1}, 1)));
}

TEST(Quality, FlatLengthsAreFound) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}, {1, 2, 3}});
  const std::vector<double> squares{1, 1, 4, 4, 4};  // (0,1) (0,2) (1,2) (1,3) (2,3)
  EXPECT_EQ(quality(K, Geometry<2>::from_squared_lengths(K, squares)).degenerate, std::vector<Index>{0});
}

// One interior vertex of Kuhn 3³ pushed far out: its inverted tetrahedra are those with negative volume.
TEST(Quality, InvertedSimplicesAreListedNotBelieved) {
  MeshData mesh = meshes::box(3, 3);
  const Index v = 1 + 4 * (1 + 4 * 1);
  mesh.points[3 * v] += 0.9;
  SimplicialComplex<3> K(mesh.simplices);
  const auto g = Geometry<3>::from_mesh(K, mesh);
  orient_by_volume(K, g);
  const auto report = quality(K, g);
  const auto volume = signed_volumes(K, g);
  std::vector<Index> negative;
  for (Index t = 0; t < K.size(3); ++t)
    if (volume[t] * K.sign(3, t) < 0) negative.push_back(t);
  EXPECT_EQ(report.inverted, negative);
  EXPECT_GT(negative.size(), 0u);
  EXPECT_LT(negative.size(), 24u);
  for (const Index t : negative) {
    const auto s = K.simplex(3, t);
    EXPECT_TRUE(std::find(s.begin(), s.end(), v) != s.end());
  }
}

TEST(Quality, NoInvertedSimplicesOnSurfacesAndSoundMeshes) {
  const MeshData flat = meshes::box(2, 4, {.jitter = 0.4}), curved = test::moved(flat, 3, 1, 0, 2);
  SimplicialComplex<2> K(flat.simplices);
  for (const MeshData* mesh : {&flat, &curved}) {
    const auto g = Geometry<2>::from_mesh(K, *mesh);
    orient_by_volume(K, g);
    const auto report = quality(K, g);
    EXPECT_TRUE(report.inverted.empty());
    EXPECT_TRUE(report.degenerate.empty());
    EXPECT_GT(report.smallest_volume, 0);
    EXPECT_NEAR(report.total_volume, total_volume(K, g), 1e-15);
  }
}

}  // namespace
}  // namespace derham
