#include "derham/operators/form_space.hpp"

#include "derham/boundary/eigen.hpp"
#include "derham/core/error.hpp"
#include "derham/forms/dual_wedge.hpp"
#include "derham/forms/exterior_derivative.hpp"
#include "derham/hodge/eigen.hpp"
#include "derham/operators/laplace_de_rham.hpp"
#include "derham/operators/tagged_facets.hpp"
#include "operators/sided_box.hpp"
#include "operators/spaces.hpp"
#include "support/random_forms.hpp"

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace derham {
namespace {

using support::random_form;
using test::for_each_degree;
using test::Space;

template <class T>
struct FormSpaces : testing::Test {};
TYPED_TEST_SUITE(FormSpaces, test::Dimensions);

/// d of forms that vanish on Γ.
template <int n>
Eigen::MatrixXd relative_derivative(const FormSpace<n>& space, int k) {
  const SparseMatrix d = to_eigen(coboundary_matrix(space.complex(), k));
  return Eigen::MatrixXd(SparseMatrix(space.extension(k + 1).transpose() * d * space.extension(k)));
}

template <int n>
void expect_cohomology(const FormSpace<n>& space, const std::array<Index, n + 1>& betti) {
  Eigen::Index below = 0;
  for (int k = 0; k <= n; ++k) {
    const auto size = static_cast<Eigen::Index>(space.free(k).size());
    Eigen::Index rank = 0;
    if (k < n && size > 0) {
      Eigen::FullPivLU<Eigen::MatrixXd> lu(relative_derivative(space, k));
      rank = lu.rank();
    }
    EXPECT_EQ(size - rank - below, betti[static_cast<std::size_t>(k)]) << "degree " << k;
    below = rank;
  }
}

/// The facets of a box where the first coordinate is 0.
template <int n>
std::vector<Index> left_side(const Space<n>& space) {
  std::vector<Index> facets;
  for (Index f = 0; f < space.K.size(n - 1); ++f) {
    bool left = true;
    for (const Index v : space.K.simplex(n - 1, f))
      left = left && space.g.points()[static_cast<std::size_t>(v) * n] == 0;
    if (left) facets.push_back(f);
  }
  return facets;
}

TYPED_TEST(FormSpaces, HaveTheCohomologyOfTheirPair) {
  constexpr int n = TypeParam::value;
  const Space<n> box(meshes::box(n, n < 4 ? 2 : 1));
  std::array<Index, n + 1> absolute{}, relative{}, none{};
  absolute[0] = relative[n] = 1;
  expect_cohomology(FormSpace<n>(box.K), absolute);
  expect_cohomology(FormSpace<n>::relative(box.K), relative);
  expect_cohomology(FormSpace<n>(box.K, left_side(box)), none);
}

/// Two opposite sides, tagged: a path from one to the other is a cycle of the pair.
TYPED_TEST(FormSpaces, OfTagsHaveTheCohomologyOfTheirPair) {
  constexpr int n = TypeParam::value;
  const MeshData mesh = test::with_sides<n>(meshes::box(n, n < 4 ? 2 : 1));
  const SimplicialComplex<n> K(mesh.simplices);
  std::array<Index, n + 1> two_sides{}, none{};
  two_sides[1] = 1;
  expect_cohomology(FormSpace<n>(K, tagged_facets(K, mesh, {"0-", "0+"})), two_sides);
  expect_cohomology(FormSpace<n>(K, tagged_facets(K, mesh, {"0+"})), none);
}

/// A side and a sheet inside, which is a part like any other.
TEST(FormSpace, TakesSheetsInside) {
  const Space<3> box(meshes::box(3, 2));
  std::vector<Index> facets = left_side(box);
  for (Index f = 0; f < box.K.size(2); ++f) {
    const auto on_sheet = [&](Index v) { return box.g.points()[static_cast<std::size_t>(v) * 3] == 0.5; };
    if (std::ranges::all_of(box.K.simplex(2, f), on_sheet)) facets.push_back(f);
  }
  expect_cohomology(FormSpace<3>(box.K, facets), {0, 1, 0, 0});
}

TYPED_TEST(FormSpaces, AreKeptByD) {
  constexpr int n = TypeParam::value;
  const Space<n> box(test::generic_mesh<n>(1, 2));
  const auto space = FormSpace<n>::relative(box.K);
  for_each_degree<n - 1>([&]<int k>() {
    const auto w = random_form<n, k>(box.K, 1);
    const auto inside = space.template extended<k>(space.restricted(w));
    const auto dw = d(inside);
    for (const Index i : space.prescribed(k)) EXPECT_EQ(inside[i], 0);
    for (const Index i : space.free(k)) EXPECT_EQ(inside[i], w[i]);
    for (const Index i : space.prescribed(k + 1)) EXPECT_EQ(dw[i], 0);
    EXPECT_EQ(space.extended(space.restricted(w), w), w);
    EXPECT_EQ(space.free(k).size() + space.prescribed(k).size(), static_cast<std::size_t>(box.K.size(k)));
  });
}

/// ⟨da, b⟩ = ⟨a, δb⟩ with either boundary condition: for all a with the natural δ, and for a that vanish on ∂K with whatever δb is
/// there.
TYPED_TEST(FormSpaces, CodifferentialIsAdjointToD) {
  constexpr int n = TypeParam::value;
  const Space<n> box(test::generic_mesh<n>(2, 2));
  const HodgeStar<n> star(box.K, box.g);
  const auto relative = FormSpace<n>::relative(box.K);
  for_each_degree<n - 1>([&]<int k>() {
    const auto a = random_form<n, k>(box.K, 1), anything = random_form<n, k>(box.K, 2);
    const auto b = random_form<n, k + 1>(box.K, 3);
    const auto db = codifferential(star, b);
    const auto expect_adjoint = [&](const PrimalForm<n, k>& x, const PrimalForm<n, k>& delta) {
      double size = 0;
      for (Index i = 0; i < x.size(); ++i)
        size += std::abs(x[i] * star.diagonal(k)[static_cast<std::size_t>(i)] * delta[i]);
      EXPECT_NEAR(pair(d(x), star(b)), pair(x, star(delta)), 1e-11 * size) << "degree " << k;
    };
    expect_adjoint(a, db);
    expect_adjoint(relative.template extended<k>(relative.restricted(a)),
                   relative.extended(relative.restricted(db), anything));
  });
}

/// Data that is a linear function on one side, natural conditions on the others where its normal derivative is 0.
TEST(FormSpace, SolvesAMixedProblem) {
  const Space<2> box(meshes::box(2, 4));
  const HodgeStar<2> star(box.K, box.g);
  std::vector<Index> sides;
  for (Index f = 0; f < box.K.size(1); ++f) {
    const auto ends = box.K.simplex<1>(f);
    const double a = box.g.points()[static_cast<std::size_t>(2 * ends[0])],
                 b = box.g.points()[static_cast<std::size_t>(2 * ends[1])];
    if (a == b && (a == 0 || a == 1)) sides.push_back(f);
  }
  const FormSpace<2> space(box.K, sides);
  PrimalForm<2, 0> x(box.K);
  for (Index v = 0; v < x.size(); ++v) x[v] = box.g.points()[static_cast<std::size_t>(2 * v)];
  const auto data = x - space.extended<0>(space.restricted(x));
  const SparseMatrix E = space.extension(0), A = weak_laplacian(star);
  const auto values = data.values();
  const Eigen::Map<const Eigen::VectorXd> g(values.data(), data.size());
  const Eigen::VectorXd b = -E.transpose() * (A * g);
  const Eigen::VectorXd u = Eigen::MatrixXd(SparseMatrix(E.transpose() * A * E)).ldlt().solve(b);
  const auto solution = space.extended({u.data(), static_cast<std::size_t>(u.size())}, data);
  EXPECT_LT(support::distance(solution, x), 1e-13);
}

TEST(FormSpaceErrors, AreNamed) {
  const Space<2> box(meshes::box(2, 1)), other(meshes::box(2, 1));
  const std::vector<Index> wrong{99};
  EXPECT_THROW(FormSpace<2>(box.K, wrong), InputError);
  const FormSpace<2> space(box.K);
  EXPECT_THROW((void)space.free(3), InputError);
  EXPECT_THROW((void)space.extended<0>(std::vector<double>(1)), InputError);
  EXPECT_THROW((void)space.restricted(PrimalForm<2, 0>(other.K)), InputError);
}

}  // namespace
}  // namespace derham
