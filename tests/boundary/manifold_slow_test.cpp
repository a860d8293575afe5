#include "derham/boundary/manifold.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/classics.hpp"
#include "derham/meshes/constructions.hpp"

#include <gtest/gtest.h>

namespace derham {
namespace {

template <int n>
void expect_proven(const SimplexList& rows, Index tops, bool closed) {
  const SimplicialComplex<n> K(rows);
  EXPECT_EQ(K.size(n), tops);
  const ManifoldReport report = check_manifold(K);
  EXPECT_EQ(report.verdict, Verdict::yes);
  EXPECT_EQ(report.closed, closed);
}

TEST(ManifoldSlow, SubdividedFourTorus) {
  expect_proven<4>(meshes::barycentric_subdivision(meshes::grid_torus(4)), 233280, true);
}

TEST(ManifoldSlow, SubdividedFourBox) {
  expect_proven<4>(meshes::barycentric_subdivision(meshes::box(4, 2).simplices), 46080, false);
}

TEST(ManifoldSlow, AMillionTets) { expect_proven<3>(meshes::box(3, 55).simplices, 998250, false); }

/// One edge in very many tets, and one vertex with a very large link: nothing is quadratic in the size of a star.
TEST(ManifoldSlow, HugeStars) {
  SimplexList fan;
  const Index size = 1000000;
  for (Index i = 0; i < size; ++i) fan.push_back({0, 1, 2 + i, 2 + (i + 1) % size});
  expect_proven<3>(fan, size, false);
  expect_proven<4>(meshes::cone(meshes::box(3, 20).simplices), 48000, false);
}

}  // namespace
}  // namespace derham
