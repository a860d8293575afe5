#pragma once

// Errors against smooth solutions on finer and finer meshes: of Poisson's equation with different stars, of interpolation, of
// transport. Fields are those of [0, 1]^n, the meshes jittered so that no symmetry helps.
#include <derham/geometry/volumes.hpp>
#include <derham/hodge/eigen.hpp>
#include <derham/meshes/boxes.hpp>
#include <derham/operators/de_rham_map.hpp>
#include <derham/operators/form_space.hpp>
#include <derham/operators/interior_product.hpp>
#include <derham/operators/quadrature.hpp>
#include <derham/operators/whitney_map.hpp>
#include <derham/operators/whitney_mass.hpp>

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace derham::studies {

using Point = std::span<const double>;
using Field = std::vector<double>;  // components at a point

/// An oriented complex with its metric.
template <int n>
struct Space {
  explicit Space(const MeshData& mesh) : K(mesh.simplices), g(Geometry<n>::from_mesh(K, mesh)) {
    orient_by_volume(K, g);
  }
  SimplicialComplex<n> K;
  Geometry<n> g;
};

/// The root of ∫ |W w - ω|², by quadrature of the fourth order; ω(x) are components as WhitneyMap gives them.
template <int n, int k, class Smooth>
double l2_error(const Space<n>& space, const PrimalForm<n, k>& w, const Smooth& smooth) {
  const auto rule = simplex_rule<n>(4);
  const auto volumes = signed_volumes(space.K, space.g);
  const WhitneyMap<n> W(space.K, space.g);
  double sum = 0;
  std::vector<BarycentricPoint<n>> nodes(static_cast<std::size_t>(space.K.size(n)));
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    for (std::size_t t = 0; t < nodes.size(); ++t) nodes[t] = {static_cast<Index>(t), rule.points[q]};
    const auto values = W.at(w, nodes);
    for (std::size_t t = 0; t < nodes.size(); ++t) {
      const auto corners = space.g.corners(space.K, static_cast<Index>(t));
      std::array<double, n> x{};
      for (std::size_t v = 0; v <= n; ++v)
        for (std::size_t c = 0; c < n; ++c) x[c] += rule.points[q][v] * corners[v][c];
      const Field exact = smooth(Point(x));
      double square = 0;
      for (std::size_t c = 0; c < exact.size(); ++c) {
        const double difference = values[t * exact.size() + c] - exact[c];
        square += difference * difference;
      }
      sum += rule.weights[q] * std::abs(volumes[t]) * square;
    }
  }
  return std::sqrt(sum);
}

/// Which mesh Poisson's equation is solved on.
enum class Family {
  cut_cubes,  ///< a jittered box: half of its facets are not Delaunay
  delaunay    ///< a less jittered box, compressed along its main diagonal by 1/√(n+1): all dual volumes are positive
};

enum class Star { circumcentric, whitney, barycentric };

template <int n>
MeshData poisson_mesh(Family family, Index cells) {
  if (family == Family::cut_cubes) return meshes::box(n, cells, {.jitter = 0.6 / n});
  MeshData mesh = meshes::box(n, cells, {.jitter = 0.2 / n});
  const double compression = (1 - 1 / std::sqrt(n + 1.0)) / n;
  for (std::size_t i = 0; i < mesh.points.size(); i += n) {
    double sum = 0;
    for (std::size_t c = 0; c < n; ++c) sum += mesh.points[i + c];
    for (std::size_t c = 0; c < n; ++c) mesh.points[i + c] -= compression * sum;
  }
  return mesh;
}

/// u = Π sin πy_i with the coordinates y of the box before it was compressed, where the Laplacian is Σ (δ_ij + a) ∂_i ∂_j with a = 0
/// for cut cubes and 1 for the compressed box.
template <int n>
struct Solution {
  Family family;

  [[nodiscard]] std::array<double, n> coordinates(Point x) const {
    const double stretch = family == Family::delaunay ? (std::sqrt(n + 1.0) - 1) / n : 0;
    double sum = 0;
    for (const double value : x) sum += value;
    std::array<double, n> y{};
    for (std::size_t c = 0; c < n; ++c) y[c] = x[c] + stretch * sum;
    return y;
  }
  /// Π over the axes of sin πy, or of cos πy for those that are given.
  static double product(const std::array<double, n>& y, std::size_t i = n, std::size_t j = n) {
    double result = 1;
    for (std::size_t c = 0; c < n; ++c)
      result *= c == i || c == j ? std::cos(std::numbers::pi * y[c]) : std::sin(std::numbers::pi * y[c]);
    return result;
  }
  [[nodiscard]] double value(Point x) const { return product(coordinates(x)); }
  [[nodiscard]] double minus_laplacian(Point x) const {
    const auto y = coordinates(x);
    const double a = family == Family::delaunay ? 1 : 0;
    double sum = n * (1 + a) * product(y);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        if (i != j) sum -= a * product(y, i, j);
    return std::numbers::pi * std::numbers::pi * sum;
  }
  /// Σ_i ∂u/∂y_i dy_i in the coordinates x.
  [[nodiscard]] Field gradient(Point x) const {
    const auto y = coordinates(x);
    const double stretch = family == Family::delaunay ? (std::sqrt(n + 1.0) - 1) / n : 0;
    Field result(n);
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += result[i] = std::numbers::pi * product(y, i);
    for (double& component : result) component += stretch * sum;
    return result;
  }
};

struct PoissonErrors {
  double l2;    ///< of W u_h - u
  double max;   ///< at the vertices
  double grad;  ///< in L2 of d W u_h - du
};

/// -Δu = f with u = 0 on the boundary: d_0ᵀ ⋆_1 d_0 u = ⋆_0 f on the vertices inside.
template <int n>
PoissonErrors poisson(Family family, Star star, Index cells) {
  using Matrix = Eigen::SparseMatrix<double>;
  const Space<n> space(poisson_mesh<n>(family, cells));
  const Solution<n> solution{family};
  const auto matrix = [&](int k) -> Matrix {
    if (star == Star::whitney) return whitney_mass(space.K, space.g, k);
    const StarKind kind = star == Star::barycentric ? StarKind(Barycentric{}) : StarKind(Circumcentric{});
    return Matrix(to_eigen(HodgeStar<n>(space.K, space.g, kind), k).asDiagonal());
  };
  const DeRhamMap<n> R(space.K, space.g, 0);
  const auto f = R.function([&](Point x) { return solution.minus_laplacian(x); });
  const auto inside = FormSpace<n>::relative(space.K);
  const Matrix E = inside.extension(0), d0 = to_eigen(coboundary_matrix(space.K, 0));
  const Eigen::Map<const Eigen::VectorXd> load(f.values().data(), f.size());
  const Matrix A = E.transpose() * d0.transpose() * matrix(1) * d0 * E;
  const Eigen::VectorXd b = E.transpose() * (matrix(0) * load);
  const Eigen::VectorXd x = Eigen::SimplicialLDLT<Matrix>(A).solve(b);
  const auto u = inside.template extended<0>(std::span<const double>(x.data(), static_cast<std::size_t>(x.size())));

  const auto error = u - R.function([&](Point p) { return solution.value(p); });
  double largest = 0;
  for (const double e : error.values()) largest = std::max(largest, std::abs(e));
  return {l2_error<n, 0>(space, u, [&](Point p) { return Field{solution.value(p)}; }), largest,
          l2_error<n, 1>(space, d(u), [&](Point p) { return solution.gradient(p); })};
}

/// The error in L2 of W R ω for a k-form ω with components sin(3x_1 + i) cos(2x_n).
template <int n, int k>
double interpolation(Index cells) {
  const Space<n> space(meshes::box(n, cells, {.jitter = 0.6 / n}));
  const auto smooth = [](Point x) {
    Field value(static_cast<std::size_t>(binomial(n, k)));
    for (std::size_t i = 0; i < value.size(); ++i)
      value[i] = std::sin(3 * x.front() + static_cast<double>(i)) * std::cos(2 * x.back());
    return value;
  };
  const DeRhamMap<n> R(space.K, space.g, 4);
  return l2_error<n, k>(space, R.template components<k>(smooth), smooth);
}

struct Transport {
  double cfl_bound;  ///< of the time step
  int steps;
  double error;  ///< in L2, at the end
  double lost;   ///< of the integral, for k = n
};

/// ∂w/∂t + L_X w = 0 on a flat torus until t = 1/4, with constant X = (1, 1/2, 1/3): upwind, in steps of half the CFL bound.
template <int n, int k>
Transport transport(Index cells) {
  constexpr double time = 0.25, pi = std::numbers::pi;
  const Space<n> space(meshes::periodic_box(n, cells, {.jitter = 0.6 / n}));
  const auto X = [](Point) {
    Field value(n);
    for (std::size_t c = 0; c < n; ++c) value[c] = 1 / static_cast<double>(c + 1);
    return value;
  };
  const auto at = [&](double t) {
    return [t, X](Point x) {
      Field value(static_cast<std::size_t>(binomial(n, k)), 1.0);
      const Field velocity = X(x);
      for (std::size_t i = 0; i < value.size(); ++i)
        for (std::size_t c = 0; c < n; ++c)
          value[i] += std::sin(2 * pi * (x[c] - velocity[c] * t) + static_cast<double>(i)) / n;
      return value;
    };
  };
  const DeRhamMap<n> R(space.K, space.g, 4);
  const InteriorProduct i_X(space.K, space.g, X, Trace::upwind, 0);
  Transport result{i_X.cfl_bound(), 0, 0, 0};
  result.steps = static_cast<int>(std::ceil(time / (0.5 * result.cfl_bound)));
  auto w = R.template components<k>(at(0));
  const auto start = w;
  for (int step = 0; step < result.steps; ++step) w -= time / result.steps * lie_derivative(i_X, w);
  result.error = l2_error<n, k>(space, w, at(time));
  if constexpr (k == n) result.lost = std::abs(integral(w) - integral(start));
  return result;
}

}  // namespace derham::studies
