#include "derham/operators/operator.hpp"

#include "derham/core/parallel.hpp"
#include "derham/forms/dual_wedge.hpp"
#include "derham/hodge/eigen.hpp"
#include "derham/hodge/laplacian.hpp"
#include "derham/meshes/lattices.hpp"
#include "derham/operators/expression.hpp"
#include "operators/own_matrix.hpp"
#include "support/random_forms.hpp"

#include <gtest/gtest.h>

namespace derham {
namespace {

using support::distance;
using support::for_degrees;
using support::random_form;
using support::random_integer_form;
using test::expect_own_matrix;

/// A closed flat mesh whose dual volumes are all positive.
template <int n>
struct Lattice {
  Lattice() : mesh(meshes::a_star_lattice(n, 3)), K(mesh.simplices), star(oriented(K, mesh), geometry()) {}
  static SimplicialComplex<n>& oriented(SimplicialComplex<n>& K, const MeshData& mesh) {
    orient_by_volume(K, Geometry<n>::from_mesh(K, mesh));
    return K;
  }
  Geometry<n> geometry() const { return Geometry<n>::from_mesh(K, mesh); }
  MeshData mesh;
  SimplicialComplex<n> K;
  HodgeStar<n> star;
};

template <class T>
class Operators : public testing::Test {};
template <int value>
using Constant = std::integral_constant<int, value>;
using Dimensions = testing::Types<Constant<1>, Constant<2>, Constant<3>>;
TYPED_TEST_SUITE(Operators, Dimensions);

TYPED_TEST(Operators, HaveTheMatrixThatTheIdentityGives) {
  constexpr int n = TypeParam::value;
  const Lattice<n> L;
  const Derivative<n> d(L.K);
  const auto& star = L.star;
  for_degrees<n>([&]<int k>(Constant<k>) {
    using Primal = PrimalForm<n, k>;
    using Dual = DualForm<n, n - k>;
    const Operator<Primal, Dual> down = star;
    const Operator<Dual, Primal> up = star;
    expect_own_matrix(down);
    expect_own_matrix(up);
    expect_own_matrix(identity<Primal>(L.K));
    if constexpr (k < n) {
      const Operator<Primal, PrimalForm<n, k + 1>> derivative = d;
      expect_own_matrix(derivative);
      const Operator<DualForm<n, k>, DualForm<n, k + 1>> dual_derivative = d;
      expect_own_matrix(dual_derivative);
      const Operator<Primal, Primal> up_laplacian = star * d * star * d;
      expect_own_matrix(up_laplacian);
      expect_own_matrix(2.5 * up_laplacian - identity<Primal>(L.K));
      const Operator<Primal, Primal> shifted = up_laplacian + identity<Primal>(L.K) - 3 * (star * d * star * d);
      expect_own_matrix(shifted);
    }
  });
}

/// Δ = dδ + δd with δ = (-1)^(n(k-1)+1) ⋆d⋆ on k-forms, out of typed parts: its signs are those of ⋆⁻¹dᵀ⋆.
template <int n, int k>
Operator<PrimalForm<n, k>, PrimalForm<n, k>> laplace_de_rham(const Derivative<n>& d, const HodgeStar<n>& star) {
  using Primal = PrimalForm<n, k>;
  const auto sign = [](int degree) { return (n * (degree - 1) + 1) % 2 == 0 ? 1.0 : -1.0; };
  if constexpr (k == 0)
    return sign(1) * (star * d * star * d);
  else if constexpr (k == n)
    return sign(n) * (d * star * d * star);
  else
    return Operator<Primal, Primal>(sign(k) * (d * star * d * star) + sign(k + 1) * (star * d * star * d));
}

TYPED_TEST(Operators, ComposeToThePositiveSemidefiniteLaplacian) {
  constexpr int n = TypeParam::value;
  const Lattice<n> L;
  const Derivative<n> d(L.K);
  for_degrees<n>([&]<int k>(Constant<k>) {
    const auto laplacian = laplace_de_rham<n, k>(d, L.star);
    expect_own_matrix(laplacian);
    const SparseMatrix weak = to_eigen(L.star, k).asDiagonal() * laplacian.matrix();
    EXPECT_LT((weak - SparseMatrix(weak.transpose())).norm(), 1e-12 * weak.norm()) << "self-adjoint";
    const auto u = random_form<n, k>(L.K, 1);
    EXPECT_GT(pair(u, L.star(laplacian(u))), 0) << "degree " << k;
    EXPECT_EQ((laplacian * 2.0)(u), 2.0 * laplacian(u));
    if constexpr (k == 0) {
      EXPECT_LT(distance(laplacian(u), derham::laplacian(L.star, u)), 1e-10);
    }
  });
}

TYPED_TEST(Operators, TransposedPairAsTheOperator) {
  constexpr int n = TypeParam::value;
  const Lattice<n> L;
  const Derivative<n> d(L.K);
  for_degrees<n - 1>([&]<int k>(Constant<k>) {
    const Operator<PrimalForm<n, k>, PrimalForm<n, k + 1>> derivative = d;
    const Operator<DualForm<n, n - k - 1>, DualForm<n, n - k>> dual = (k % 2 == 0 ? -1 : 1) * d;
    const auto transpose = transposed(derivative);
    static_assert(std::is_same_v<std::decay_t<decltype(transpose)>, std::decay_t<decltype(dual)>>);
    EXPECT_EQ(SparseMatrix(transpose.matrix() - dual.matrix()).norm(), 0) << "degree " << k;
    expect_own_matrix(transpose);
    const Operator<PrimalForm<n, k>, DualForm<n, n - k - 1>> A = L.star * derivative;
    const auto u = random_form<n, k>(L.K, 1);
    const auto v = random_form<n, k + 1>(L.K, 2);
    EXPECT_NEAR(pair(v, A(u)), pair(u, transposed(A)(v)), 1e-11) << "degree " << k;
  });
}

TYPED_TEST(Operators, OfDTwiceAreZero) {
  constexpr int n = TypeParam::value;
  if constexpr (n >= 2) {
    const Lattice<n> L;
    const Derivative<n> d(L.K);
    const Operator<PrimalForm<n, 0>, PrimalForm<n, 2>> dd = d * d;
    EXPECT_EQ(dd.matrix().norm(), 0);
    const auto w = dd(random_integer_form<n, 0>(L.K, 1));
    EXPECT_EQ(w, (PrimalForm<n, 2>(L.K)));
    const auto direct = (d * d)(random_integer_form<n, 0>(L.K, 1));
    static_assert(std::is_same_v<decltype(direct), const PrimalForm<n, 2>>);
    EXPECT_EQ(direct, w);
  }
}

TYPED_TEST(Operators, GiveTheSameBitsOnAnyNumberOfThreads) {
  constexpr int n = TypeParam::value;
  const MeshData mesh = meshes::a_star_lattice(n, n == 1 ? 20000 : n == 2 ? 60 : 12);
  SimplicialComplex<n> K(mesh.simplices);
  orient_by_volume(K, Geometry<n>::from_mesh(K, mesh));
  const HodgeStar<n> star(K, Geometry<n>::from_mesh(K, mesh));
  const Derivative<n> d(K);
  const Operator<PrimalForm<n, 0>, PrimalForm<n, 0>> A =
      0.1 * (star * d * star * d) - 2 * identity<PrimalForm<n, 0>>(K);
  const auto B = A.assembled();
  const auto u = random_form<n, 0>(K, 1);
  const int before = thread_count();
  set_thread_count(1);
  const auto free = A(u), assembled = B(u);
  for (const int threads : {2, 4}) {
    set_thread_count(threads);
    EXPECT_EQ(A(u), free);
    EXPECT_EQ(B(u), assembled);
  }
  set_thread_count(before);
}

TEST(OperatorsOfFunctions, AreAssembledByFeedingTheIdentity) {
  const SimplicialComplex<1> K(SimplexList{{0, 1}, {1, 2}});
  using Vertices = PrimalForm<1, 0>;
  int calls = 0;
  const Operator<Vertices, Vertices> shift(K, K, [&calls](auto x, auto y) {
    ++calls;
    for (std::size_t i = 0; i < 3; ++i) y[i] = x[(i + 1) % 3];
  });
  const Eigen::MatrixXd expected = (Eigen::MatrixXd(3, 3) << 0, 1, 0, 0, 0, 1, 1, 0, 0).finished();
  EXPECT_EQ(Eigen::MatrixXd(shift.matrix()), expected);
  EXPECT_EQ(calls, 3);
  (void)shift.matrix();
  EXPECT_EQ(calls, 3) << "assembled once";
  EXPECT_EQ(Eigen::MatrixXd((shift * shift * shift).matrix()), Eigen::MatrixXd::Identity(3, 3));
  EXPECT_EQ(calls, 3) << "a composition has the product of the matrices";
}

TEST(OperatorErrors, OtherComplexes) {
  const SimplicialComplex<1> K(SimplexList{{0, 1}}), L(SimplexList{{0, 1}});
  using Vertices = PrimalForm<1, 0>;
  const auto on_K = identity<Vertices>(K), on_L = identity<Vertices>(L);
  EXPECT_THROW((void)on_K(Vertices(L)), InputError);
  EXPECT_THROW((void)(on_K * on_L), InputError);
  EXPECT_THROW((void)(on_K + on_L), InputError);
}

}  // namespace
}  // namespace derham
