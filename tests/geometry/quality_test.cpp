#include "derham/geometry/quality.hpp"

#include "derham/geometry/volumes.hpp"
#include "derham/meshes/boxes.hpp"
#include "geometry/mesh_kit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

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

// The same vertex pushed by 3/2 of an edge: in units of 1/6 all coordinates are whole, and so are the determinants.
TEST(Quality, SixOfTheKuhnTetrahedraInvertWhenAVertexIsPushedOut) {
  MeshData mesh = meshes::box(3, 3);
  using Point = std::array<long, 3>;
  std::vector<Point> before, after;
  for (std::size_t i = 0; i < mesh.points.size(); i += 3)
    before.push_back(
        {std::lround(6 * mesh.points[i]), std::lround(6 * mesh.points[i + 1]), std::lround(6 * mesh.points[i + 2])});
  after = before;
  const auto pushed = static_cast<std::size_t>(std::ranges::find(before, Point{2, 2, 2}) - before.begin());
  ASSERT_LT(pushed, before.size());
  after[pushed] = {5, 2, 2};
  mesh.points[3 * pushed] = 5. / 6;
  const auto determinant = [](const std::vector<Point>& points, std::span<const Index> tet) {
    std::array<Point, 3> e;
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t axis = 0; axis < 3; ++axis) e[j][axis] = points[tet[j + 1]][axis] - points[tet[0]][axis];
    return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
  };

  SimplicialComplex<3> K(mesh.simplices);
  ASSERT_EQ(K.size(3), 162);
  std::vector<Index> inverted;
  std::vector<int> about(static_cast<std::size_t>(K.size(2)), 0);  // inverted cofaces of each face
  for (Index t = 0; t < K.size(3); ++t) {
    if (determinant(before, K.simplex(3, t)) * determinant(after, K.simplex(3, t)) >= 0) continue;
    inverted.push_back(t);
    for (const Index face : K.faces(3, t)) ++about[static_cast<std::size_t>(face)];
  }
  EXPECT_EQ(inverted.size(), 6U);
  EXPECT_EQ(std::ranges::count(about, 1), 12) << "faces that would not cancel if these signs were believed";

  const auto g = Geometry<3>::from_mesh(K, mesh);
  orient_by_volume(K, g);
  EXPECT_EQ(quality(K, g).inverted, inverted);
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
