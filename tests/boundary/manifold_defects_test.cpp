#include "derham/boundary/manifold.hpp"

#include "derham/core/error.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/classics.hpp"
#include "derham/meshes/constructions.hpp"
#include "derham/meshes/voxels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace derham {
namespace {

struct Expected {
  DefectKind kind;
  std::vector<Index> simplex;
  std::string words;  // that the detail must contain
};

/// The defects are exactly `expected`, in this order, but for the orientation defect, which has tests of its own.
template <int n>
ManifoldReport expect_defects(const SimplexList& rows, const std::vector<Expected>& expected,
                              Verdict verdict = Verdict::no) {
  const SimplicialComplex<n> K(rows);
  ManifoldReport report = check_manifold(K);
  EXPECT_EQ(report.verdict, verdict);
  const auto found = static_cast<Offset>(report.defects.size()) - report.count(DefectKind::orientation);
  EXPECT_EQ(found, static_cast<Offset>(expected.size()));
  for (std::size_t i = 0; i < std::min<std::size_t>(static_cast<std::size_t>(found), expected.size()); ++i) {
    EXPECT_EQ(report.defects[i].kind, expected[i].kind);
    EXPECT_EQ(report.defects[i].simplex, expected[i].simplex);
    EXPECT_NE(report.defects[i].detail.find(expected[i].words), std::string::npos) << report.defects[i].detail;
  }
  EXPECT_THROW(require_manifold(K), TopologyError);
  return report;
}

constexpr auto facet = DefectKind::facet;
constexpr auto ring = DefectKind::ring;
constexpr auto link = DefectKind::link;

TEST(ManifoldDefects, Facets) {
  expect_defects<1>({{0, 1}, {0, 2}, {0, 3}}, {{facet, {0}, "3 edges"}});
  expect_defects<2>({{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}, {{facet, {0, 1}, "3 triangles (triangles 0, 1, 2)"}});
  expect_defects<3>({{0, 1, 2, 3}, {0, 1, 2, 4}, {0, 1, 2, 5}}, {{facet, {0, 1, 2}, "3 tets"}});
  expect_defects<4>({{0, 1, 2, 3, 4}, {0, 1, 2, 3, 5}, {0, 1, 2, 3, 6}, {0, 1, 2, 3, 7}},
                    {{facet, {0, 1, 2, 3}, "4 4-simplices"}});
}

TEST(ManifoldDefects, Rings) {
  expect_defects<3>({{0, 1, 2, 3}, {0, 1, 4, 5}}, {{ring, {0, 1}, "2 rings (an open one of 1, an open one of 1)"}});
  expect_defects<3>({{0, 1, 2, 3}, {0, 1, 3, 4}, {0, 1, 2, 4}, {0, 1, 5, 6}, {0, 1, 6, 7}, {0, 1, 5, 7}},
                    {{ring, {0, 1}, "2 rings (a closed one of 3, a closed one of 3)"}});
  expect_defects<3>(meshes::voxels("2x2x1-0,0,0-1,1,0").simplices, {{ring, {3, 10}, "2 rings"}});
  expect_defects<4>({{0, 1, 2, 3, 4}, {0, 1, 2, 5, 6}}, {{ring, {0, 1, 2}, "2 rings"}});
  expect_defects<6>({{0, 1, 2, 3, 4, 5, 6}, {0, 1, 2, 3, 4, 7, 8}}, {{ring, {0, 1, 2, 3, 4}, "2 rings"}});
}

TEST(ManifoldDefects, DisconnectedLinks) {
  expect_defects<2>({{0, 1, 2}, {0, 3, 4}}, {{link, {0}, "2 components (an arc, an arc)"}});
  expect_defects<2>({{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 4, 5}}, {{link, {0}, "2 components (a circle, an arc)"}});
  expect_defects<3>({{0, 1, 2, 3}, {0, 4, 5, 6}}, {{link, {0}, "2 components (a disc, a disc)"}});
  expect_defects<4>({{0, 1, 2, 3, 4}, {0, 1, 5, 6, 7}}, {{link, {0, 1}, "2 components (a disc, a disc)"}});
  expect_defects<4>({{0, 1, 2, 3, 4}, {0, 5, 6, 7, 8}}, {{link, {0}, "H_0 = Z^2"}});
  expect_defects<6>({{0, 1, 2, 3, 4, 5, 6}, {0, 1, 7, 8, 9, 10, 11}}, {{link, {0, 1}, "H_0 = Z^2"}});
}

/// The facets and rings of these are sound: only the vertex test finds them.
TEST(ManifoldDefects, LinksThatAreOtherSurfaces) {
  using namespace meshes;
  expect_defects<3>(cone(csaszar_torus()), {{link, {7}, "a torus"}});
  expect_defects<3>(cone(annulus()), {{link, {6}, "an annulus"}});
  expect_defects<3>(cone(moebius_strip()), {{link, {5}, "a Möbius strip"}});
  expect_defects<3>(cone(klein_bottle()), {{link, {8}, "a Klein bottle"}});
  expect_defects<3>(suspension(projective_plane()),
                    {{link, {6}, "a projective plane"}, {link, {7}, "a projective plane"}});
  expect_defects<3>(cone(disjoint_union(sphere(2), csaszar_torus())),
                    {{link, {11}, "2 components (a sphere, a torus)"}});
  // Euler characteristic 2 and closed, yet no sphere; 1 and bounded, yet no disc.
  expect_defects<3>(cone(disjoint_union(projective_plane(), projective_plane())),
                    {{link, {12}, "2 components (a projective plane, a projective plane)"}});
  expect_defects<3>(cone(disjoint_union(annulus(), SimplexList{{0, 1, 2}})),
                    {{link, {9}, "2 components (an annulus, a disc)"}});
  // A disc and a torus: Euler characteristic 1 with a boundary.
  expect_defects<3>(cone(disjoint_union(SimplexList{{0, 1, 2}}, csaszar_torus())),
                    {{link, {10}, "2 components (a disc, a torus)"}});
}

TEST(ManifoldDefects, NonOrientableConeIsReportedAsBoth) {
  const ManifoldReport report =
      expect_defects<3>(meshes::cone(meshes::moebius_strip()), {{link, {5}, "a Möbius strip"}});
  EXPECT_FALSE(report.orientable);
  EXPECT_EQ(report.count(DefectKind::orientation), 1);
  EXPECT_EQ(report.defects.back().kind, DefectKind::orientation);
  EXPECT_EQ(report.defects.back().simplex.size(), 4U);
}

TEST(ManifoldDefects, HigherLinksAreRefutedByHomology) {
  using namespace meshes;
  expect_defects<4>(suspension(lens_space(3, 1)), {{link, {120}, "H_1 = Z_3"}, {link, {121}, "H_1 = Z_3"}});
  expect_defects<4>(cone(grid_torus(3)), {{link, {27}, "H_1 = Z^3"}});
  expect_defects<4>(cone(product(csaszar_torus(), path(1))), {{link, {14}, "H_1 = Z^2"}});
  expect_defects<5>(cone(complex_projective_plane()), {{link, {9}, "H_2 = Z"}});
  expect_defects<5>(suspension(suspension(lens_space(3, 1))), {{link, {120, 122}, "H_1 = Z_3"},
                                                               {link, {120, 123}, "H_1 = Z_3"},
                                                               {link, {121, 122}, "H_1 = Z_3"},
                                                               {link, {121, 123}, "H_1 = Z_3"}});
  expect_defects<4>(
      suspension(suspension(csaszar_torus())),
      {{link, {7, 9}, "a torus"}, {link, {7, 10}, "a torus"}, {link, {8, 9}, "a torus"}, {link, {8, 10}, "a torus"}});
}

/// The Poincaré sphere is no sphere, but its homology cannot tell and no collapse can exist: neither yes nor no.
TEST(ManifoldDefects, LinksOfTheRightHomologyThatNoCollapseProvesAreUnproved) {
  using namespace meshes;
  constexpr auto unproved = DefectKind::unproved;
  const SimplexList P = poincare_sphere();
  const ManifoldReport report =
      expect_defects<4>(suspension(P), {{unproved, {16}, "sphere"}, {unproved, {17}, "sphere"}}, Verdict::unproved);
  EXPECT_TRUE(report.pure && report.closed && report.orientable);
  expect_defects<4>(cone(P), {{unproved, {16}, "sphere"}}, Verdict::unproved);
  // The apexes of a double suspension are faces of the unproved edges, whose homology is that of a sphere again.
  expect_defects<5>(suspension(suspension(P)),
                    {{unproved, {16, 18}, "sphere"},
                     {unproved, {16, 19}, "sphere"},
                     {unproved, {17, 18}, "sphere"},
                     {unproved, {17, 19}, "sphere"}},
                    Verdict::unproved);
  // A defect elsewhere outweighs what is unproved.
  expect_defects<4>(
      disjoint_union(suspension(P), suspension(lens_space(3, 1))),
      {{unproved, {16}, "sphere"}, {unproved, {17}, "sphere"}, {link, {138}, "H_1 = Z_3"}, {link, {139}, "H_1 = Z_3"}});
}

TEST(ManifoldDefects, OnlyTheHighestDegreeIsReportedWhereOneFollowsFromAnother) {
  // The bad edge (0,1) spoils its vertices too; the pinch at 6 is on its own.
  expect_defects<3>({{0, 1, 2, 3}, {0, 1, 4, 5}, {4, 5, 0, 6}, {6, 7, 8, 9}},
                    {{ring, {0, 1}, "2 rings"}, {link, {6}, "2 components"}});
}

TEST(ManifoldDefects, ImpureComplexes) {
  const ManifoldReport report =
      expect_defects<2>({{0, 1, 2}, {2, 3}, {4}}, {{facet, {2, 3}, "no triangle"}, {link, {4}, "no triangle"}});
  EXPECT_FALSE(report.pure);
  EXPECT_FALSE(report.closed);
  expect_defects<3>({{0, 1, 2, 3}, {3, 4}}, {{ring, {3, 4}, "no tet"}});
  expect_defects<1>({{0, 1}, {2}}, {{facet, {2}, "no edge"}});
}

TEST(ManifoldDefects, CountsAndMessage) {
  const SimplicialComplex<2> K({{0, 1, 2}, {0, 3, 4}, {1, 5, 6}});
  const ManifoldReport report = check_manifold(K);
  EXPECT_EQ(report.count(link), 2);
  EXPECT_EQ(report.count(facet), 0);
  EXPECT_FALSE(report.closed);
  try {
    require_manifold(K);
    FAIL() << "no error";
  } catch (const TopologyError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("not a manifold: 2 defects"), std::string::npos) << message;
    EXPECT_NE(message.find("vertex (0)"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace derham
