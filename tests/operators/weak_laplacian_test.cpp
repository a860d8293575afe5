#include "derham/operators/weak_laplacian.hpp"

#include "derham/core/error.hpp"
#include "derham/hodge/eigen.hpp"
#include "derham/meshes/lattices.hpp"
#include "derham/operators/laplace_de_rham.hpp"
#include "operators/spaces.hpp"

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace derham {
namespace {

using test::for_each_degree;
using test::for_each_space_of;
using test::Space;

template <class T>
struct WeakLaplacian : testing::Test {};
TYPED_TEST_SUITE(WeakLaplacian, test::Dimensions);

/// Eigenvalues of A x = λ diag(m) x with m > 0, increasing.
Eigen::VectorXd eigenvalues(const SparseMatrix& A, std::span<const double> m) {
  const Eigen::Map<const Eigen::VectorXd> mass(m.data(), static_cast<Eigen::Index>(m.size()));
  const Eigen::VectorXd root = mass.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = root.asDiagonal() * Eigen::MatrixXd(A) * root.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues();
}

void expect_kernel(const Eigen::VectorXd& lambda, Index betti, const char* where, int k) {
  const double largest = lambda.maxCoeff();
  EXPECT_GT(lambda.minCoeff(), -1e-11 * largest) << where << ", degree " << k;
  EXPECT_EQ((lambda.array() < 1e-9 * largest).count(), betti) << where << ", degree " << k;
}

template <int n>
void expect_kernels(const Space<n>& space, const std::array<Index, n + 1>& betti, const char* where) {
  const HodgeStar<n> star(space.K, space.g);
  for (int k = 0; k <= n; ++k) {
    ASSERT_TRUE(std::ranges::all_of(star.diagonal(k), [](double x) { return x > 0; }));
    if (space.K.size(k) > 700) continue;
    expect_kernel(eigenvalues(weak_laplace_de_rham(star, k), star.diagonal(k)), betti[static_cast<std::size_t>(k)],
                  where, k);
  }
}

TEST(WeakLaplacianKernel, IsTheCohomologyOfLattices) {
  expect_kernels<1>(Space<1>(meshes::a_star_lattice(1, 5)), {1, 1}, "circle");
  expect_kernels<2>(Space<2>(meshes::a_star_lattice(2, 4)), {1, 2, 1}, "torus");
  expect_kernels<3>(Space<3>(meshes::a_star_lattice(3, 3)), {1, 3, 3, 1}, "T3");
  expect_kernels<3>(Space<3>(meshes::bcc_lattice(3)), {1, 3, 3, 1}, "BCC");
  expect_kernels<4>(Space<4>(meshes::a_star_lattice(4, 3)), {1, 4, 6, 4, 1}, "T4");
}

/// The boundary of the regular (n+1)-simplex.
TYPED_TEST(WeakLaplacian, HasTheCohomologyOfASphere) {
  constexpr int n = TypeParam::value;
  MeshData mesh;
  mesh.simplices = SimplexList();
  for (Index omitted = 0; omitted <= n + 1; ++omitted) {
    std::vector<Index> row;
    for (Index v = 0; v <= n + 1; ++v)
      if (v != omitted) row.push_back(v);
    mesh.simplices.push_back(row);
  }
  const std::vector<double> ones(static_cast<std::size_t>((n + 2) * (n + 1) / 2), 1.0);
  const Space<n> space(mesh, ones);
  std::array<Index, n + 1> betti{};
  betti[0] = betti[n] = 1;
  expect_kernels<n>(space, betti, "sphere");
}

TYPED_TEST(WeakLaplacian, IsTheStarOfTheStrongOne) {
  constexpr int n = TypeParam::value;
  for_each_space_of<n>(test::generic_mesh<n>(1), [](const Space<n>& space) {
    const HodgeStar<n> star(space.K, space.g);
    for_each_degree<n>([&]<int k>() {
      const SparseMatrix weak = weak_laplace_de_rham(star, k);
      const SparseMatrix strong = to_eigen(star, k).asDiagonal() * laplace_de_rham<PrimalForm<n, k>>(star).matrix();
      EXPECT_LT((weak - strong).norm(), 1e-12 * weak.norm()) << "degree " << k;
      EXPECT_LT((weak - SparseMatrix(weak.transpose())).norm(), 1e-14 * weak.norm()) << "degree " << k;
    });
  });
}

/// Kuhn's grid on the torus: ⋆_1 is zero on diagonals, and functions see the grid alone.
template <int n>
void expect_grid_spectrum(Index cells) {
  const double pi = std::numbers::pi, h = 1.0 / static_cast<double>(cells);
  const Space<n> space(meshes::periodic_box(n, cells));
  const HodgeStar<n> star(space.K, space.g);
  const Eigen::VectorXd lambda = eigenvalues(weak_laplace_de_rham(star, 0), star.diagonal(0));
  std::vector<double> expected;
  for (Index i = 0; i < space.K.size(0); ++i) {
    double sum = 0;
    for (Index rest = i, axis = 0; axis < n; ++axis, rest /= cells) {
      const double s = std::sin(pi * static_cast<double>(rest % cells) * h);
      sum += 4 / (h * h) * s * s;
    }
    expected.push_back(sum);
  }
  std::ranges::sort(expected);
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(lambda[static_cast<Eigen::Index>(i)], expected[i], 1e-12 * expected.back());
}

TEST(WeakLaplacianMatrix, OfTheEmptyComplexIsEmpty) {
  const SimplicialComplex<2> K(SimplexList(2, {}));
  const HodgeStar<2> star(K, Geometry<2>::from_points(K, {}, 2));
  for (int k = 0; k <= 2; ++k) EXPECT_EQ(weak_laplace_de_rham(star, k).size(), 0);
}

TEST(KuhnTorus, HasTheSpectrumOfTheGrid) {
  expect_grid_spectrum<1>(12);
  expect_grid_spectrum<2>(8);
  expect_grid_spectrum<3>(5);
  expect_grid_spectrum<4>(3);
}

TEST(KuhnTorus, OneFormsWorkWithoutTheInverseOfZeros) {
  const Space<2> space(meshes::periodic_box(2, 4));
  const HodgeStar<2> star(space.K, space.g);
  EXPECT_NO_THROW((void)weak_laplace_de_rham(star, 1));
  EXPECT_THROW((void)weak_laplace_de_rham(star, 2), GeometryError);
  EXPECT_THROW((void)laplace_de_rham(star, PrimalForm<2, 1>(space.K)), GeometryError);
  EXPECT_THROW((void)weak_laplace_de_rham(star, 3), InputError);
}

/// |K_{k-1}| negative, β_k zero, the rest positive.
template <int n>
void expect_inertia(const MixedLaplacian& mixed, Index betti, int k) {
  const Eigen::MatrixXd A = mixed.matrix;
  EXPECT_LT((A - A.transpose()).norm(), 1e-14 * A.norm());
  const Eigen::VectorXd scale =
      A.diagonal().cwiseAbs().cwiseMax(1e-3 * A.cwiseAbs().maxCoeff()).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * A * scale.asDiagonal();
  const Eigen::VectorXd lambda =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues();
  const double zero = 1e-10 * lambda.cwiseAbs().maxCoeff();
  EXPECT_EQ((lambda.array() < -zero).count(), mixed.sigma) << "dimension " << n << ", degree " << k;
  EXPECT_EQ((lambda.array().abs() <= zero).count(), betti) << "dimension " << n << ", degree " << k;
}

template <int n>
void expect_inertias(const Space<n>& space, const std::array<Index, n + 1>& betti) {
  for (int k = 0; k <= n; ++k)
    if (space.K.size(k) < 400)
      expect_inertia<n>(mixed_laplace_de_rham(space.K, space.g, k), betti[static_cast<std::size_t>(k)], k);
}

TEST(MixedWhitneyLaplacian, HasTheCohomologyAsKernelOnEveryMesh) {
  expect_inertias<1>(Space<1>(meshes::periodic_box(1, 6, {.jitter = 0.5})), {1, 1});
  expect_inertias<2>(Space<2>(meshes::periodic_box(2, 3, {.jitter = 0.3})), {1, 2, 1});
  expect_inertias<3>(Space<3>(meshes::periodic_box(3, 3, {.jitter = 0.2})), {1, 3, 3, 1});
  expect_inertias<2>(Space<2>(meshes::box(2, 3)), {1, 0, 0});
  expect_inertias<3>(Space<3>(meshes::box(3, 2)), {1, 0, 0, 0});
  expect_inertias<4>(Space<4>(meshes::box(4, 1)), {1, 0, 0, 0, 0});
}

/// Eliminating σ gives the weak form, where the inner products are diagonal.
TYPED_TEST(WeakLaplacian, IsTheMixedOneWithoutSigma) {
  constexpr int n = TypeParam::value;
  const Space<n> space(test::generic_mesh<n>(3, 2));
  const HodgeStar<n> star(space.K, space.g);
  const auto inner = [&](int k) {
    if (k < 0 || k > n) return SparseMatrix();
    return SparseMatrix(to_eigen(star, k).asDiagonal());
  };
  for (int k = 0; k <= n; ++k) {
    if (space.K.size(k) > 500) continue;
    const auto mixed = mixed_laplace_de_rham(space.K, k, {inner(k - 1), inner(k), inner(k + 1)});
    Eigen::MatrixXd A = mixed.matrix;
    const Index s = mixed.sigma, u = space.K.size(k);
    Eigen::MatrixXd schur = A.bottomRightCorner(u, u);
    if (s > 0) {
      const auto inverse = star.inverse_diagonal(k - 1);
      const Eigen::Map<const Eigen::VectorXd> M(inverse.data(), s);
      schur += A.bottomLeftCorner(u, s) * M.asDiagonal() * A.topRightCorner(s, u);
    }
    const Eigen::MatrixXd weak = weak_laplace_de_rham(star, k);
    EXPECT_LT((schur - weak).norm(), 1e-12 * weak.norm()) << "degree " << k;
    EXPECT_EQ(Eigen::MatrixXd(mixed.mass).bottomRightCorner(u, u), Eigen::MatrixXd(inner(k)));
  }
  EXPECT_THROW((void)mixed_laplace_de_rham(space.K, 0, {}), InputError);
}

}  // namespace
}  // namespace derham
