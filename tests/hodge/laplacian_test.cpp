#include "derham/hodge/laplacian.hpp"

#include "derham/complex/incidence.hpp"
#include "derham/hodge/eigen.hpp"
#include "derham/meshes/balls.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/tori.hpp"
#include "geometry/mesh_kit.hpp"

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <vector>

namespace derham {
namespace {

template <int n>
struct Space {
  explicit Space(const MeshData& mesh) : K(mesh.simplices), g(Geometry<n>::from_mesh(K, mesh)), star(K, g) {}
  SimplicialComplex<n> K;
  Geometry<n> g;
  HodgeStar<n> star;
};

template <class T>
struct Laplacian : testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                                  std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(Laplacian, Dimensions);

TYPED_TEST(Laplacian, StrongFormIsTheWeakMatrixOverTheVolumes) {
  constexpr int n = TypeParam::value;
  const Space<n> space(meshes::periodic_box(n, 3, {.jitter = 0.3 / n}));
  PrimalForm<n, 0> u(space.K);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (double& x : u.values()) x = normal(random);
  const auto strong = laplacian(space.star, u);
  const Eigen::Map<const Eigen::VectorXd> values(u.values().data(), u.size());
  const Eigen::VectorXd weak = weak_laplacian(space.star) * values;
  for (Index v = 0; v < u.size(); ++v)
    EXPECT_NEAR(strong[v] * space.star.diagonal(0)[v], weak[v], 1e-10 * weak.cwiseAbs().maxCoeff());
}

// The whole spectrum of a Kuhn torus is that of the finite differences: Σ 4/h² sin²(π k_i h).
TYPED_TEST(Laplacian, SpectrumOfTheGridTorus) {
  constexpr int n = TypeParam::value;
  constexpr int cells = n <= 2 ? 6 : n == 3 ? 4 : 3;
  const Space<n> space(meshes::periodic_box(n, cells));
  const Eigen::VectorXd mass = to_eigen(space.star, 0);
  const Eigen::VectorXd root = mass.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd symmetric = root.asDiagonal() * Eigen::MatrixXd(weak_laplacian(space.star)) * root.asDiagonal();
  const Eigen::VectorXd computed = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric).eigenvalues();
  std::vector<double> expected;
  for (Index v = 0; v < space.K.size(0); ++v) {
    double sum = 0;
    for (Index i = 0, rest = v; i < n; ++i, rest /= cells)
      sum += 4.0 * cells * cells * std::pow(std::sin(std::numbers::pi * static_cast<double>(rest % cells) / cells), 2);
    expected.push_back(sum);
  }
  std::sort(expected.begin(), expected.end());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(computed[static_cast<Eigen::Index>(i)], expected[i], 1e-11 * expected.back());
}

// Linear functions are harmonic at interior vertices of any mesh of any dimension, Delaunay or not.
TYPED_TEST(Laplacian, LinearFunctionsAreHarmonicInside) {
  constexpr int n = TypeParam::value;
  const MeshData mesh = meshes::box(n, 3, {.jitter = 0.5 / n});
  const Space<n> space(mesh);
  std::set<Index> boundary;
  const auto cofaces = facet_cofaces(space.K);
  for (Index f = 0; f < space.K.size(n - 1); ++f)
    if (cofaces.count[f] == 1)
      for (const Index v : space.K.simplex(n - 1, f)) boundary.insert(v);
  Eigen::VectorXd u(space.K.size(0));
  for (Index v = 0; v < space.K.size(0); ++v) {
    u[v] = 5;
    for (int c = 0; c < n; ++c) u[v] += (c - 1.5) * mesh.points[v * n + c];
  }
  const Eigen::VectorXd weak = weak_laplacian(space.star) * u;
  EXPECT_LT(boundary.size(), static_cast<std::size_t>(space.K.size(0)));
  for (Index v = 0; v < space.K.size(0); ++v) {
    if (!boundary.contains(v)) {
      EXPECT_NEAR(weak[v], 0, 1e-10);
    }
  }
}

TEST(Laplacian, CotangentFormulaOnSurfaces) {
  const MeshData mesh = meshes::torus(11, 7);
  const Space<2> space(mesh);
  const auto matrix = weak_laplacian(space.star);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(space.K.size(0), space.K.size(0));
  const auto point = [&](Index v) { return Eigen::Map<const Eigen::Vector3d>(mesh.points.data() + 3 * v); };
  for (Index t = 0; t < space.K.size(2); ++t) {
    const auto s = space.K.simplex(2, t);
    for (int i = 0; i < 3; ++i) {
      const Index o = s[i], a = s[(i + 1) % 3], b = s[(i + 2) % 3];
      const Eigen::Vector3d x = point(a) - point(o), y = point(b) - point(o);
      const double half_cotangent = x.dot(y) / x.cross(y).norm() / 2;
      expected(a, b) -= half_cotangent;
      expected(b, a) -= half_cotangent;
      expected(a, a) += half_cotangent;
      expected(b, b) += half_cotangent;
    }
  }
  EXPECT_LT((Eigen::MatrixXd(matrix) - expected).cwiseAbs().maxCoeff(), 1e-12);
}

// The unit sphere: 0, 2 three times, 6 five times.
TEST(Laplacian, SpectrumOfTheSphere) {
  const Space<2> space(meshes::icosphere(3));
  const Eigen::VectorXd root = to_eigen(space.star, 0).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd symmetric = root.asDiagonal() * Eigen::MatrixXd(weak_laplacian(space.star)) * root.asDiagonal();
  const Eigen::VectorXd computed = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric).eigenvalues();
  EXPECT_NEAR(computed[0], 0, 1e-10);
  for (int i = 1; i <= 3; ++i) EXPECT_NEAR(computed[i], 2, 0.01);
  for (int i = 4; i <= 8; ++i) EXPECT_NEAR(computed[i], 6, 0.06);
}

}  // namespace
}  // namespace derham
