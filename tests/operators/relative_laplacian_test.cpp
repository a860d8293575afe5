// Laplacians of forms that vanish on a part of the boundary: their kernels are the cohomology of the pair.
#include "derham/boundary/boundary_complex.hpp"
#include "derham/core/error.hpp"
#include "derham/meshes/lattices.hpp"
#include "derham/operators/form_space.hpp"
#include "derham/operators/weak_laplacian.hpp"
#include "operators/spaces.hpp"

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <vector>

namespace derham {
namespace {

using test::Space;

/// A flat torus, all of whose dual volumes are positive, without the top simplices about vertex 0: so are those of the rest.
template <int n>
Space<n> punctured_torus(Index cells) {
  const MeshData torus = meshes::a_star_lattice(n, cells);
  MeshData mesh;
  mesh.ambient_dimension = n;
  mesh.vertex_count = torus.vertex_count - 1;
  mesh.simplices = SimplexList();
  for (Offset row = 0; row < torus.simplices.size(); ++row) {
    std::vector<Index> simplex(torus.simplices[row].begin(), torus.simplices[row].end());
    if (std::ranges::find(simplex, 0) != simplex.end()) continue;
    for (Index& v : simplex) --v;
    mesh.simplices.push_back(simplex);
    constexpr std::size_t width = (n + 1) * n;
    const auto corners = torus.corners.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(row) * width);
    mesh.corners.insert(mesh.corners.end(), corners, corners + static_cast<std::ptrdiff_t>(width));
  }
  return Space<n>(mesh);
}

Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& A) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues();
}

Index kernel(const Eigen::VectorXd& lambda) {
  return static_cast<Index>((lambda.array().abs() < 1e-9 * lambda.cwiseAbs().maxCoeff()).count());
}

template <int n>
void expect_kernels(const Space<n>& space, const FormSpace<n>& forms, const std::array<Index, n + 1>& betti) {
  const HodgeStar<n> star(space.K, space.g);
  for (int k = 0; k <= n; ++k) {
    ASSERT_TRUE(std::ranges::all_of(star.diagonal(k), [](double x) { return x > 0; }));
    const auto dimension = betti[static_cast<std::size_t>(k)];
    const Eigen::VectorXd weak = eigenvalues(weak_laplace_de_rham(star, forms, k));
    EXPECT_EQ(kernel(weak), dimension) << "degree " << k;
    EXPECT_GT(weak.minCoeff(), -1e-11 * weak.maxCoeff()) << "degree " << k;
    const auto mixed = restricted(mixed_laplace_de_rham(space.K, space.g, k), forms, k);
    EXPECT_EQ(kernel(eigenvalues(mixed.matrix)), dimension) << "mixed, degree " << k;
  }
}

// By Lefschetz duality H^k(M, ∂M) has the dimension of H^(n-k)(M).
TEST(RelativeLaplacian, HasTheCohomologyOfThePairAsKernel) {
  const auto ring = punctured_torus<1>(6);  // an interval
  expect_kernels<1>(ring, FormSpace<1>(ring.K), {1, 0});
  expect_kernels<1>(ring, FormSpace<1>::relative(ring.K), {0, 1});
  const auto plane = punctured_torus<2>(4);
  expect_kernels<2>(plane, FormSpace<2>(plane.K), {1, 2, 0});
  expect_kernels<2>(plane, FormSpace<2>::relative(plane.K), {0, 2, 1});
  const auto space = punctured_torus<3>(3);
  expect_kernels<3>(space, FormSpace<3>(space.K), {1, 3, 3, 0});
  expect_kernels<3>(space, FormSpace<3>::relative(space.K), {0, 3, 3, 1});
}

// Only the constants do not vanish on one of the facets.
TEST(RelativeLaplacian, OfAPartOfTheBoundary) {
  const auto plane = punctured_torus<2>(4);
  const auto whole = FormSpace<2>::relative(plane.K);
  expect_kernels<2>(plane, FormSpace<2>(plane.K, whole.prescribed(1).first(1)), {0, 2, 0});
}

TEST(RelativeLaplacian, IsTheWholeOneWhereNothingIsPrescribed) {
  const auto plane = punctured_torus<2>(4);
  const HodgeStar<2> star(plane.K, plane.g);
  for (int k = 0; k <= 2; ++k) {
    const SparseMatrix whole = weak_laplace_de_rham(star, k);
    EXPECT_LT((weak_laplace_de_rham(star, FormSpace<2>(plane.K), k) - whole).norm(), 1e-13 * whole.norm());
  }
}

TEST(RelativeLaplacian, RefusesOtherComplexesAndZeros) {
  const auto plane = punctured_torus<2>(4), other = punctured_torus<2>(4);
  const HodgeStar<2> star(plane.K, plane.g);
  EXPECT_THROW((void)weak_laplace_de_rham(star, FormSpace<2>(other.K), 1), InputError);
  const Space<2> grid(meshes::periodic_box(2, 3));
  EXPECT_THROW((void)weak_laplace_de_rham(HodgeStar<2>(grid.K, grid.g), FormSpace<2>(grid.K), 2), GeometryError);
}

}  // namespace
}  // namespace derham
