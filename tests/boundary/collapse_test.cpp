#include "derham/boundary/collapse.hpp"

#include "derham/boundary/small_homology.hpp"
#include "derham/core/error.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/classics.hpp"
#include "derham/meshes/constructions.hpp"

#include <gtest/gtest.h>

#include <array>

namespace derham {
namespace {

template <int n>
bool ball(const SimplexList& rows) {
  return collapses_to_point(SimplicialComplex<n>(rows), Puncture::none, 4);
}
template <int n>
bool sphere(const SimplexList& rows) {
  return collapses_to_point(SimplicialComplex<n>(rows), Puncture::one_top_simplex, 4);
}

TEST(Collapse, CertifiesBalls) {
  EXPECT_TRUE(ball<0>({{0}}));
  EXPECT_TRUE(ball<1>(meshes::path(7)));
  EXPECT_TRUE(ball<3>(meshes::box(3, 4).simplices));
  EXPECT_TRUE(ball<4>(meshes::box(4, 2).simplices));
  EXPECT_TRUE(ball<6>(meshes::cone(meshes::sphere(5))));
}

TEST(Collapse, CertifiesSpheres) {
  EXPECT_TRUE(sphere<0>(meshes::sphere(0)));
  EXPECT_TRUE(sphere<2>(meshes::sphere(2)));
  EXPECT_TRUE(sphere<4>(meshes::suspension(meshes::suspension(meshes::sphere(2)))));
  EXPECT_TRUE(sphere<3>(meshes::join(meshes::cycle(40), meshes::cycle(50))));
  EXPECT_TRUE(sphere<3>(meshes::barycentric_subdivision(meshes::barycentric_subdivision(meshes::sphere(3)))));
}

TEST(Collapse, NeverCertifiesWhatIsNeither) {
  EXPECT_FALSE(ball<0>(meshes::sphere(0)));
  EXPECT_FALSE(ball<3>(meshes::sphere(3)));
  EXPECT_FALSE(ball<2>(meshes::annulus()));
  EXPECT_FALSE(ball<2>(meshes::moebius_strip()));
  EXPECT_FALSE(ball<2>({{0, 1, 2}, {3, 4, 5}}));
  EXPECT_FALSE(sphere<2>(meshes::csaszar_torus()));
  EXPECT_FALSE(sphere<2>(meshes::projective_plane()));
  EXPECT_FALSE(sphere<3>(meshes::lens_space(3, 1)));
  EXPECT_FALSE(sphere<3>(meshes::disjoint_union(meshes::sphere(3), meshes::sphere(3))));
  EXPECT_FALSE(ball<3>(SimplexList{}));
}

/// A disc with its boundary glued to one circle as a a a^-1: contractible, but without a free edge.
TEST(Collapse, StopsAtTheDunceHat) {
  constexpr std::array<Index, 9> outer{0, 1, 2, 0, 1, 2, 0, 2, 1};
  SimplexList hat;
  for (Index i = 0; i < 9; ++i) {
    const Index j = (i + 1) % 9, a = outer[static_cast<std::size_t>(i)], b = outer[static_cast<std::size_t>(j)];
    hat.push_back({a, b, 3 + i});
    hat.push_back({b, 3 + i, 3 + j});
    hat.push_back({3 + i, 3 + j, 12});
  }
  const SimplicialComplex<2> K(hat);
  EXPECT_TRUE(is_homology_of_point(small_homology(K)));
  EXPECT_FALSE(collapses_to_point(K, Puncture::none, 4));
}

TEST(Collapse, RefusesZeroAttempts) {
  const SimplicialComplex<2> K(meshes::sphere(2));
  EXPECT_THROW(static_cast<void>(collapses_to_point(K, Puncture::none, 0)), InputError);
}

}  // namespace
}  // namespace derham
