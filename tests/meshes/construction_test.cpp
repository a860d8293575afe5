#include "derham/core/error.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/classics.hpp"
#include "derham/meshes/constructions.hpp"
#include "derham/meshes/example.hpp"
#include "derham/meshes/polytopes.hpp"
#include "support/mesh_measures.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

namespace derham {
namespace {

using test::f_vector;

TEST(DisjointUnion, ShiftsTheSecond) {
  EXPECT_EQ(meshes::disjoint_union({{0, 1, 2}}, {{1, 0}}), (SimplexList{{0, 1, 2}, {4, 3}}));
  const MeshData two = meshes::disjoint_union(meshes::example(), meshes::regular_simplex(3));
  EXPECT_EQ(two.vertex_count, 9);
  EXPECT_NEAR(test::total_volume(two), 18 + std::sqrt(2) / 12, 1e-12);
  EXPECT_THROW((void)meshes::disjoint_union(meshes::example(), meshes::box(2, 1)), InputError);
}

TEST(Join, OfSpheresIsASphere) {
  const SimplexList S3 = meshes::join(meshes::cycle(5), meshes::cycle(4));
  EXPECT_EQ(f_vector(S3), (std::vector<Offset>{9, 29, 40, 20}));
  EXPECT_TRUE(test::is_closed(S3));
  EXPECT_TRUE(test::is_coherent(S3));
  EXPECT_EQ(meshes::join(S3, {}), S3);
  EXPECT_EQ(meshes::join({{0}, {1, 2}}, {{0}}), (SimplexList{{0, 3}, {1, 2, 3}}));
  EXPECT_THROW((void)meshes::join({{0, 1, 2, 3}}, {{0, 1, 2, 3}}), LimitError);
  EXPECT_THROW((void)meshes::join({{0, -1}}, {{0}}), InputError);
}

TEST(Cone, IsContractible) {
  const SimplexList ball = meshes::cone(meshes::csaszar_torus());
  EXPECT_EQ(f_vector(ball), (std::vector<Offset>{8, 28, 35, 14}));
  EXPECT_EQ(test::euler_characteristic(ball), 1);
  EXPECT_EQ(meshes::cone({}), (SimplexList{{0}}));
}

TEST(Suspension, OfASphereIsTheNextSphere) {
  SimplexList sphere{{0}, {1}};
  for (int n = 1; n <= 4; ++n) {
    sphere = meshes::suspension(sphere);
    EXPECT_EQ(f_vector(sphere), f_vector(meshes::cross_polytope(n).simplices));
    EXPECT_TRUE(test::is_closed(sphere));
    if (n == 1) sphere = meshes::cycle(4);  // two points carry no signs
    EXPECT_TRUE(test::is_coherent(sphere));
  }
}

TEST(Product, HasTheKnownCounts) {
  const SimplexList S1 = meshes::sphere(1), S2 = meshes::sphere(2);
  EXPECT_EQ(f_vector(meshes::product(S2, S1)), (std::vector<Offset>{12, 48, 72, 36}));
  EXPECT_EQ(f_vector(meshes::product(S2, S2)), (std::vector<Offset>{16, 84, 216, 240, 96}));
  for (const SimplexList& M : {meshes::product(S2, S1), meshes::product(S1, S2), meshes::product(S2, S2)}) {
    EXPECT_TRUE(test::is_closed(M));
    EXPECT_TRUE(test::is_coherent(M));
  }
  const SimplexList interval = meshes::path(1);
  EXPECT_EQ(f_vector(meshes::product(meshes::projective_plane(), interval)), (std::vector<Offset>{12, 51, 70, 30}));
  EXPECT_EQ(f_vector(meshes::product(meshes::klein_bottle(), interval)), (std::vector<Offset>{16, 80, 112, 48}));
  EXPECT_EQ(f_vector(meshes::product(meshes::moebius_strip(), interval)), (std::vector<Offset>{10, 35, 40, 15}));
}

TEST(Product, OfPositiveMeshesIsPositive) {
  for (const auto& [a, b] : {std::pair{1, 1}, {1, 2}, {2, 1}, {2, 2}, {3, 1}, {3, 3}}) {
    const MeshData mesh = meshes::product(meshes::box(a, 1), meshes::box(b, 2, {.jitter = 0.3}));
    EXPECT_EQ(mesh.ambient_dimension, a + b);
    EXPECT_NEAR(test::total_volume(mesh), 1, 1e-12);
    EXPECT_GT(test::smallest_volume(mesh), 0);
  }
  EXPECT_THROW((void)meshes::product(meshes::box(1, 1), meshes::periodic_box(1, 3)), InputError);
  EXPECT_THROW((void)meshes::product(SimplexList{{0, 0}}, SimplexList{{0, 1}}), InputError);
}

TEST(BarycentricSubdivision, CountsFlags) {
  for (int n = 0; n <= 4; ++n) {
    const SimplexList sphere = meshes::sphere(n), fine = meshes::barycentric_subdivision(sphere);
    const auto f = f_vector(sphere);
    EXPECT_EQ(f_vector(fine)[0], std::accumulate(f.begin(), f.end(), Offset{0}));
    EXPECT_EQ(fine.size(), sphere.size() * factorial(n + 1));
    if (n == 0) continue;
    EXPECT_TRUE(test::is_closed(fine));
    EXPECT_TRUE(test::is_coherent(fine));
    EXPECT_EQ(test::euler_characteristic(fine), test::euler_characteristic(sphere));
  }
}

TEST(BarycentricSubdivision, KeepsVolumes) {
  for (int n = 1; n <= 4; ++n) {
    const MeshData whole = meshes::box(n, 2, {.jitter = 0.2}), fine = meshes::barycentric_subdivision(whole);
    const auto coarse_volumes = test::row_volumes(whole), volumes = test::row_volumes(fine);
    const double parts = static_cast<double>(factorial(n + 1));
    for (std::size_t i = 0; i < volumes.size(); ++i)
      ASSERT_NEAR(volumes[i], coarse_volumes[i / static_cast<std::size_t>(parts)] / parts, 1e-14);
    for (std::size_t i = 0; i < whole.points.size(); ++i) EXPECT_EQ(fine.points[i], whole.points[i]);
  }
  const MeshData torus = meshes::barycentric_subdivision(meshes::periodic_box(3, 3, {.jitter = 0.2}));
  EXPECT_TRUE(test::is_closed(torus.simplices));
  EXPECT_NEAR(test::total_volume(torus), 1, 1e-12);
  EXPECT_GT(test::smallest_volume(torus), 0);
}

TEST(BarycentricSubdivision, RefusesWhatIsNoComplex) {
  EXPECT_THROW((void)meshes::barycentric_subdivision(SimplexList{{0, 1, 2}, {3, 4}}), InputError);
  EXPECT_THROW((void)meshes::barycentric_subdivision(SimplexList{{0, 1, 1}}), InputError);
  EXPECT_THROW((void)meshes::barycentric_subdivision(SimplexList{{0, 1, 2}, {2, 0, 1}}), InputError);
  EXPECT_THROW((void)meshes::barycentric_subdivision(SimplexList{{0, 1, 2, 3, 4, 5, 6, 7}}), LimitError);
  MeshData broken = meshes::example();
  broken.points.pop_back();
  EXPECT_THROW((void)meshes::barycentric_subdivision(broken), InputError);
  EXPECT_TRUE(meshes::barycentric_subdivision(SimplexList{}).empty());
}

TEST(Quotient, ClosesABoxToTheTorus) {
  const MeshData box = meshes::box({3, 3});
  std::vector<Index> image;
  for (Index y = 0; y < 4; ++y)
    for (Index x = 0; x < 4; ++x) image.push_back(x % 3 + 3 * (y % 3));
  const MeshData torus = meshes::quotient(box, image), expected = meshes::periodic_box(2, 3);
  EXPECT_EQ(torus.simplices, expected.simplices);
  EXPECT_EQ(torus.corners, expected.corners);
  EXPECT_EQ(torus.vertex_count, 9);
}

TEST(Quotient, RefusesACollapse) {
  const SimplexList box = meshes::box({2, 2}).simplices;
  std::vector<Index> image;
  for (Index y = 0; y < 3; ++y)
    for (Index x = 0; x < 3; ++x) image.push_back(x % 2 + 2 * (y % 2));
  EXPECT_THROW((void)meshes::quotient(box, image), InputError);  // 2 x 2: rows coincide
  EXPECT_THROW((void)meshes::quotient({{0, 1, 2}}, std::vector<Index>{0, 1, 0}), InputError);
  EXPECT_THROW((void)meshes::quotient({{0, 1, 2}}, std::vector<Index>{0, 1}), InputError);
  EXPECT_THROW((void)meshes::quotient({{0, 1, 2}}, std::vector<Index>{0, 1, -2}), InputError);
  try {
    (void)meshes::quotient({{0, 1}, {1, 2}, {4, 3}}, std::vector<Index>{0, 1, 2, 0, 1});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.row(), 2);
  }
}

}  // namespace
}  // namespace derham
