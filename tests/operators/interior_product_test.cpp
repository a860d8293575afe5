#include "derham/operators/interior_product.hpp"

#include "derham/core/parallel.hpp"
#include "derham/meshes/lattices.hpp"
#include "derham/operators/de_rham_map.hpp"
#include "derham/operators/sharp_and_flat.hpp"
#include "operators/own_matrix.hpp"
#include "operators/spaces.hpp"
#include "support/random_forms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace derham {
namespace {

using support::distance;
using support::random_form;
using test::expect_own_matrix;
using test::for_each_degree;
using test::Space;
using Vector = std::vector<double>;
using Point = std::span<const double>;

template <class T>
struct InteriorProducts : testing::Test {};
TYPED_TEST_SUITE(InteriorProducts, test::Dimensions);

Vector constant(int d) {
  Vector X;
  for (int c = 0; c < d; ++c) X.push_back(1.1 - 0.7 * c);
  return X;
}

/// A constant k-form on k vectors, (k, m): Σ_I (1 + I) det_I.
template <int k>
double on_vectors(int m, std::span<const double> vectors) {
  const auto columns = subsets<k>(m);
  std::array<const double*, static_cast<std::size_t>(k)> rows{};
  for (std::size_t i = 0; i < k; ++i) rows[i] = vectors.data() + i * static_cast<std::size_t>(m);
  double sum = 0;
  for (std::size_t i = 0; i < columns.size(); ++i)
    sum += (1.0 + static_cast<double>(i)) * minor_of<k>(rows, columns[i]);
  return sum;
}

template <int k, int n>
PrimalForm<n, k> constant_form(const Space<n>& space) {
  const int m = space.g.ambient_dimension();
  return DeRhamMap<n>(space.K, space.g, 0).template form<k>([m](Point, auto edges) { return on_vectors<k>(m, edges); });
}

/// i_X of it by definition: X first, then the edges.
template <int k, int n>
PrimalForm<n, k - 1> contracted(const Space<n>& space, const Vector& X) {
  const int m = space.g.ambient_dimension();
  return DeRhamMap<n>(space.K, space.g, 0).template form<k - 1>([&X, m](Point, auto edges) {
    Vector all = X;
    all.insert(all.end(), edges.begin(), edges.end());
    return on_vectors<k>(m, all);
  });
}

/// Of period 1 along every axis, never 0.
template <int n>
Vector wavy(Point x) {
  const double pi = std::numbers::pi;
  Vector X(x.size());
  for (std::size_t i = 0; i < X.size(); ++i)
    X[i] = 1 + 0.3 * std::sin(2 * pi * x[(i + 1) % n]) + 0.2 * std::cos(2 * pi * x[i]);
  return X;
}

template <int n>
Space<n> torus(Index cells = 3) {
  std::vector<Index> id;
  Space<n> space(test::shuffled(meshes::periodic_box(n, cells, {.jitter = 0.4 / n, .seed = 2}), 3, id));
  orient_by_volume(space.K, space.g);
  return space;
}

TYPED_TEST(InteriorProducts, OfConstantsAreExact) {
  constexpr int n = TypeParam::value;
  const auto expect = [](const Space<n>& space, Trace trace) {
    const Vector X = constant(space.g.ambient_dimension());
    const InteriorProduct i_X(
        space.K, space.g, [&X](Point) -> const Vector& { return X; }, trace, 0);
    for_each_degree<n - 1>([&]<int j>() {
      const auto w = constant_form<j + 1>(space);
      EXPECT_LT(distance(i_X(w), contracted<j + 1>(space, X)), 1e-11) << "degree " << j + 1;
      EXPECT_LT(distance(lie_derivative(i_X, w), PrimalForm<n, j + 1>(space.K)), 1e-10) << "degree " << j + 1;
    });
  };
  expect(torus<n>(), Trace::mean);
  expect(torus<n>(), Trace::upwind);
  Space<n> box(test::generic_mesh<n>(1));
  orient_by_volume(box.K, box.g);
  expect(box, Trace::mean);
}

TYPED_TEST(InteriorProducts, LieDerivativeCommutesWithD) {
  constexpr int n = TypeParam::value;
  const Space<n> space(test::generic_mesh<n>(3, n < 3 ? 3 : 2));
  for (const Trace trace : {Trace::mean, Trace::upwind}) {
    const InteriorProduct i_X(space.K, space.g, wavy<n>, trace, 2);
    for_each_degree<n - 1>([&]<int k>() {
      const auto w = random_form<n, k>(space.K, 1);
      const auto first = lie_derivative(i_X, d(w)), last = d(lie_derivative(i_X, w));
      double size = 0;
      for (const double x : first.values()) size = std::max(size, std::abs(x));
      EXPECT_GT(size, 0.1);
      EXPECT_LT(distance(first, last), 1e-11 * size) << "degree " << k;
    });
  }
}

TYPED_TEST(InteriorProducts, LieDerivativeOfAFunctionIsAlongX) {
  constexpr int n = TypeParam::value;
  const Space<n> space(meshes::box(n, n < 4 ? 4 : 3));
  const DeRhamMap<n> R(space.K, space.g, 0);
  const Vector gradient = constant(n);
  const auto f = R.function([&](Point x) {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += gradient[i] * x[i];
    return sum;
  });
  const auto expected = R.function([&](Point x) {
    const Vector X = wavy<n>(x);
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += gradient[i] * X[i];
    return sum;
  });
  EXPECT_LT(distance(lie_derivative(InteriorProduct(space.K, space.g, wavy<n>, Trace::mean, 0), f), expected), 1e-11);
  const auto upwind = lie_derivative(InteriorProduct(space.K, space.g, wavy<n>, Trace::upwind, 0), f);
  const auto points = space.g.points();
  for (Index v = 0; v < space.K.size(0); ++v) {  // X > 0: it comes in where a coordinate is 0
    const auto x = points.subspan(static_cast<std::size_t>(v) * n, n);
    const bool entering = std::ranges::find(x, 0.0) != x.end();
    EXPECT_NEAR(upwind[v], entering ? 0 : expected[v], 1e-11);
  }
}

TYPED_TEST(InteriorProducts, TransportOfDensitiesConservesTheIntegralAndStaysPositive) {
  constexpr int n = TypeParam::value;
  const Space<n> space = torus<n>(n < 3 ? 6 : 3);
  const InteriorProduct i_X(space.K, space.g, wavy<n>, Trace::upwind, 2);
  PrimalForm<n, n> density(space.K);
  density[0] = 1;
  const double dt = i_X.cfl_bound();
  EXPECT_GT(dt, 0);
  for (int step = 0; step < 10; ++step) {
    density -= dt * lie_derivative(i_X, density);
    EXPECT_NEAR(integral(density), 1, 1e-14);
    EXPECT_GE(std::ranges::min(density.values()), -1e-15) << "step " << step;
  }
}

/// Beyond the bound the top simplex that empties fastest has less than nothing left.
TYPED_TEST(InteriorProducts, CflBoundIsSharpForConstantFields) {
  constexpr int n = TypeParam::value;
  const Space<n> space = torus<n>();
  const Vector X = constant(n);
  const InteriorProduct i_X(
      space.K, space.g, [&X](Point) { return Vector(X); }, Trace::upwind, 0);
  if constexpr (n < 4) {
    double fastest = 0;
    for (Index t = 0; t < space.K.size(n); ++t) {
      PrimalForm<n, n> one(space.K);
      one[t] = 1;
      fastest = std::max(fastest, lie_derivative(i_X, one)[t]);
    }
    EXPECT_NEAR(fastest * i_X.cfl_bound(), 1, 1e-12);
  }
}

TYPED_TEST(InteriorProducts, TransportOfFunctionsKeepsTheirRange) {
  constexpr int n = TypeParam::value;
  const Space<n> space = torus<n>(n < 3 ? 6 : 3);
  const InteriorProduct i_X(space.K, space.g, wavy<n>, Trace::upwind, 0);
  PrimalForm<n, 0> f(space.K);
  f[0] = 1;
  for (int step = 0; step < 10; ++step) {
    f -= i_X.cfl_bound() * lie_derivative(i_X, f);
    EXPECT_GE(std::ranges::min(f.values()), -1e-14);
    EXPECT_LE(std::ranges::max(f.values()), 1 + 1e-14);
  }
}

/// Translation along a constant field, every degree: of first order in h.
TEST(UpwindTransport, IsOfFirstOrderInThePlane) {
  const double pi = std::numbers::pi, time = 0.2;
  const auto error = [&]<int k>(std::integral_constant<int, k>, Index cells) {
    Space<2> space(meshes::periodic_box(2, cells, {.jitter = 0.2}));
    orient_by_volume(space.K, space.g);
    const DeRhamMap<2> R(space.K, space.g, 4);
    const auto at = [&](double t) {
      return R.components<k>([t, pi](Point x) {
        const double f = 2 + std::sin(2 * pi * (x[0] - t)) * std::cos(2 * pi * (x[1] - 0.5 * t));
        return k == 1 ? Vector{f, 1 - f * f / 4} : Vector{f};
      });
    };
    const InteriorProduct i_X(
        space.K, space.g,
        [](Point) {
          return Vector{1, 0.5};
        },
        Trace::upwind, 0);
    const int steps = static_cast<int>(std::ceil(time / (0.5 * i_X.cfl_bound())));
    auto w = at(0);
    for (int step = 0; step < steps; ++step) w -= time / steps * lie_derivative(i_X, w);
    const auto difference = w - at(time);
    double sum = 0;
    for (const double x : difference.values()) sum += x * x;
    return std::sqrt(sum / static_cast<double>(difference.size())) * std::pow(static_cast<double>(cells), k);
  };
  const auto expect = [&](auto k) { EXPECT_GT(error(k, 12) / error(k, 24), 1.5) << "degree " << k(); };
  expect(std::integral_constant<int, 0>());
  expect(std::integral_constant<int, 1>());
  expect(std::integral_constant<int, 2>());
}

/// Flat boxes down to a millionth of their length, turned: X runs along edges whose direction is known to round-off only.
TEST(UpwindTrace, FindsWhereXComesFromInThinTriangles) {
  for (const double height : {1.0, 1e-3, 1e-4, 1e-5, 1e-6})
    for (const double angle : {0.0, 0.3, 1.0}) {
      const double c = std::cos(angle), s = std::sin(angle);
      MeshData mesh = meshes::box({16, 16}, {.lengths = {1, height}});
      for (std::size_t i = 0; i < mesh.points.size(); i += 2) {
        const double x = mesh.points[i], y = mesh.points[i + 1];
        mesh.points[i] = c * x - s * y;
        mesh.points[i + 1] = s * x + c * y;
      }
      const Space<2> space(mesh);
      PrimalForm<2, 0> f(space.K);
      for (Index v = 0; v < f.size(); ++v) {
        const auto at = 2 * static_cast<std::size_t>(v);
        f[v] = c * mesh.points[at] + s * mesh.points[at + 1];
      }
      const InteriorProduct i_X(
          space.K, space.g,
          [c, s](Point) {
            return Vector{c, s};
          },
          Trace::upwind, 0);
      const auto along = lie_derivative(i_X, f);
      for (Index v = 0; v < f.size(); ++v)
        EXPECT_NEAR(along[v], f[v] < 1e-9 ? 0 : 1, 1e-6) << "height " << height << ", angle " << angle;
    }
}

/// A disk of 24 sides in two rings, its first vertex in the middle.
MeshData disk(double a, double b) {
  constexpr Index sides = 24;
  MeshData mesh;
  mesh.simplices = SimplexList(2, {});
  mesh.vertex_count = 1 + 2 * sides;
  mesh.ambient_dimension = 2;
  mesh.points = {0, 0};
  for (int ring = 1; ring <= 2; ++ring)
    for (int j = 0; j < sides; ++j) {
      const double angle = 2 * std::numbers::pi * (j + 0.5 * ring) / sides;
      mesh.points.push_back(a * ring / 2 * std::cos(angle));
      mesh.points.push_back(b * ring / 2 * std::sin(angle));
    }
  for (Index j = 0; j < sides; ++j) {
    const Index p = 1 + j, q = 1 + (j + 1) % sides;
    mesh.simplices.push_back({0, p, q});
    mesh.simplices.push_back({p, p + sides, q});
    mesh.simplices.push_back({q, p + sides, q + sides});
  }
  return mesh;
}

/// X runs along the wall, from outside of the polygon at its vertices: no inflow.
TEST(UpwindTrace, IsTakenFromInsideAtWalls) {
  const MeshData mesh = disk(1, 1);
  const Space<2> space(mesh);
  const auto turning = [](Point x) { return Vector{-x[1], x[0]}; };
  PrimalForm<2, 0> x(space.K);
  for (Index v = 0; v < x.size(); ++v) x[v] = mesh.points[2 * static_cast<std::size_t>(v)];
  for (const int order : {0, 1, 4}) {
    const InteriorProduct i_X(space.K, space.g, turning, Trace::upwind, order);
    const auto along = lie_derivative(i_X, x);
    for (Index v = 0; v < x.size(); ++v)
      EXPECT_NEAR(along[v], -mesh.points[2 * static_cast<std::size_t>(v) + 1], 1e-13);
    auto f = x;  // a whole turn; x + iy is an eigenfunction, which Euler's method carries with the factor 1 - i dt
    const double dt = i_X.cfl_bound();
    double growth = 1;
    for (double t = 0; t < 2 * std::numbers::pi; t += dt) {
      f -= dt * lie_derivative(i_X, f);
      growth *= std::sqrt(1 + dt * dt);
    }
    for (Index v = 0; v < f.size(); ++v) EXPECT_LE(std::abs(f[v]), growth * (1 + 1e-12));
  }
}

/// An oblique field comes in through a part of the wall of a disk: there, and only there, values stay.
TEST(UpwindTrace, IsZeroWhereXComesInThroughTheBoundary) {
  const MeshData mesh = disk(2, 1);
  const Space<2> space(mesh);
  const Vector X{1, 0.1};
  const InteriorProduct i_X(
      space.K, space.g, [&X](Point) -> const Vector& { return X; }, Trace::upwind, 0);
  PrimalForm<2, 0> x(space.K);
  for (Index v = 0; v < x.size(); ++v) x[v] = mesh.points[2 * static_cast<std::size_t>(v)];
  const auto along = lie_derivative(i_X, x);
  int zeros = 0;
  for (Index v = 0; v < x.size(); ++v) {
    const auto at = 2 * static_cast<std::size_t>(v);
    const double outwards = X[0] * mesh.points[at] / 4 + X[1] * mesh.points[at + 1];
    if (v < 25) {
      EXPECT_NEAR(along[v], 1, 1e-12);
    } else if (std::abs(outwards) > 0.05) {
      EXPECT_NEAR(along[v], outwards < 0 ? 0 : 1, 1e-12) << "vertex " << v;
    }
    zeros += along[v] == 0;
  }
  EXPECT_NEAR(zeros, 12, 1);
}

/// On a closed surface in space there is no boundary, and one of the tangential parts of X is taken everywhere.
TEST(UpwindTrace, IsTakenFromTheNearestTriangleOnCurvedSurfaces) {
  const SimplexList octahedron(2, {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5});
  const SimplicialComplex<2> K(octahedron);
  const auto g = Geometry<2>::from_points(K, {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1}, 3);
  const Vector axis{0.3, 0.5, 0.8};
  const InteriorProduct i_X(
      K, g,
      [&axis](Point x) {
        return Vector{axis[1] * x[2] - axis[2] * x[1], axis[2] * x[0] - axis[0] * x[2],
                      axis[0] * x[1] - axis[1] * x[0]};
      },
      Trace::upwind, 0);
  const auto along = lie_derivative(i_X, PrimalForm<2, 0>(K, {1, -1, 0.2, -0.2, 0.3, -0.3}));
  for (const double value : along.values()) EXPECT_GT(std::abs(value), 1e-3);
  PrimalForm<2, 2> density(K, {1, 0, 0, 0, 0, 0, 0, 0});  // nothing is lost, nothing becomes negative
  const double before = integral(density);
  for (int step = 0; step < 20; ++step) {
    density -= i_X.cfl_bound() * lie_derivative(i_X, density);
    EXPECT_NEAR(integral(density), before, 1e-14);
    for (Index t = 0; t < density.size(); ++t) EXPECT_GE(density[t] * before, -1e-15);
  }
}

/// The trace of one form at one vertex is that of the top simplex that holds a point a little upstream.
TYPED_TEST(InteriorProducts, UpwindIsTheValueALittleUpstream) {
  constexpr int n = TypeParam::value;
  const Space<n> space = torus<n>();
  const InteriorProduct i_X(space.K, space.g, wavy<n>, Trace::upwind, 0);
  const auto w = random_form<n, 1>(space.K, 1);
  const auto image = i_X(w);
  const Incidence tops = incidence(space.K, 0, n);
  for (Index s = 0; s < image.size(); ++s) {
    int holding = 0;
    for (const Index t : tops[s]) {
      const auto corners = space.g.corners(space.K, t);
      const auto all = space.K.template simplex<n>(t);
      const auto own = static_cast<std::size_t>(std::ranges::find(all, s) - all.begin());
      const Vector X = wavy<n>(Point(corners[own], n));
      SimplexFrame<n> frame(n);
      frame.set(corners);
      const auto rates = detail::barycentric_rates<n>(frame, X);
      bool holds = true;
      for (std::size_t v = 0; v <= n; ++v) holds = holds && (v == own || rates[v] <= 0);
      if (!holds) continue;
      ++holding;
      detail::WhitneySimplex<n, 1> whitney(n);
      whitney.set(space.g, w, t);
      Vector lambda(n + 1), components(n);
      lambda[own] = 1;
      whitney.evaluate(lambda.data(), components.data());
      double value = 0;
      for (std::size_t c = 0; c < n; ++c) value += components[c] * X[c];
      EXPECT_NEAR(image[s], value, 1e-11 * (1 + std::abs(value)));
    }
    EXPECT_EQ(holding, 1) << "vertex " << s;
  }
}

/// One value by definition: the mean of what the Whitney form of w is on X and the edges of s, in the top simplices around.
template <int n, int k>
double slow_mean(const Space<n>& space, const PrimalForm<n, k>& w, Index s, int order) {
  const int m = space.g.coordinate_dimension();
  const auto d = static_cast<std::size_t>(m);
  const auto rule = simplex_rule<k - 1>(order);
  const auto columns = subsets<k>(m);
  double sum = 0, volume = 0;
  const Incidence tops = incidence(space.K, k - 1, n);
  for (const Index t : tops[s]) {
    detail::WhitneySimplex<n, k> whitney(m);
    whitney.set(space.g, w, t);
    SimplexFrame<n> frame(m);
    frame.set(space.g.corners(space.K, t));
    const auto corners = space.g.corners(space.K, t);
    const auto all = space.K.template simplex<n>(t);
    const auto own = space.K.template simplex<k - 1>(s);
    std::vector<Vector> vectors(static_cast<std::size_t>(k), Vector(d));
    std::array<std::size_t, static_cast<std::size_t>(k)> place{};
    for (std::size_t i = 0; i < k; ++i)
      place[i] = static_cast<std::size_t>(std::ranges::find(all, own[i]) - all.begin());
    for (std::size_t i = 1; i < k; ++i)
      for (std::size_t c = 0; c < d; ++c) vectors[i][c] = corners[place[i]][c] - corners[place[0]][c];
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      Vector lambda(n + 1), x(d), components(columns.size());
      for (std::size_t i = 0; i < k; ++i) lambda[place[i]] = rule.points[q][i];
      for (std::size_t v = 0; v <= n; ++v)
        for (std::size_t c = 0; c < d; ++c) x[c] += lambda[v] * corners[v][c];
      vectors[0] = wavy<n>(x);
      whitney.evaluate(lambda.data(), components.data());
      std::array<const double*, static_cast<std::size_t>(k)> rows{};
      for (std::size_t i = 0; i < k; ++i) rows[i] = vectors[i].data();
      for (std::size_t c = 0; c < columns.size(); ++c)
        sum += frame.volume() * rule.weights[q] * components[c] * minor_of<k>(rows, columns[c]);
    }
    volume += frame.volume();
  }
  return sum / volume / static_cast<double>(factorial(k - 1));
}

TYPED_TEST(InteriorProducts, OfAnyFormAreTheMeanOfWhitneyForms) {
  constexpr int n = TypeParam::value;
  const Space<n> space = torus<n>();
  const InteriorProduct i_X(space.K, space.g, wavy<n>, Trace::mean, 2);
  for_each_degree<n - 1>([&]<int j>() {
    const auto w = random_form<n, j + 1>(space.K, 1);
    const auto image = i_X(w);
    for (Index s = 0; s < image.size(); s += std::max(Index{1}, image.size() / 10))
      EXPECT_NEAR(image[s], slow_mean(space, w, s, 2), 1e-12 * (1 + std::abs(image[s]))) << "degree " << j + 1;
  });
}

TYPED_TEST(InteriorProducts, AreOperatorsWithTheirMatrices) {
  constexpr int n = TypeParam::value;
  Space<n> space(test::generic_mesh<n>(3, n < 4 ? 2 : 1));
  orient_by_volume(space.K, space.g);
  const Derivative<n> d(space.K);
  for (const Trace trace : {Trace::mean, Trace::upwind}) {
    const InteriorProduct i_X(space.K, space.g, wavy<n>, trace, 1);
    for_each_degree<n>([&]<int k>() {
      using F = PrimalForm<n, k>;
      const auto w = random_form<n, k>(space.K, 1);
      if constexpr (k > 0) {
        const Operator<F, PrimalForm<n, k - 1>> A = i_X;
        expect_own_matrix(A);
        EXPECT_EQ(A(w), i_X(w)) << "degree " << k;
      }
      const Operator<F, F> L = lie_derivative(d, i_X);
      expect_own_matrix(L);
      EXPECT_LT(distance(L(w), lie_derivative(i_X, w)), 1e-11 * (1 + L.matrix().norm())) << "degree " << k;
      EXPECT_EQ(lie_derivative(d, i_X)(w), L(w));
    });
  }
}

/// 1 - dt L_X of densities has no negative entry, and columns with sum 1.
TYPED_TEST(InteriorProducts, TransportAsAnExpressionIsAStochasticMatrix) {
  constexpr int n = TypeParam::value;
  const Space<n> space = torus<n>();
  using Density = PrimalForm<n, n>;
  const InteriorProduct i_X(space.K, space.g, wavy<n>, Trace::upwind, 1);
  const Derivative<n> d(space.K);
  const Operator<Density, Density> step = identity<Density>(space.K) - i_X.cfl_bound() * lie_derivative(d, i_X);
  const SparseMatrix& A = step.matrix();
  EXPECT_GE(A.coeffs().minCoeff(), -1e-15);
  const Eigen::VectorXd sums = A.transpose() * Eigen::VectorXd::Ones(A.rows());
  EXPECT_LT((sums.array() - 1).abs().maxCoeff(), 1e-13);
  EXPECT_LT(A.diagonal().minCoeff(), 0.5) << "something flows";
}

TYPED_TEST(InteriorProducts, HaveTheSameBitsOnAnyNumberOfThreads) {
  constexpr int n = TypeParam::value;
  const Space<n> space = torus<n>(n == 1 ? 500 : n == 2 ? 12 : n == 3 ? 5 : 3);
  const InteriorProduct i_X(space.K, space.g, wavy<n>, Trace::upwind, 1);
  const auto w = random_form<n, n>(space.K, 1);
  const int before = thread_count();
  set_thread_count(1);
  const auto one = i_X(w);
  for (const int threads : {2, 4}) {
    set_thread_count(threads);
    EXPECT_EQ(i_X(w), one);
  }
  set_thread_count(before);
}

TYPED_TEST(InteriorProducts, AlgebraicOnesOfDualFormsAreExactOnConstants) {
  constexpr int n = TypeParam::value;
  Space<n> space(test::generic_mesh<n>(1));
  orient_by_volume(space.K, space.g);
  const HodgeStar<n> star(space.K, space.g);
  const Vector X = constant(n);
  Vector Y(n);
  for (std::size_t i = 0; i < n; ++i) Y[i] = 1 + static_cast<double>(i);
  double product = 0;
  for (std::size_t i = 0; i < n; ++i) product += X[i] * Y[i];
  const auto X_flat = DeRhamMap<n>(space.K, space.g, 0).circulation([&X](Point) { return Vector(X); });
  Vector everywhere;
  for (Index t = 0; t < space.K.size(n); ++t) everywhere.insert(everywhere.end(), Y.begin(), Y.end());
  const auto scalar = interior_product(star, X_flat, dpd_flat(space.K, space.g, everywhere));
  for (const double value : scalar.values()) EXPECT_NEAR(value, product, 1e-8);  // i_X Y♭ = X·Y, so i_∂x dx = +1
  for_each_degree<n - 1>([&]<int j>() {
    if constexpr (j >= 1) {  // dual (j+1)-forms, and once more
      const auto w = star(constant_form<n - j - 1>(space));
      const auto twice = interior_product(star, X_flat, interior_product(star, X_flat, w));
      EXPECT_LT(distance(star(twice), PrimalForm<n, n - j + 1>(space.K)), 1e-9) << "degree " << j + 1;
    }
  });
}

TYPED_TEST(InteriorProducts, AlgebraicOneOfTheVolumeFormIsTheFlux) {
  constexpr int n = TypeParam::value;
  Space<n> space(test::generic_mesh<n>(2));
  orient_by_volume(space.K, space.g);
  const HodgeStar<n> star(space.K, space.g);
  const Vector X = constant(n);
  const DeRhamMap<n> R(space.K, space.g, 0);
  Vector everywhere;
  for (Index t = 0; t < space.K.size(n); ++t) everywhere.insert(everywhere.end(), X.begin(), X.end());
  const auto i_X = interior_product(star, dpd_flat(space.K, space.g, everywhere), R.density([](Point) { return 1; }));
  EXPECT_LT(distance(i_X, R.flux([&X](Point) { return Vector(X); })), 1e-9);
}

TEST(AlgebraicInteriorProduct, InThePlaneOfPrimalOneForms) {
  Space<2> space(meshes::a_star_lattice(2, 4));
  orient_by_volume(space.K, space.g);
  const HodgeStar<2> star(space.K, space.g);
  Vector X;
  for (Index t = 0; t < space.K.size(2); ++t) X.insert(X.end(), {1, 0});
  const auto dx = DeRhamMap<2>(space.K, space.g, 0).circulation([](Point) { return Vector{1, 0}; });
  const auto i_X = interior_product(star, dpd_flat(space.K, space.g, X), dx);
  for (const double value : i_X.values()) EXPECT_NEAR(value, 1, 1e-12);
}

TYPED_TEST(InteriorProducts, AlgebraicOnesAreExpressions) {
  constexpr int n = TypeParam::value;
  Space<n> space(test::generic_mesh<n>(1, 2));
  orient_by_volume(space.K, space.g);
  const HodgeStar<n> star(space.K, space.g);
  const Derivative<n> d(space.K);
  const auto X_flat = random_form<n, 1>(space.K, 1);
  const auto i_X = interior_product(star, X_flat);
  for_each_degree<n - 1>([&]<int j>() {
    using F = DualForm<n, j + 1>;
    const Operator<F, DualForm<n, j>> A = i_X;
    expect_own_matrix(A);
    const auto w = random_form<n, j + 1, Side::dual>(space.K, 2);
    const double size = A.matrix().norm();
    EXPECT_LT(distance(A(w), interior_product(star, X_flat, w)), 1e-12 * size) << "degree " << j + 1;
    EXPECT_GT(size, 1e-3);
    const Operator<F, F> L = lie_derivative(d, i_X);
    const auto by_parts = lie_derivative([&](const auto& u) { return interior_product(star, X_flat, u); }, w);
    EXPECT_LT(distance(L(w), by_parts), 1e-12 * (1 + L.matrix().norm())) << "degree " << j + 1;
  });
  const auto dual = random_form<n, 1, Side::dual>(space.K, 3);
  const Operator<PrimalForm<n, n>, PrimalForm<n, n - 1>> A = interior_product(star, dual);
  expect_own_matrix(A);
  const auto w = random_form<n, n>(space.K, 4);
  EXPECT_LT(distance(A(w), interior_product(star, dual, w)), 1e-12 * A.matrix().norm());
}

TEST(InteriorProductErrors, AreNamed) {
  const Space<2> space(test::generic_mesh<2>(1));
  const auto make = [](const Space<2>& s, int order) { return InteriorProduct(s.K, s.g, wavy<2>, Trace::mean, order); };
  EXPECT_THROW((void)make(space, -1), InputError);
  EXPECT_THROW((void)make(Space<2>(test::generic_mesh<2>(1), squared_lengths(space.K, space.g)), 1), GeometryError);
  const InteriorProduct short_one(
      space.K, space.g, [](Point) { return Vector{1}; }, Trace::mean, 1);
  EXPECT_THROW((void)short_one(PrimalForm<2, 1>(space.K)), InputError);
}

/// Whoever samples the field refuses a value that is not finite and says where.
TEST(InteriorProductErrors, NameTheTopSimplexOfAValueThatIsNotFinite) {
  const Space<2> space(test::generic_mesh<2>(1));
  const auto expect_named = [](const auto& call) {
    try {
      call();
      ADD_FAILURE() << "no error";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("2-simplex "), std::string::npos) << error.what();
    }
  };
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (const Trace trace : {Trace::mean, Trace::upwind}) {
      const InteriorProduct i_X(
          space.K, space.g,
          [bad](Point x) {
            return Vector{1, x[0] > 0.5 ? bad : 1};
          },
          trace, 1);
      expect_named([&] { (void)i_X.cfl_bound(); });
      expect_named([&] { (void)i_X(PrimalForm<2, 1>(space.K)); });
      expect_named([&] { (void)i_X(PrimalForm<2, 2>(space.K)); });
      const Operator<PrimalForm<2, 1>, PrimalForm<2, 0>> A = i_X;
      expect_named([&] { (void)A.matrix(); });
    }
}

}  // namespace
}  // namespace derham
