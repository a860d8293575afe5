#include "derham/operators/hot_weights.hpp"

#include "derham/core/error.hpp"
#include "derham/meshes/balls.hpp"
#include "derham/meshes/lattices.hpp"
#include "derham/operators/star_report.hpp"
#include "operators/spaces.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace derham {
namespace {

using test::Space;

template <int n>
std::size_t count(const std::array<std::vector<Index>, n + 1>& lists) {
  std::size_t sum = 0;
  for (const auto& list : lists) sum += list.size();
  return sum;
}

/// Σ |T| |c_T - b_T|² from the definition of the power centre, with positions in R^n.
template <int n>
double energy(const Space<n>& space, const std::vector<double>& weights) {
  double sum = 0;
  const auto volume = primal_volumes(space.K, space.g)[n];
  for (Index t = 0; t < space.K.size(n); ++t) {
    Eigen::Matrix<double, n, n> edges;
    Eigen::Matrix<double, n, 1> right, mean = Eigen::Matrix<double, n, 1>::Zero();
    const auto corner = space.g.corners(space.K, t);
    const auto vertices = space.K.simplex(n, t);
    for (int i = 1; i <= n; ++i) {
      for (int c = 0; c < n; ++c) edges(i - 1, c) = corner[i][c] - corner[0][c];
      right[i - 1] = (edges.row(i - 1).squaredNorm() - (weights[vertices[i]] - weights[vertices[0]])) / 2;
      mean += edges.row(i - 1).transpose() / (n + 1);
    }
    sum += volume[t] * (edges.inverse() * right - mean).squaredNorm();
  }
  return sum;
}

template <class T>
struct HotWeight : testing::Test {};
TYPED_TEST_SUITE(HotWeight, test::Dimensions);

TYPED_TEST(HotWeight, MakeAllDualVolumesOfBoxesPositive) {
  constexpr int n = TypeParam::value;
  for (const double jitter : {0.0, 0.8 / n}) {
    const Space<n> space(meshes::box(n, n < 4 ? 4 : 2, {.jitter = jitter}));
    const auto result = hot_weights(space.K, space.g);
    EXPECT_EQ(count<n>(result.not_positive), 0U);
    EXPECT_TRUE(n == 1 || count<n>(result.not_positive_before) > 0);
    EXPECT_EQ(result.advice, "");
    EXPECT_EQ(result.excluded_range, 0);
    EXPECT_NEAR(result.energy_before, energy(space, std::vector<double>(result.weights.size())), 1e-12);
    EXPECT_NEAR(result.energy, energy(space, result.weights), 1e-12);
    const HodgeStar<n> star(space.K, space.g, PowerCircumcentric{result.weights});
    for (int k = 0; k <= n; ++k)
      EXPECT_EQ(star_report(star, space.g, k).definiteness, Definiteness::positive) << "k = " << k;
  }
}

// Where nothing is in the way: no step to either side is better, and a lattice is at the optimum already.
TYPED_TEST(HotWeight, MinimiseTheEnergy) {
  constexpr int n = TypeParam::value;
  const Space<n> space(test::moved(meshes::ball(n, 2), n, 1, 1, 1));
  const auto result = hot_weights(space.K, space.g);
  EXPECT_LE(result.energy, result.energy_before);
  const Space<n> lattice(meshes::a_star_lattice(n, 3));
  for (const double w : hot_weights(lattice.K, lattice.g).weights) EXPECT_NEAR(w, 0, 1e-13);
  const Space<n> cube(meshes::box(n, 1));
  auto weights = hot_weights(cube.K, cube.g).weights;
  EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), 0, 1e-13);
  const double best = energy(cube, weights);
  for (double& w : weights)
    for (const double step : {0.01, -0.02, 0.01}) {
      w += step;
      EXPECT_GE(energy(cube, weights), best * (1 - 1e-12));
    }
}

TYPED_TEST(HotWeight, FollowTheMesh) {
  constexpr int n = TypeParam::value;
  const MeshData mesh = meshes::box(n, 2, {.jitter = 0.5 / n});
  std::vector<Index> id;
  const double s = 1e-9;
  const Space<n> space(mesh), other(test::shuffled(test::moved(mesh, n + 1, s, s, 1), 2, id));
  const auto a = hot_weights(space.K, space.g), b = hot_weights(other.K, other.g);
  for (std::size_t v = 0; v < id.size(); ++v)
    EXPECT_NEAR(b.weights[static_cast<std::size_t>(id[v])] / s / s, a.weights[v], 1e-7);
  EXPECT_NEAR(b.energy / std::pow(s, n + 2), a.energy, 1e-7 * a.energy + 1e-14);
}

TEST(HotWeights, OfAnObtuseTrianglePutTheCentreOnTheBarycentre) {
  const Space<2> space(test::single({0, 0, 1, 0, 0.5, 0.1}, 2));
  const auto result = hot_weights(space.K, space.g);
  EXPECT_EQ(count<2>(result.not_positive_before), 3U);
  EXPECT_LT(result.energy, 1e-15);
  EXPECT_EQ(count<2>(result.not_positive), 0U);
}

// Two nested triangles with twisted sides: the smallest triangulation that is not regular, so that no weights exist.
TEST(HotWeights, SayWhenThereAreNone) {
  MeshData mesh;
  mesh.ambient_dimension = 3;
  mesh.vertex_count = 6;
  mesh.points = {4, 0, 0, 0, 4, 0, 0, 0, 4, 2, 1, 1, 1, 2, 1, 1, 1, 2};
  for (const auto& row :
       std::vector<std::vector<Index>>{{0, 1, 3}, {1, 3, 4}, {1, 2, 4}, {2, 4, 5}, {0, 2, 5}, {0, 3, 5}, {3, 4, 5}})
    mesh.simplices.push_back(row);
  const Space<2> twisted(mesh);
  const auto none = hot_weights(twisted.K, twisted.g);
  EXPECT_GT(none.excluded_range, 1e6);
  EXPECT_FALSE(none.not_positive[1].empty());
  EXPECT_NE(none.advice.find("no weights"), std::string::npos) << none.advice;
  mesh.simplices = SimplexList{};
  for (const auto& row :
       std::vector<std::vector<Index>>{{0, 1, 3}, {1, 3, 4}, {1, 2, 4}, {2, 4, 5}, {0, 2, 3}, {2, 3, 5}, {3, 4, 5}})
    mesh.simplices.push_back(row);  // the third side the other way: regular
  const Space<2> regular(mesh);
  EXPECT_EQ(count<2>(hot_weights(regular.K, regular.g).not_positive), 0U);
  const Space<2> torus(meshes::periodic_box(2, 5, {.jitter = 0.3}));
  EXPECT_GT(hot_weights(torus.K, torus.g).excluded_range, 1);
}

TEST(HotWeights, OfNothingAndOfFlatMeshes) {
  const SimplicialComplex<2> empty, flat(SimplexList{{0, 1, 2}});
  EXPECT_TRUE(hot_weights(empty, Geometry<2>::from_points(empty, {}, 2)).weights.empty());
  const Space<2> square(meshes::box(2, 1));
  EXPECT_THROW((void)hot_weights(square.K, square.g, 0), InputError);
  EXPECT_THROW((void)hot_weights(square.K, square.g, std::nan("")), InputError);
  EXPECT_THROW((void)hot_weights(flat, Geometry<2>::from_points(flat, {0, 0, 1, 0, 2, 0}, 2)), GeometryError);
}

}  // namespace
}  // namespace derham
