// The kernel of Δ_k has dimension β_k wherever all stars are positive, for every n and k: Δ is not made of its known kernel but
// assembled, and the signs of its eigenvalues are counted by Sylvester's law of inertia.
#include "derham/dual/dual_report.hpp"
#include "derham/operators/weak_laplacian.hpp"
#include "operators/spaces.hpp"

#include <gtest/gtest.h>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <random>
#include <span>
#include <utility>
#include <vector>

namespace derham {
namespace {

/// The torus of 2^(n+1) - 1 vertices: Z^n modulo the lattice that the generators 1, 2, 4, …, 2^n of Z_(2^(n+1)-1), whose sum is
/// zero, are sums in; each cube cut into n! simplices. Kühnel & Lassmann, "Combinatorial d-tori", 1988.
template <int n>
MeshData small_torus() {
  const Index count = (Index{1} << (n + 1)) - 1;
  MeshData mesh;
  mesh.vertex_count = count;
  std::vector<int> order(n);
  for (Index v = 0; v < count; ++v) {
    std::iota(order.begin(), order.end(), 0);
    do {
      std::vector<Index> row{v};
      for (const int axis : order) row.push_back((row.back() + (Index{1} << axis)) % count);
      mesh.simplices.push_back(row);
    } while (std::ranges::next_permutation(order).found);
  }
  return mesh;
}

/// The flat metric of A_n*, where an edge that is the sum of g generators has the squared length g(n+1-g)/(n+1), each times a
/// number near 1: curved, without any symmetry, and still well-centred. `id` are the labels of the vertices.
template <int n>
std::vector<double> random_lengths(const SimplicialComplex<n>& K, const std::vector<Index>& id, std::uint32_t seed) {
  std::vector<Index> vertex(id.size());  // of Z_(2^(n+1)-1)
  for (std::size_t v = 0; v < id.size(); ++v) vertex[static_cast<std::size_t>(id[v])] = static_cast<Index>(v);
  const auto count = static_cast<Index>(id.size());
  const auto noise = support::random_values(K.size(1), seed);
  std::vector<double> squares;
  for (Index e = 0; e < K.size(1); ++e) {
    const auto ends = K.template simplex<1>(e);
    const Index step =
        (vertex[static_cast<std::size_t>(ends[1])] + count - vertex[static_cast<std::size_t>(ends[0])]) % count;
    const int g = std::popcount(static_cast<unsigned>(step));
    squares.push_back(g * (n + 1 - g) / (n + 1.0) * (1 + 0.02 * noise[static_cast<std::size_t>(e)]));
  }
  return squares;
}

/// How many eigenvalues of A are less than the shift: the negative entries of D in A - shift = LDLᵀ.
Eigen::Index eigenvalues_below(double shift, const SparseMatrix& A) {
  Eigen::SparseMatrix<double> shifted = A, one(A.rows(), A.cols());
  one.setIdentity();
  shifted -= shift * one;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(shifted);
  EXPECT_EQ(factor.info(), Eigen::Success);
  return (factor.vectorD().array() < 0).count();
}

template <class T>
struct Kernel : testing::Test {};
TYPED_TEST_SUITE(Kernel, test::Dimensions);

TYPED_TEST(Kernel, IsTheCohomologyWhereAllStarsArePositive) {
  constexpr int n = TypeParam::value;
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    if (n == 4 && seed > 1) continue;  // seconds each
    std::vector<Index> id;
    const SimplicialComplex<n> K(test::shuffled(small_torus<n>(), seed, id).simplices);
    const auto geometry = Geometry<n>::from_squared_lengths(K, random_lengths<n>(K, id, seed));
    const DualReport verdict = dual_report(K, geometry);
    const HodgeStar<n> star(K, geometry);
    for (int k = 0; k <= n; ++k) {
      ASSERT_TRUE(verdict.star[static_cast<std::size_t>(k)].zero.empty());
      ASSERT_TRUE(verdict.star[static_cast<std::size_t>(k)].negative.empty());
      const auto diagonal = star.diagonal(k);
      const Eigen::VectorXd root =
          Eigen::Map<const Eigen::VectorXd>(diagonal.data(), std::ssize(diagonal)).cwiseSqrt().cwiseInverse();
      const SparseMatrix A = root.asDiagonal() * weak_laplace_de_rham(star, k) * root.asDiagonal();
      const double bound = (Eigen::MatrixXd::Ones(1, A.rows()) * A.cwiseAbs()).maxCoeff();  // of all eigenvalues
      EXPECT_EQ(eigenvalues_below(-1e-10 * bound, A), 0) << "positive semi-definite, degree " << k;
      EXPECT_EQ(eigenvalues_below(1e-10 * bound, A), binomial(n, k)) << "degree " << k;
      EXPECT_EQ(eigenvalues_below(1e-3 * bound, A), binomial(n, k)) << "and no other is near zero, degree " << k;
    }
  }
}

}  // namespace
}  // namespace derham
