#include "derham/boundary/manifold.hpp"

#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/classics.hpp"
#include "derham/meshes/constructions.hpp"
#include "derham/meshes/polytopes.hpp"
#include "derham/meshes/voxels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace derham {
namespace {

using Counts = std::vector<Index>;

/// Everything the tables of known answers say about a complex that is a manifold.
template <int n>
void expect_manifold(const std::string& what, const SimplexList& rows, const Counts& f, bool orientable, bool closed) {
  SCOPED_TRACE(what);
  const SimplicialComplex<n> K(rows);
  Counts sizes;
  for (int k = 0; k <= n; ++k) sizes.push_back(K.size(k));
  if (!f.empty()) {
    EXPECT_EQ(sizes, f);
  }
  const ManifoldReport report = check_manifold(K);
  EXPECT_EQ(report.verdict, Verdict::yes);
  EXPECT_TRUE(report.pure);
  EXPECT_EQ(report.closed, closed);
  EXPECT_EQ(report.orientable, orientable);
  EXPECT_EQ(report.defects.size(), orientable ? 0U : 1U);
  for (const auto& defect : report.defects)
    EXPECT_EQ(defect.kind, DefectKind::orientation) << name(defect.kind) << ": " << defect.detail;
  EXPECT_NO_THROW(require_manifold(K));
}

template <int n>
void expect_closed(const std::string& what, const SimplexList& rows, const Counts& f, bool orientable = true) {
  expect_manifold<n>(what, rows, f, orientable, true);
}

template <int n>
void expect_bounded(const std::string& what, const SimplexList& rows, const Counts& f, bool orientable = true) {
  expect_manifold<n>(what, rows, f, orientable, false);
}

TEST(Manifold, ClosedClassics) {
  using namespace meshes;
  expect_closed<1>("S^1", sphere(1), {3, 3});
  expect_closed<2>("S^2", sphere(2), {4, 6, 4});
  expect_closed<3>("S^3", sphere(3), {5, 10, 10, 5});
  expect_closed<4>("S^4", sphere(4), {6, 15, 20, 15, 6});
  expect_closed<5>("S^5", sphere(5), {7, 21, 35, 35, 21, 7});
  expect_closed<6>("S^6", sphere(6), {8, 28, 56, 70, 56, 28, 8});
  expect_closed<3>("16-cell", cross_polytope(3).simplices, {8, 24, 32, 16});
  expect_closed<3>("600-cell", cell_600().simplices, {120, 720, 1200, 600});
  expect_closed<2>("RP^2", projective_plane(), {6, 15, 10}, false);
  expect_closed<2>("Klein bottle", klein_bottle(), {8, 24, 16}, false);
  expect_closed<2>("torus", csaszar_torus(), {7, 21, 14});
  expect_closed<3>("T^3", grid_torus(3), {27, 189, 324, 162});
  expect_closed<4>("T^4", grid_torus(4), {81, 1215, 4050, 4860, 1944});
  expect_closed<4>("CP^2", complex_projective_plane(), {9, 36, 84, 90, 36});
  expect_closed<3>("L(3,1)", lens_space(3, 1), {120, 768, 1296, 648});
  expect_closed<3>("Poincaré sphere", poincare_sphere(), {16, 106, 180, 90});
  expect_closed<3>("S^2 x S^1", product(sphere(2), sphere(1)), {12, 48, 72, 36});
  expect_closed<4>("S^2 x S^2", product(sphere(2), sphere(2)), {16, 84, 216, 240, 96});
  expect_closed<5>("S^3 x S^2", product(sphere(3), sphere(2)), {});
}

TEST(Manifold, BoundedClassics) {
  using namespace meshes;
  expect_bounded<2>("Möbius strip", moebius_strip(), {5, 10, 5}, false);
  expect_bounded<2>("annulus", annulus(), {6, 12, 6});
  expect_bounded<3>("RP^2 x I", product(projective_plane(), path(1)), {12, 51, 70, 30}, false);
  expect_bounded<3>("Klein x I", product(klein_bottle(), path(1)), {16, 80, 112, 48}, false);
  expect_bounded<3>("Möbius x I", product(moebius_strip(), path(1)), {10, 35, 40, 15}, false);
  expect_bounded<4>("RP^2 x I x I", product(product(projective_plane(), path(1)), path(1)), {}, false);
}

TEST(Manifold, DomainsWithTunnelsAndVoids) {
  const auto voxels = [](const char* spec) { return meshes::voxels(spec).simplices; };
  expect_bounded<3>("cube", voxels("2x2x2"), {27, 98, 120, 48});
  expect_bounded<3>("solid torus", voxels("3x3x1-1,1,0"), {32, 112, 128, 48});
  expect_bounded<3>("void", voxels("3x3x3-1,1,1"), {64, 278, 372, 156});
  expect_bounded<3>("toroidal void", voxels("5x5x3-1:3,1:3,1+2,2,1"), {144, 687, 946, 402});
  expect_bounded<3>("genus 2 handlebody", voxels("5x3x1-1,1,0-3,1,0"), {48, 177, 206, 78});
  expect_bounded<3>("two voids", voxels("3x3x5-1,1,1-1,1,3"), {96, 441, 606, 258});
  expect_bounded<3>("tunnel and void", voxels("3x7x3-1,1,0:2-1,4,1"), {128, 599, 826, 354});
}

TEST(Manifold, BoxesAndTheirSubdivisions) {
  using namespace meshes;
  expect_bounded<1>("segment", box(1, 5).simplices, {6, 5});
  expect_bounded<2>("square", box(2, 5).simplices, {36, 85, 50});
  expect_bounded<3>("cube", box(3, 4).simplices, {});
  expect_bounded<4>("4-cube", box(4, 3).simplices, {});
  expect_bounded<5>("5-cube", box(5, 1).simplices, {});
  expect_bounded<6>("6-cube", box(6, 1).simplices, {});
  expect_bounded<4>("subdivided 4-cube", barycentric_subdivision(box(4, 1).simplices), {});
  expect_closed<4>("subdivided S^4", barycentric_subdivision(sphere(4)), {});
  expect_closed<4>("subdivided CP^2", barycentric_subdivision(complex_projective_plane()), {});
  expect_closed<4>("subdivided S^2 x S^2", barycentric_subdivision(product(sphere(2), sphere(2))), {});
}

TEST(Manifold, SmallestAndEmptyInputs) {
  expect_closed<0>("one point", {{0}}, {1});
  expect_closed<0>("three points", {{0}, {1}, {2}}, {3});
  expect_bounded<1>("polyline", {{0, 1}, {1, 2}}, {3, 2});
  expect_bounded<3>("one tet", {{0, 1, 2, 3}}, {4, 6, 4, 1});
  expect_bounded<6>("one 6-simplex", {{0, 1, 2, 3, 4, 5, 6}}, {7, 21, 35, 35, 21, 7, 1});
  expect_bounded<3>("two components", {{0, 1, 2, 3}, {5, 4, 6, 7}}, {8, 12, 8, 2});
  expect_closed<0>("empty, n = 0", {}, {0});
  expect_closed<1>("empty, n = 1", {}, {0, 0});
  expect_closed<3>("empty, n = 3", {}, {0, 0, 0, 0});
  expect_closed<5>("empty, n = 5", {}, {});
}

/// The verdict cannot depend on the names of vertices, their order in tuples or the order of tuples.
TEST(Manifold, VerdictSurvivesRelabelling) {
  std::mt19937 random(3);
  for (int round = 0; round < 5; ++round) {
    const SimplexList original = meshes::complex_projective_plane();
    std::vector<Index> names(static_cast<std::size_t>(original.vertex_bound()));
    std::iota(names.begin(), names.end(), Index{0});
    std::ranges::shuffle(names, random);
    std::vector<std::vector<Index>> rows;
    for (Offset i = 0; i < original.size(); ++i) {
      rows.emplace_back();
      for (const Index v : original[i]) rows.back().push_back(names[static_cast<std::size_t>(v)]);
      std::ranges::shuffle(rows.back(), random);
    }
    std::ranges::shuffle(rows, random);
    SimplexList relabelled;
    for (const auto& row : rows) relabelled.push_back(row);
    expect_closed<4>("relabelled CP^2", relabelled, {9, 36, 84, 90, 36});
  }
}

TEST(Manifold, ReportDoesNotDependOnTheNumberOfThreads) {
  // Tets meeting in edges and vertices only, many times.
  SimplexList rows;
  for (Index i = 0; i < 3000; ++i) rows.push_back({i, i + 1, 3001 + 2 * i, 3002 + 2 * i});
  const SimplicialComplex<3> K(rows);
  const int threads = thread_count();
  std::vector<ManifoldReport> reports;
  for (const int count : {1, 2, 4}) {
    set_thread_count(count);
    reports.push_back(check_manifold(K));
  }
  set_thread_count(threads);
  EXPECT_EQ(reports[0].count(DefectKind::link), 2999);
  for (const auto& report : reports) {
    ASSERT_EQ(report.defects.size(), reports[0].defects.size());
    for (std::size_t i = 0; i < report.defects.size(); ++i) {
      EXPECT_EQ(report.defects[i].simplex, reports[0].defects[i].simplex);
      EXPECT_EQ(report.defects[i].detail, reports[0].defects[i].detail);
    }
  }
}

}  // namespace
}  // namespace derham
