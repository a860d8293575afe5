// Integers that the wedge product must give, whatever the triangulation: periods and intersection forms.
#include "derham/boundary/eigen.hpp"
#include "derham/forms/exterior_derivative.hpp"
#include "derham/forms/wedge.hpp"
#include "derham/geometry/volumes.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/classics.hpp"
#include "derham/meshes/constructions.hpp"

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <array>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace derham {
namespace {

/// The flat torus of unit periods and the closed 1-forms dx_0, …, dx_{n-1}, its vertices numbered at random.
template <int n>
struct FlatTorus {
  explicit FlatTorus(Index cells) : mesh(shuffled(meshes::periodic_box(n, cells))), K(mesh.simplices) {
    const auto geometry = Geometry<n>::from_mesh(K, mesh);
    orient_by_volume(K, geometry);
    for (std::size_t axis = 0; axis < n; ++axis) {
      Form<n, 1> form(K);
      for (Index e = 0; e < form.size(); ++e) {
        const auto ends = geometry.template corners<1>(K, e);
        form[e] = ends[1][axis] - ends[0][axis];
      }
      dx.push_back(form);
    }
  }

  static MeshData shuffled(MeshData mesh) {
    std::vector<Index> name(static_cast<std::size_t>(mesh.vertex_count));
    std::iota(name.begin(), name.end(), Index{0});
    std::shuffle(name.begin(), name.end(), std::mt19937(5));
    for (Index& v : mesh.simplices.vertices()) v = name[static_cast<std::size_t>(v)];
    return mesh;
  }

  MeshData mesh;
  SimplicialComplex<n> K;
  std::vector<Form<n, 1>> dx;
};

TEST(CupIntegers, TheThreeTorusHasVolumeOne) {
  const FlatTorus<3> T(3);
  const auto& dx = T.dx;
  EXPECT_NEAR(integral(wedge(wedge(dx[0], dx[1]), dx[2])), 1, 1e-13);
  EXPECT_NEAR(integral(wedge(dx[0], wedge(dx[1], dx[2]))), 1, 1e-13);
  EXPECT_NEAR(integral(wedge(wedge(dx[1], dx[0]), dx[2])), -1, 1e-13);
  EXPECT_NEAR(integral(wedge(wedge(dx[0], dx[1]), dx[0])), 0, 1e-13);
}

/// ∫ a_i ∧ a_j.
Eigen::MatrixXd intersection_form(const std::vector<Form<4, 2>>& classes) {
  const auto size = static_cast<Eigen::Index>(classes.size());
  Eigen::MatrixXd Q(size, size);
  for (Eigen::Index i = 0; i < size; ++i)
    for (Eigen::Index j = 0; j < size; ++j)
      Q(i, j) = integral(wedge(classes[static_cast<std::size_t>(i)], classes[static_cast<std::size_t>(j)]));
  return Q;
}

/// How many eigenvalues are positive and how many negative.
std::pair<int, int> signature(const Eigen::MatrixXd& Q) {
  EXPECT_LT((Q - Q.transpose()).norm(), 1e-12);
  const auto eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(Q).eigenvalues();
  return {(eigenvalues.array() > 1e-6).count(), (eigenvalues.array() < -1e-6).count()};
}

TEST(CupIntegers, TheFourTorusHasSignatureThreeThree) {
  const FlatTorus<4> T(3);
  std::vector<Form<4, 2>> classes;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) classes.push_back(wedge(T.dx[i], T.dx[j]));
  const Eigen::MatrixXd Q = intersection_form(classes);
  EXPECT_EQ(signature(Q), std::pair(3, 3));
  EXPECT_NEAR(Q.determinant(), -1, 1e-12) << "unimodular: Poincaré duality";
}

/// A basis of the closed 2-forms orthogonal to the differentials: one for each class.
std::vector<Form<4, 2>> harmonic_forms(const SimplicialComplex<4>& K) {
  const Eigen::MatrixXd d1 = to_eigen(coboundary_matrix(K, 1)), d2 = to_eigen(coboundary_matrix(K, 2));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(d1 * d1.transpose() + d2.transpose() * d2);
  std::vector<Form<4, 2>> forms;
  for (Eigen::Index i = 0; i < solver.eigenvalues().size() && solver.eigenvalues()[i] < 1e-9; ++i) {
    const Eigen::VectorXd column = solver.eigenvectors().col(i);
    forms.emplace_back(K, std::vector<double>(column.begin(), column.end()));
  }
  return forms;
}

TEST(CupIntegers, TheProductOfTwoSpheresHasSignatureOneOne) {
  const SimplicialComplex<4> K(meshes::product(meshes::sphere(2), meshes::sphere(2)));
  const auto classes = harmonic_forms(K);
  ASSERT_EQ(classes.size(), 2u);
  EXPECT_EQ(signature(intersection_form(classes)), std::pair(1, 1));
}

TEST(CupIntegers, TheProjectivePlaneIsDefinite) {
  const SimplicialComplex<4> K(meshes::complex_projective_plane());
  const auto classes = harmonic_forms(K);
  ASSERT_EQ(classes.size(), 1u);
  EXPECT_GT(std::abs(intersection_form(classes)(0, 0)), 1e-3);
}

/// The Császár torus: a basis of H^1 pairs antisymmetrically and not to zero.
TEST(CupIntegers, TheTorusPairsItsTwoClasses) {
  const SimplicialComplex<2> K(meshes::csaszar_torus());
  const Eigen::MatrixXd d0 = to_eigen(coboundary_matrix(K, 0)), d1 = to_eigen(coboundary_matrix(K, 1));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(d0 * d0.transpose() + d1.transpose() * d1);
  std::vector<Form<2, 1>> h;
  for (Eigen::Index i = 0; i < 2; ++i) {
    ASSERT_LT(solver.eigenvalues()[i], 1e-9);
    const Eigen::VectorXd column = solver.eigenvectors().col(i);
    h.emplace_back(K, std::vector<double>(column.begin(), column.end()));
  }
  EXPECT_GT(solver.eigenvalues()[2], 1e-3);
  const double pairing = integral(wedge(h[0], h[1]));
  EXPECT_GT(std::abs(pairing), 1e-3);
  EXPECT_NEAR(integral(wedge(h[1], h[0])), -pairing, 1e-14);
  EXPECT_NEAR(integral(wedge(h[0], h[0])), 0, 1e-14);
}

}  // namespace
}  // namespace derham
