// Which stars are consistent: linear functions are discretely harmonic, and Poisson's equation converges.
#include "derham/boundary/boundary_complex.hpp"
#include "derham/hodge/eigen.hpp"
#include "derham/operators/hot_weights.hpp"
#include "derham/operators/whitney_mass.hpp"
#include "operators/spaces.hpp"
#include "support/random_values.hpp"

#include <gtest/gtest.h>
#include <Eigen/SparseCholesky>

#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace derham {
namespace {

using test::Space;
using Matrix = Eigen::SparseMatrix<double>;

template <int n>
Matrix stiffness(const SimplicialComplex<n>& K, const Matrix& star) {
  const Matrix d0 = to_eigen(coboundary_matrix(K, 0));
  return d0.transpose() * star * d0;
}

template <int n>
Matrix diagonal_star(const Space<n>& space, const StarKind& kind) {
  return Matrix(to_eigen(HodgeStar<n>(space.K, space.g, kind), 1).asDiagonal());
}

template <int n>
std::vector<bool> inside(const SimplicialComplex<n>& K) {
  std::vector<bool> result(static_cast<std::size_t>(K.size(0)), true);
  const auto boundary = boundary_complex(K);
  for (const Index v : boundary.inclusion[0]) result[static_cast<std::size_t>(v)] = false;
  return result;
}

/// max |d_0ᵀ ⋆_1 d_0 u| over the vertices inside, for a linear function u.
template <int n>
double residual_of_linear(const Space<n>& space, const Matrix& star) {
  Eigen::VectorXd u(space.K.size(0));
  for (Index v = 0; v < u.size(); ++v) {
    u[v] = 0;
    for (Index c = 0; c < n; ++c)
      u[v] += (1.0 + static_cast<double>(c)) * space.g.points()[static_cast<std::size_t>(v * n + c)];
  }
  const Eigen::VectorXd residual = stiffness<n>(space.K, star) * u;
  const auto is_inside = inside(space.K);
  double largest = 0;
  for (std::size_t v = 0; v < is_inside.size(); ++v)
    if (is_inside[v]) largest = std::max(largest, std::abs(residual[static_cast<Eigen::Index>(v)]));
  return largest;
}

template <class T>
struct PatchTest : testing::Test {};
TYPED_TEST_SUITE(PatchTest, test::Dimensions);

TYPED_TEST(PatchTest, OrthogonalCellsAndWhitneyFormsPass) {
  constexpr int n = TypeParam::value;
  const Space<n> space(meshes::box(n, 3, {.jitter = 0.5 / n}));
  auto weights = support::random_values(space.K.size(0), 1);
  for (double& w : weights) w *= 0.02;
  EXPECT_LT(residual_of_linear<n>(space, diagonal_star<n>(space, Circumcentric{})), 1e-12);
  EXPECT_LT(residual_of_linear<n>(space, diagonal_star<n>(space, PowerCircumcentric{weights})), 1e-12);
  EXPECT_LT(residual_of_linear<n>(space, Matrix(whitney_mass(space.K, space.g, 1))), 1e-12);
  const double barycentric = residual_of_linear<n>(space, diagonal_star<n>(space, Barycentric{}));
  EXPECT_EQ(barycentric > 1e-3, n > 1) << barycentric;
}

/// The error in L2 of -Δu = f, u = 0 on the boundary of the unit square, u = sin πx sin πy.
double poisson_error(const Space<2>& space, const Matrix& star) {
  const auto is_inside = inside(space.K);
  std::vector<Eigen::Triplet<double>> kept;
  Eigen::Index count = 0;
  for (std::size_t v = 0; v < is_inside.size(); ++v)
    if (is_inside[v]) kept.emplace_back(static_cast<Eigen::Index>(v), count++, 1);
  Matrix P(space.K.size(0), count);
  P.setFromTriplets(kept.begin(), kept.end());
  const HodgeStar<2> lumped(space.K, space.g, Lumped{});
  Eigen::VectorXd u(space.K.size(0));
  for (Index v = 0; v < u.size(); ++v) {
    const double* p = space.g.points().data() + 2 * static_cast<std::size_t>(v);
    u[v] = std::sin(std::numbers::pi * p[0]) * std::sin(std::numbers::pi * p[1]);
  }
  const Eigen::VectorXd mass = to_eigen(lumped, 0);
  const Eigen::VectorXd load = 2 * std::numbers::pi * std::numbers::pi * mass.cwiseProduct(u);
  const Matrix A = P.transpose() * stiffness<2>(space.K, star) * P;
  const Eigen::SimplicialLDLT<Matrix> solver(A);
  const Eigen::VectorXd error = P * solver.solve(P.transpose() * load) - u;
  return std::sqrt(error.cwiseAbs2().dot(mass));
}

TEST(Poisson, ConvergesUnlessTheStarIsBarycentric) {
  const std::vector<std::pair<std::string, std::function<Matrix(const Space<2>&)>>> stars{
      {"circumcentric", [](const Space<2>& s) { return diagonal_star<2>(s, Circumcentric{}); }},
      {"Whitney", [](const Space<2>& s) { return Matrix(whitney_mass(s.K, s.g, 1)); }},
      {"HOT", [](const Space<2>& s) { return diagonal_star<2>(s, PowerCircumcentric{hot_weights(s.K, s.g).weights}); }},
      {"barycentric", [](const Space<2>& s) { return diagonal_star<2>(s, Barycentric{}); }}};
  for (const auto& [name, star] : stars) {
    std::vector<double> errors;
    for (const Index cells : {8, 16, 32, 64}) {
      const Space<2> space(meshes::box(2, cells, {.jitter = 0.3}));
      errors.push_back(poisson_error(space, star(space)));
    }
    const double order = std::log2(errors[2] / errors[3]);
    std::printf("%-13s  L2 errors %.2e %.2e %.2e %.2e, last order %.2f\n", name.c_str(), errors[0], errors[1],
                errors[2], errors[3], order);
    if (name == "barycentric") {
      EXPECT_LT(order, 0.3);
      EXPECT_GT(errors[3], 0.01);
    } else if (name == "HOT") {
      EXPECT_LT(errors[3], 3e-3) << "half of all facets were negative: positive has its price";
    } else {
      EXPECT_GT(order, 1.8);
      EXPECT_LT(errors[3], 1e-3);
    }
  }
}

}  // namespace
}  // namespace derham
