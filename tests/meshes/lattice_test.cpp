#include "derham/core/error.hpp"
#include "derham/meshes/lattices.hpp"
#include "support/mesh_measures.hpp"

#include <gtest/gtest.h>

namespace derham {
namespace {

using test::f_vector;

TEST(Bcc, HasTheKnownCountsAndStars) {
  const MeshData mesh = meshes::bcc_lattice(3);
  EXPECT_EQ(f_vector(mesh.simplices), (std::vector<Offset>{2 * 27, 14 * 27, 24 * 27, 12 * 27}));
  EXPECT_EQ(mesh.vertex_count, 54);
  EXPECT_TRUE(test::is_closed(mesh.simplices));
  EXPECT_TRUE(test::is_coherent(mesh.simplices));
  EXPECT_NEAR(test::total_volume(mesh), 27, 1e-12);
  EXPECT_GT(test::smallest_volume(mesh), 0);
  Offset long_edges = 0;
  for (const auto& [face, measure] : test::measures(mesh)) {
    EXPECT_GT(measure.smallest_part, 0);
    const double star = measure.dual / measure.primal;
    if (face.size() == 1) {
      EXPECT_NEAR(star, 0.5, 1e-12);
    }
    if (face.size() == 2) {
      const bool is_long = measure.primal > 0.95;
      long_edges += is_long;
      EXPECT_NEAR(measure.primal, is_long ? 1 : std::sqrt(3) / 2, 1e-12);
      EXPECT_NEAR(star, is_long ? 0.125 : 0.375, 1e-12);
    }
    if (face.size() == 3) {
      EXPECT_NEAR(star, 1, 1e-12);
    }
    if (face.size() == 4) {
      EXPECT_NEAR(star, 12, 1e-12);
    }
  }
  EXPECT_EQ(long_edges, 6 * 27);
}

TEST(Bcc, Scales) { EXPECT_NEAR(test::total_volume(meshes::bcc_lattice(4, 0.25)), 1, 1e-13); }

TEST(AStarLattice, HasPositiveDualVolumesInEveryDegree) {
  for (int n = 1; n <= 4; ++n) {
    const MeshData mesh = meshes::a_star_lattice(n, 3);
    EXPECT_TRUE(test::is_closed(mesh.simplices));
    EXPECT_TRUE(test::is_coherent(mesh.simplices));
    EXPECT_GT(test::smallest_volume(mesh), 0);
    EXPECT_NEAR(test::total_volume(mesh), std::pow(3, n) / std::sqrt(n + 1), 1e-10);
    std::vector<double> products(static_cast<std::size_t>(n) + 1);
    for (const auto& [face, measure] : test::measures(mesh)) {
      EXPECT_GT(measure.smallest_part, 1e-6);
      products[face.size() - 1] += measure.primal * measure.dual;
    }
    for (int k = 0; k <= n; ++k)
      EXPECT_NEAR(products[static_cast<std::size_t>(k)], static_cast<double>(binomial(n, k)) * test::total_volume(mesh),
                  1e-10);
  }
}

TEST(AStarLattice, IsEquilateralInThePlaneAndBodyCentredInSpace) {
  for (const auto& [face, measure] : test::measures(meshes::a_star_lattice(2, 4, 1.5))) {
    const double h = 1.5 * std::sqrt(2.0 / 3), star = measure.dual / measure.primal;
    if (face.size() == 2) {
      EXPECT_NEAR(measure.primal, h, 1e-12);
    }
    EXPECT_NEAR(star,
                face.size() == 1   ? std::sqrt(3) / 2 * h * h
                : face.size() == 2 ? 1 / std::sqrt(3)
                                   : 4 / (std::sqrt(3) * h * h),
                1e-12);
  }
  for (const auto& [face, measure] : test::measures(meshes::a_star_lattice(3, 3)))
    if (face.size() == 2) {
      EXPECT_NEAR(measure.dual / measure.primal, measure.primal > 0.95 ? 0.125 : 0.375, 1e-12);
    }
}

TEST(Lattices, RefuseSenselessArguments) {
  EXPECT_THROW((void)meshes::a_star_lattice(0, 3), InputError);
  EXPECT_THROW((void)meshes::a_star_lattice(7, 3), InputError);
  EXPECT_THROW((void)meshes::a_star_lattice(3, 2), InputError);
  EXPECT_THROW((void)meshes::a_star_lattice(3, 3, 0), InputError);
  EXPECT_THROW((void)meshes::bcc_lattice(2), InputError);
  EXPECT_THROW((void)meshes::bcc_lattice(3, -1), InputError);
#ifndef DERHAM_INDEX64
  EXPECT_THROW((void)meshes::bcc_lattice(1000), LimitError);
#endif
}

}  // namespace
}  // namespace derham
