#include "derham/boundary/eigen.hpp"
#include "derham/hodge/eigen.hpp"
#include "derham/operators/boundary_terms.hpp"
#include "derham/operators/form_space.hpp"
#include "derham/operators/weak_laplacian.hpp"
#include "derham/operators/whitney_mass.hpp"
#include "operators/sided_box.hpp"
#include "support/random_forms.hpp"

#include <gtest/gtest.h>
#include <Eigen/Dense>
#include <Eigen/SparseCholesky>

#include <cmath>
#include <numbers>

namespace derham {
namespace {

using test::for_each_degree;
using test::KoszulForm;
using test::SidedBox;

template <class T>
struct BoundaryProblems : testing::Test {};
TYPED_TEST_SUITE(BoundaryProblems, test::Dimensions);

template <class F>
Eigen::Map<const Eigen::VectorXd> vector_of(const F& w) {
  return {w.values().data(), w.size()};
}

/// Two ways to measure forms on a complex: ⋆ of k-forms as a matrix.
struct Whitney {
  template <int n>
  static SparseMatrix star(const SimplicialComplex<n>& K, const Geometry<n>& g, int k, const Material& a = {}) {
    return whitney_mass(K, g, k, a);
  }
};
struct Diagonal {
  template <int n>
  static SparseMatrix star(const SimplicialComplex<n>& K, const Geometry<n>& g, int k, const Material& a = {}) {
    return SparseMatrix(to_eigen(HodgeStar<n>(K, g, Circumcentric{}, a), k).asDiagonal());
  }
};

/// The values of A u = b off Γ, with those of `data` on it.
template <int n, int k>
PrimalForm<n, k> solution(const SparseMatrix& A, const Eigen::VectorXd& b, const FormSpace<n>& space,
                          const PrimalForm<n, k>& data) {
  const auto fixed = data - space.template extended<k>(space.restricted(data));
  const SparseMatrix E = space.extension(k);
  const Eigen::SparseMatrix<double> system = E.transpose() * A * E;
  const Eigen::VectorXd right = E.transpose() * (b - A * vector_of(fixed));
  const Eigen::VectorXd x = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(system).solve(right);
  return space.template extended<k>({x.data(), static_cast<std::size_t>(x.size())}, fixed);
}

/// δdu + c u = f on a box whose sides are prescribed, have natural data and Robin conditions in turn.
template <class Star, int n, int k>
struct MixedProblem {
  const SidedBox<n>& box;
  std::size_t shift;
  SparseMatrix A = derivative().transpose() * Star::star(box.K, box.g, k + 1) * derivative();
  Eigen::VectorXd b = Eigen::VectorXd::Zero(box.K.size(k));
  std::vector<Index> prescribed{};

  [[nodiscard]] SparseMatrix derivative() const { return to_eigen(coboundary_matrix(box.K, k)); }
  [[nodiscard]] SparseMatrix side_star(std::size_t s, double number) const {
    return Star::star(box.B.complex, box.metric, k, boundary_material(box.B, {{box.sides[s].facets, number}}));
  }

  /// `g(s)` is i_ν du on side s, `u` the solution.
  template <class G>
  void set_sides(const PrimalForm<n, k>& u, G&& g) {
    for (std::size_t s = 0; s < box.sides.size(); ++s) {
      const auto& facets = box.sides[s].facets;
      const std::size_t kind = (s + shift) % 3;
      if (kind == 0) prescribed.insert(prescribed.end(), facets.begin(), facets.end());
      if (kind == 1) b += vector_of(boundary_load(box.K, box.B, side_star(s, 1), g(s)));
      if (kind == 2) {
        const double h = 2 + static_cast<double>(s);
        A += robin_matrix(box.K, box.B, k, side_star(s, h));
        b += vector_of(boundary_load(box.K, box.B, side_star(s, h), trace(box.B, u) + (1 / h) * g(s)));
      }
    }
  }
};

template <class Star, int n, int k>
double error_of_linear_solution(const SidedBox<n>& box, double c, std::size_t shift) {
  const KoszulForm<n, k> form;
  const auto u = form.on(box.K, box.g);
  MixedProblem<Star, n, k> problem{box, shift};
  const SparseMatrix mass = c * Star::star(box.K, box.g, k);
  problem.A += mass;
  problem.b += mass * vector_of(u);
  problem.set_sides(u, [&](std::size_t s) { return form.normal_derivative(box, box.sides[s].normal); });
  const auto found = solution(problem.A, problem.b, FormSpace<n>(box.K, problem.prescribed), u);
  return support::distance(found, u);
}

TYPED_TEST(BoundaryProblems, PoissonIsExactOnLinearFunctions) {
  constexpr int n = TypeParam::value;
  const SidedBox<n> box(test::random_mesh<n>(1, n < 4 ? 3 : 2));
  for (std::size_t shift = 0; shift < 3; ++shift) {
    EXPECT_LT((error_of_linear_solution<Whitney, n, 0>(box, 0, shift)), 1e-12);
    EXPECT_LT((error_of_linear_solution<Diagonal, n, 0>(box, 0, shift)), 1e-12);
  }
}

/// Functions, 1-forms (curl–curl), …, (n-1)-forms (grad–div).
TYPED_TEST(BoundaryProblems, EveryDegreeIsExactOnItsLinearForms) {
  constexpr int n = TypeParam::value;
  const SidedBox<n> box(test::random_mesh<n>(1, n < 4 ? 2 : 1));
  for_each_degree<n - 1>([&]<int k>() {
    for (std::size_t shift = 0; shift < 3; ++shift) {
      EXPECT_LT((error_of_linear_solution<Whitney, n, k>(box, 1.5, shift)), 1e-12) << "degree " << k;
      if constexpr (n < 4) {  // the dual volumes of the hypercube's diagonals are zero, and the matrix is singular
        EXPECT_LT((error_of_linear_solution<Diagonal, n, k>(box, 1.5, shift)), 1e-10) << "degree " << k;
      }
    }
  });
}

/// Data and Robin terms on prescribed facets change nothing: what is essential wins.
TEST(BoundaryProblem, IgnoresNaturalTermsWhereValuesArePrescribed) {
  const SidedBox<2> box(test::random_mesh<2>(1));
  const KoszulForm<2, 0> form;
  const auto u = form.on(box.K, box.g);
  MixedProblem<Whitney, 2, 0> problem{box, 0};
  problem.set_sides(u, [&](std::size_t s) { return form.normal_derivative(box, box.sides[s].normal); });
  const SparseMatrix more = problem.side_star(0, 7);
  problem.A += robin_matrix(box.K, box.B, 0, more);
  problem.b += vector_of(boundary_load(box.K, box.B, more, form.normal_derivative(box, {1, 1})));
  const auto found = solution(problem.A, problem.b, FormSpace<2>(box.K, problem.prescribed), u);
  EXPECT_LT(support::distance(found, u), 1e-13);
}

/// -Δu = f with u = |x|² + x_0 x_{n-1}, in the norm of ⋆_0 on smaller and smaller cells.
template <class Star, int n>
double error_of_quadratic_solution(Index cells) {
  const SidedBox<n> box(meshes::box(n, cells, {.jitter = 0.4 / n}));
  const auto value = [](std::span<const double> x) {
    double sum = x[0] * x[n - 1];
    for (std::size_t c = 0; c < n; ++c) sum += x[c] * x[c];
    return sum;
  };
  const auto u = DeRhamMap<n>(box.K, box.g, 0).function(value);
  const auto g = [&](std::size_t s) {
    return DeRhamMap<n - 1>(box.B.complex, box.metric, 0).function([&](std::span<const double> x) {
      const auto& normal = box.sides[s].normal;
      double sum = x[0] * normal[n - 1] + x[n - 1] * normal[0];
      for (std::size_t c = 0; c < n; ++c) sum += 2 * x[c] * normal[c];
      return sum;
    });
  };
  MixedProblem<Star, n, 0> problem{box, 0};
  const SparseMatrix mass = Star::star(box.K, box.g, 0);
  problem.b += mass * Eigen::VectorXd::Constant(box.K.size(0), -2 * n - (n == 1 ? 2 : 0));
  problem.set_sides(u, g);
  const auto error = solution(problem.A, problem.b, FormSpace<n>(box.K, problem.prescribed), u) - u;
  return std::sqrt(vector_of(error).dot(mass * vector_of(error)));
}

template <class Star, int n>
void expect_second_order(Index cells) {
  const double coarse = error_of_quadratic_solution<Star, n>(cells),
               fine = error_of_quadratic_solution<Star, n>(2 * cells);
  const double order = std::log2(coarse / fine);
  EXPECT_GT(order, 1.8) << "errors " << coarse << ", " << fine;
  EXPECT_LT(order, 2.6) << "errors " << coarse << ", " << fine;
}

TEST(BoundaryProblem, QuadraticSolutionsConvergeWithSecondOrder) {
  EXPECT_LT((error_of_quadratic_solution<Whitney, 1>(8)), 1e-13) << "exact at the vertices of a line";
  EXPECT_LT((error_of_quadratic_solution<Diagonal, 1>(8)), 1e-13);
  expect_second_order<Whitney, 2>(16);
  expect_second_order<Diagonal, 2>(16);
  expect_second_order<Whitney, 3>(7);
  expect_second_order<Diagonal, 3>(7);
}

/// Edges of a box with its sides, or some of them, prescribed; the cavity's eigenvalues λ of δd on them, increasing.
Eigen::VectorXd resonances(const SidedBox<2>& box, const FormSpace<2>& space) {
  const SparseMatrix d = to_eigen(coboundary_matrix(box.K, 1)), E = space.extension(1);
  const SparseMatrix A = E.transpose() * SparseMatrix(d.transpose() * whitney_mass(box.K, box.g, 2) * d) * E;
  const SparseMatrix M = E.transpose() * whitney_mass(box.K, box.g, 1) * E;
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(Eigen::MatrixXd(A), Eigen::MatrixXd(M),
                                                                   Eigen::EigenvaluesOnly)
      .eigenvalues();
}

/// The electric field in a square of side 1 with walls of perfect electric conductor: λ = π²(i² + j²), i + j > 0, and the
/// gradients of functions that vanish on the walls; of perfect magnetic conductor: i, j > 0, and all gradients.
TEST(Cavity, ResonatesBetweenElectricAndMagneticConductors) {
  const SidedBox<2> box(meshes::box(2, 8));
  const double unit = std::numbers::pi * std::numbers::pi;
  const auto count = [&](const Eigen::VectorXd& lambda, double from, double to) {
    return (lambda.array() > from * unit && lambda.array() < to * unit).count();
  };
  const auto electric = resonances(box, FormSpace<2>::relative(box.K)), magnetic = resonances(box, FormSpace<2>(box.K));
  EXPECT_EQ(count(electric, -1e-8, 1e-8), 49) << "vertices inside";
  EXPECT_EQ(count(electric, 1e-8, 0.9), 0);
  EXPECT_EQ(count(electric, 0.9, 1.1), 2) << "(1, 0) and (0, 1)";
  EXPECT_EQ(count(electric, 1.1, 2.2), 1) << "(1, 1)";
  EXPECT_EQ(count(electric, 2.2, 4.5), 2) << "(2, 0) and (0, 2)";
  EXPECT_EQ(count(magnetic, -1e-8, 1e-8), 80) << "vertices without one: constants have no gradient";
  EXPECT_EQ(count(magnetic, 1e-8, 1.8), 0);
  EXPECT_EQ(count(magnetic, 1.8, 2.2), 1) << "(1, 1)";
  EXPECT_EQ(count(magnetic, 2.2, 4.5), 0);
}

/// A pulse E_y(x - t) in a strip between conductors, once to its end and back: the part of the energy that is left when the
/// ends have impedance h, tr ⋆dE = -⋆h ∂E/∂t.
double reflected_energy(double h) {
  const SidedBox<2> box(meshes::box({50, 1}, {.lengths = {1, 0.04}}));
  auto walls = box.sides[2].facets;
  walls.insert(walls.end(), box.sides[3].facets.begin(), box.sides[3].facets.end());
  const SparseMatrix E = FormSpace<2>(box.K, walls).extension(1), d = to_eigen(coboundary_matrix(box.K, 1));
  const auto impedance = boundary_material(box.B, {{box.sides[0].facets, h}, {box.sides[1].facets, h}});
  const auto restricted = [&](const SparseMatrix& A) { return Eigen::SparseMatrix<double>(E.transpose() * A * E); };
  const auto A = restricted(d.transpose() * whitney_mass(box.K, box.g, 2) * d),
             M = restricted(whitney_mass(box.K, box.g, 1)),
             C = restricted(robin_matrix(box.K, box.B, 1, whitney_mass(box.B.complex, box.metric, 1, impedance)));
  const auto field = [&](auto&& y) -> Eigen::VectorXd {
    const auto w = DeRhamMap<2>(box.K, box.g, 5).circulation([&](std::span<const double> x) {
      return std::array<double, 2>{0, y((x[0] - 0.5) / 0.1)};
    });
    return E.transpose() * vector_of(w);
  };
  Eigen::VectorXd e = field([](double s) { return std::exp(-s * s); }),
                  v = field([](double s) { return 20 * s * std::exp(-s * s); });
  const auto energy = [&] { return v.dot(M * v) + e.dot(A * e); };
  const double before = energy(), dt = 0.01;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> implicit(M + dt / 2 * C + dt * dt / 4 * A);
  for (int step = 0; step < 100; ++step) {  // the trapezoidal rule
    const Eigen::VectorXd a = implicit.solve(-(C * v) - A * (e + dt / 2 * v));
    e += dt * v + dt * dt / 2 * a;
    v += dt * a;
  }
  return energy() / before;
}

TEST(Impedance, ReflectsAsMuchAsItShould) {
  EXPECT_NEAR(reflected_energy(0), 1, 1e-10) << "perfect magnetic conductor";
  EXPECT_LT(reflected_energy(1), 1e-3) << "matched: absorbing";
  EXPECT_NEAR(reflected_energy(3), 0.25, 0.01) << "((1 - h) / (1 + h))²";
}

/// Constant u in the mixed Laplacian of k-forms, σ = δu = 0. The sides have in turn u and σ prescribed; tr ⋆u and tr ⋆du as
/// natural data; u prescribed and tr ⋆u as natural data.
template <int n, int k>
double error_of_constant_solution(const SidedBox<n>& box, std::size_t shift) {
  const auto form = test::random_constant<n, k>(21);
  const auto u =
      DeRhamMap<n>(box.K, box.g, 0).template components<k>([&](std::span<const double>) { return form.components; });
  std::array<std::vector<Index>, 2> prescribed;  // of σ, of u
  DualForm<n, n - k + 1> load(box.K);
  for (std::size_t s = 0; s < box.sides.size(); ++s) {
    const auto& [facets, normal] = box.sides[s];
    const std::size_t kind = (s + shift) % 3;
    if (kind == 0) prescribed[0].insert(prescribed[0].end(), facets.begin(), facets.end());
    if (kind != 1) prescribed[1].insert(prescribed[1].end(), facets.begin(), facets.end());
    if (kind == 0) continue;
    const auto across = DeRhamMap<n - 1>(box.B.complex, box.metric, 0)
                            .template form<k - 1>([&](std::span<const double>, std::span<const double> rows) {
                              return form.contracted(normal.data(), rows);
                            });
    load += boundary_load(
        box.K, box.B, whitney_mass(box.B.complex, box.metric, k - 1, boundary_material(box.B, {{facets, 1}})), across);
  }
  const FormSpace<n> sigma(box.K, prescribed[0]), space(box.K, prescribed[1]);
  const auto mixed = mixed_laplace_de_rham(box.K, box.g, k);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(mixed.matrix.rows());
  b.head(mixed.sigma) = vector_of(load);
  const auto fixed = u - space.template extended<k>(space.restricted(u));
  b -= mixed.matrix.rightCols(box.K.size(k)) * vector_of(fixed);

  Eigen::MatrixXd E =
      Eigen::MatrixXd::Zero(mixed.matrix.rows(), sigma.extension(k - 1).cols() + space.extension(k).cols());
  E.topLeftCorner(mixed.sigma, sigma.extension(k - 1).cols()) = sigma.extension(k - 1);
  E.bottomRightCorner(box.K.size(k), space.extension(k).cols()) = space.extension(k);
  const Eigen::VectorXd x = E * (E.transpose() * mixed.matrix * E).fullPivLu().solve(E.transpose() * b);
  return (x.tail(box.K.size(k)) + vector_of(fixed) - vector_of(u)).norm() + x.head(mixed.sigma).norm();
}

TYPED_TEST(BoundaryProblems, MixedLaplaciansTakeTheNormalPartAsNaturalData) {
  constexpr int n = TypeParam::value;
  const SidedBox<n> box(test::random_mesh<n>(1, n < 3 ? 3 : 1));
  if constexpr (n < 4)
    for_each_degree<n - 1>([&]<int below>() {
      for (std::size_t shift = 0; shift < 3; ++shift)
        EXPECT_LT((error_of_constant_solution<n, below + 1>(box, shift)), 1e-10)
            << "degree " << below + 1 << ", shift " << shift;
    });
}

}  // namespace
}  // namespace derham
