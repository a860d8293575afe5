#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/error.hpp"
#include "derham/meshes/classics.hpp"
#include "support/face_sets.hpp"

#include <gtest/gtest.h>

namespace derham {
namespace {

using test::f_vector;
using Counts = std::vector<Offset>;

TEST(Classics, HaveTheKnownCounts) {
  EXPECT_EQ(f_vector(meshes::cycle(3)), (Counts{3, 3}));
  EXPECT_EQ(f_vector(meshes::path(4)), (Counts{5, 4}));
  EXPECT_EQ(f_vector(meshes::sphere(4)), (Counts{6, 15, 20, 15, 6}));
  EXPECT_EQ(f_vector(meshes::projective_plane()), (Counts{6, 15, 10}));
  EXPECT_EQ(f_vector(meshes::klein_bottle()), (Counts{8, 24, 16}));
  EXPECT_EQ(f_vector(meshes::csaszar_torus()), (Counts{7, 21, 14}));
  EXPECT_EQ(f_vector(meshes::moebius_strip()), (Counts{5, 10, 5}));
  EXPECT_EQ(f_vector(meshes::annulus()), (Counts{6, 12, 6}));
  EXPECT_EQ(f_vector(meshes::complex_projective_plane()), (Counts{9, 36, 84, 90, 36}));
  EXPECT_EQ(f_vector(meshes::poincare_sphere()), (Counts{16, 106, 180, 90}));
  EXPECT_EQ(f_vector(meshes::grid_torus(3)), (Counts{27, 189, 324, 162}));
  EXPECT_EQ(f_vector(meshes::grid_torus(4)), (Counts{81, 1215, 4050, 4860, 1944}));
}

TEST(Classics, AreClosedOrNot) {
  for (const SimplexList& M : {meshes::cycle(3), meshes::projective_plane(), meshes::klein_bottle(),
                               meshes::csaszar_torus(), meshes::complex_projective_plane(), meshes::grid_torus(2, 5)})
    EXPECT_TRUE(test::is_closed(M));
  EXPECT_EQ(f_vector(test::boundary_facets(meshes::moebius_strip())), (Counts{5, 5}));
  EXPECT_EQ(f_vector(test::boundary_facets(meshes::annulus())), (Counts{6, 6}));
}

TEST(Classics, AreOrientableOrNot) {
  for (const SimplexList& M : {meshes::csaszar_torus(), meshes::annulus(), meshes::sphere(2)}) {
    EXPECT_TRUE(SimplicialComplex<2>(M).is_orientable());
    EXPECT_TRUE(test::is_coherent(M));
  }
  for (const SimplexList& M : {meshes::projective_plane(), meshes::klein_bottle(), meshes::moebius_strip()})
    EXPECT_FALSE(SimplicialComplex<2>(M).is_orientable());
  EXPECT_TRUE(SimplicialComplex<4>(meshes::complex_projective_plane()).is_orientable());
}

TEST(LensSpace, IsAClosedOrientableManifoldOfTheRightSize) {
  EXPECT_EQ(f_vector(meshes::lens_space(3, 1)), (Counts{120, 768, 1296, 648}));
  for (const auto& [p, q] : {std::pair{1, 0}, {2, 1}, {3, 1}, {3, -1}, {5, 2}, {7, 3}}) {
    const SimplexList L = meshes::lens_space(p, q);
    EXPECT_EQ(L.size(), 24 * 9 * p);
    EXPECT_TRUE(test::is_closed(L)) << p;
    EXPECT_TRUE(test::is_coherent(L)) << p;
    EXPECT_EQ(test::euler_characteristic(L), 0) << p;
    // The rotation acts freely, so every degree has a p-th of the simplices of the subdivided join.
    const Offset s = 3 * p;  // f of the subdivided join of two s-gons
    const Counts join{2 * s, 2 * s + s * s, 2 * s * s, s * s};
    EXPECT_EQ(f_vector(L)[0] * p, join[0] + join[1] + join[2] + join[3]) << p;
    EXPECT_EQ(f_vector(L)[2] * p, 2 * 24 * s * s) << p;
  }
  EXPECT_THROW((void)meshes::lens_space(0, 1), InputError);
  EXPECT_THROW((void)meshes::lens_space(4, 2), InputError);
}

TEST(Classics, RefuseSenselessSizes) {
  EXPECT_THROW((void)meshes::cycle(2), InputError);
  EXPECT_THROW((void)meshes::path(0), InputError);
  EXPECT_THROW((void)meshes::sphere(7), InputError);
  EXPECT_THROW((void)meshes::grid_torus(2, 2), InputError);
}

}  // namespace
}  // namespace derham
