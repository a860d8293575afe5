#include "derham/operators/whitney_map.hpp"

#include "derham/complex/incidence.hpp"
#include "derham/core/parallel.hpp"
#include "derham/forms/exterior_derivative.hpp"
#include "derham/meshes/balls.hpp"
#include "derham/operators/de_rham_map.hpp"
#include "operators/polynomial.hpp"
#include "operators/spaces.hpp"

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace derham {
namespace {

using test::for_each_degree;
using test::for_each_space;
using test::Space;

template <class T>
struct Whitney : testing::Test {};
TYPED_TEST_SUITE(Whitney, test::Dimensions);

/// Corners of top simplex t, one a column.
template <int n>
Eigen::MatrixXd corners_of(const Space<n>& space, Index t) {
  const int d = space.g.coordinate_dimension();
  Eigen::MatrixXd p(d, n + 1);
  const auto corners = space.g.corners(space.K, t);
  for (int v = 0; v <= n; ++v)
    for (int c = 0; c < d; ++c) p(c, v) = corners[static_cast<std::size_t>(v)][c];
  return p;
}

/// Gradients of barycentric coordinates, one a column: the columns of (Eᵀ)^+ with E the edges from corner 0.
Eigen::MatrixXd gradients_of(const Eigen::MatrixXd& p) {
  const Eigen::Index n = p.cols() - 1;
  const Eigen::MatrixXd E = p.rightCols(n).colwise() - p.col(0);
  Eigen::MatrixXd g(p.rows(), n + 1);
  g.rightCols(n) = E * (E.transpose() * E).inverse();
  g.col(0) = -g.rightCols(n).rowwise().sum();
  return g;
}

/// ω(v_1, …, v_k) for components in lexicographic order and vectors as columns.
template <int k>
double evaluate(const std::vector<double>& w, const Eigen::MatrixXd& vectors) {
  const auto columns = subsets<k>(static_cast<int>(vectors.rows()));
  std::array<const double*, static_cast<std::size_t>(k)> rows{};
  for (std::size_t i = 0; i < k; ++i) rows[i] = vectors.col(static_cast<Eigen::Index>(i)).data();
  double sum = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) sum += w[i] * minor_of<k>(rows, columns[i]);
  return sum;
}

template <int n>
BarycentricPoint<n> random_point(Index t, std::mt19937& random) {
  std::exponential_distribution<double> exponential;
  BarycentricPoint<n> point{t, {}};
  double sum = 0;
  for (double& x : point.barycentric) sum += x = exponential(random);
  for (double& x : point.barycentric) x /= sum;
  return point;
}

/// Local vertices of the k-faces of an n-simplex.
template <int n, int k>
auto local_faces() {
  return subsets<k + 1>(n + 1);
}

template <int n, int k>
Index face_index(const SimplicialComplex<n>& K, Index t, const std::array<int, static_cast<std::size_t>(k) + 1>& face) {
  unsigned mask = 0;
  for (const int v : face) mask |= 1U << v;
  return face_indices(K, t)[mask];
}

// The specification: the defining formula, basis form by basis form, on random vectors.
TYPED_TEST(Whitney, IsItsDefinition) {
  constexpr int n = TypeParam::value;
  std::mt19937 random(1);
  for_each_space<n>([&](const Space<n>& space) {
    const WhitneyMap<n> W(space.K, space.g);
    for_each_degree<n>([&]<int k>() {
      const auto w = test::random_values_on<n, k>(space.K, 3);
      for (Index t = 0; t < space.K.size(n); t += 7) {
        const auto g = gradients_of(corners_of(space, t));
        const auto point = random_point<n>(t, random);
        const Eigen::MatrixXd vectors = Eigen::MatrixXd::Random(g.rows(), k);
        double expected = 0;
        for (const auto& face : local_faces<n, k>()) {
          double form = 0;
          for (std::size_t i = 0; i <= k; ++i) {
            Eigen::MatrixXd others(g.rows(), k);
            for (std::size_t j = 0, column = 0; j <= k; ++j)
              if (j != i) others.col(static_cast<Eigen::Index>(column++)) = g.col(face[j]);
            form += (i % 2 == 0 ? 1 : -1) * point.barycentric[static_cast<std::size_t>(face[i])] *
                    (others.transpose() * vectors).determinant();
          }
          const Index f = face_index<n, k>(space.K, t, face);
          expected += static_cast<double>(factorial(k)) * form * w[f] * space.K.sign(k, f);
        }
        EXPECT_NEAR(evaluate<k>(W.at(w, point), vectors), expected, 1e-10 * (1 + std::abs(expected)));
      }
    });
  });
}

// R W = id, from the side of every top simplex; so the traces on both sides of a face agree, too.
TYPED_TEST(Whitney, HasTheIntegralsItWasMadeFrom) {
  constexpr int n = TypeParam::value;
  for_each_space<n>([&](const Space<n>& space) {
    const WhitneyMap<n> W(space.K, space.g);
    for_each_degree<n>([&]<int k>() {
      const auto w = test::random_values_on<n, k>(space.K, 1);
      const auto rule = simplex_rule<k>(1);
      for (Index t = 0; t < space.K.size(n); t += 3) {
        const auto p = corners_of(space, t);
        for (const auto& face : local_faces<n, k>()) {
          Eigen::MatrixXd edges(p.rows(), k);
          for (int e = 0; e < k; ++e) edges.col(e) = p.col(face[static_cast<std::size_t>(e) + 1]) - p.col(face[0]);
          double mean = 0;
          for (std::size_t q = 0; q < rule.points.size(); ++q) {
            BarycentricPoint<n> point{t, {}};
            for (std::size_t v = 0; v <= k; ++v)
              point.barycentric[static_cast<std::size_t>(face[v])] = rule.points[q][v];
            mean += rule.weights[q] * evaluate<k>(W.at(w, point), edges);
          }
          const Index f = face_index<n, k>(space.K, t, face);
          ASSERT_NEAR(mean / static_cast<double>(factorial(k)) * space.K.sign(k, f), w[f], 1e-11);
        }
      }
    });
  });
}

TYPED_TEST(Whitney, ReproducesConstantFormsAtEveryPoint) {
  constexpr int n = TypeParam::value;
  std::mt19937 random(1);
  const Space<n> flat(test::random_mesh<n>(2)), raised(test::moved(test::random_mesh<n>(2), n + 1, 1, 1, 5));
  for (const Space<n>* space : {&flat, &raised}) {
    const int m = space->g.ambient_dimension();
    const WhitneyMap<n> W(space->K, space->g);
    const DeRhamMap<n> R(space->K, space->g, 0);
    for_each_degree<n>([&]<int k>() {
      const auto constant = test::random_form<k>(m, 0, 4);
      const auto w = R.template components<k>(constant);
      const auto expected = constant(std::vector<double>(static_cast<std::size_t>(m)));
      for (Index t = 0; t < space->K.size(n); ++t) {
        const auto value = W.at(w, random_point<n>(t, random));
        const auto p = corners_of(*space, t);
        const Eigen::MatrixXd tangents = p.leftCols(k).colwise() - p.col(n);
        EXPECT_NEAR(evaluate<k>(value, tangents), evaluate<k>(expected, tangents), 1e-13);
        if (m > n) continue;
        for (std::size_t c = 0; c < value.size(); ++c) EXPECT_NEAR(value[c], expected[c], 1e-12);
      }
    });
  }
}

// d of the affine form: Σ_c dx^c ∧ ∂_c ω with ∂_c ω = Σ_v ω(corner v) ∂_c λ_v.
TYPED_TEST(Whitney, CommutesWithTheExteriorDerivativeAtEveryPoint) {
  constexpr int n = TypeParam::value;
  std::mt19937 random(1);
  const Space<n> space(test::random_mesh<n>(3));
  const WhitneyMap<n> W(space.K, space.g);
  for_each_degree<n - 1>([&]<int k>() {
    const auto w = test::random_values_on<n, k>(space.K, 1);
    const auto dw = d(w);
    const auto lower = subsets<k>(n);
    for (Index t = 0; t < space.K.size(n); ++t) {
      const auto g = gradients_of(corners_of(space, t));
      Eigen::MatrixXd derivative = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(lower.size()), n);
      for (std::size_t v = 0; v <= n; ++v) {
        BarycentricPoint<n> corner{t, {}};
        corner.barycentric[v] = 1;
        const auto value = W.at(w, corner);
        derivative += Eigen::Map<const Eigen::VectorXd>(value.data(), derivative.rows()) *
                      g.col(static_cast<Eigen::Index>(v)).transpose();
      }
      const auto value = W.at(dw, random_point<n>(t, random));
      const auto sets = subsets<k + 1>(n);
      for (std::size_t s = 0; s < sets.size(); ++s) {
        double expected = 0;
        for (std::size_t j = 0; j <= k; ++j) {
          std::array<int, static_cast<std::size_t>(k)> rest{};
          for (std::size_t i = 0; i < k; ++i) rest[i] = sets[s][i < j ? i : i + 1];
          expected += (j % 2 == 0 ? 1 : -1) * derivative(std::ranges::find(lower, rest) - lower.begin(), sets[s][j]);
        }
        EXPECT_NEAR(value[s], expected, 1e-9 * (1 + std::abs(expected)));
      }
    }
  });
}

// What can be evaluated on tangent vectors of a facet agrees on both sides: for k = 1 the tangential, for k = n-1 the
// normal part.
TYPED_TEST(Whitney, IsContinuousAcrossFacetsAlongThem) {
  constexpr int n = TypeParam::value;
  std::mt19937 random(1);
  const Space<n> space(test::random_mesh<n>(4));
  const WhitneyMap<n> W(space.K, space.g);
  const auto sides = facet_cofaces(space.K);
  for_each_degree<n - 1>([&]<int k>() {
    const auto w = test::random_values_on<n, k>(space.K, 1);
    Index shared = 0;
    double jump = 0;
    for (Index f = 0; f < space.K.size(n - 1); ++f) {
      if (sides.count[f] != 2) continue;
      ++shared;
      std::array<std::vector<double>, 2> value;
      Eigen::MatrixXd tangents;
      const auto on_facet = random_point<n>(0, random);  // the last coordinate goes to the first
      for (const std::size_t side : {0U, 1U}) {
        const Index t = (side == 0 ? sides.first : sides.second)[static_cast<std::size_t>(f)];
        const auto facet = space.K.simplex(n - 1, f), corners = space.K.simplex(n, t);
        const auto p = corners_of(space, t);
        BarycentricPoint<n> point{t, {}};
        Eigen::MatrixXd q(n, n);
        for (std::size_t v = 0; v < n; ++v) {
          const auto at = static_cast<std::size_t>(std::ranges::find(corners, facet[v]) - corners.begin());
          point.barycentric[at] = on_facet.barycentric[v] + (v == 0 ? on_facet.barycentric[n] : 0);
          q.col(static_cast<Eigen::Index>(v)) = p.col(static_cast<Eigen::Index>(at));
        }
        value[side] = W.at(w, point);
        tangents = q.leftCols(k).colwise() - q.col(n - 1);
      }
      EXPECT_NEAR(evaluate<k>(value[0], tangents), evaluate<k>(value[1], tangents), 1e-11);
      for (std::size_t c = 0; c < value[0].size(); ++c) jump = std::max(jump, std::abs(value[0][c] - value[1][c]));
    }
    EXPECT_GT(shared, 0);
    if (k > 0) {
      EXPECT_GT(jump, 0.1) << "the rest of it is not continuous";
    }
  });
}

/// Root mean square over the barycentres of a jittered box.
template <int n, int k>
double interpolation_error(Index cells) {
  constexpr auto width = static_cast<std::size_t>(binomial(n, k));
  const auto form = [](std::span<const double> x) {
    std::vector<double> value(width);
    for (std::size_t i = 0; i < width; ++i)
      value[i] = std::sin(1.5 * x.front() + static_cast<double>(i)) * std::cos(2 * x.back());
    return value;
  };
  const Space<n> space(meshes::box(n, cells, {.jitter = 0.2 / n}));
  const auto w = DeRhamMap<n>(space.K, space.g, 4).template components<k>(form);
  const auto value = WhitneyMap<n>(space.K, space.g).at_barycenters(w);
  double square = 0;
  for (Index t = 0; t < space.K.size(n); ++t) {
    const Eigen::VectorXd center = corners_of(space, t).rowwise().mean();
    const auto expected = form(std::span<const double>(center.data(), static_cast<std::size_t>(n)));
    for (std::size_t c = 0; c < width; ++c)
      square += std::pow(value[static_cast<std::size_t>(t) * width + c] - expected[c], 2);
  }
  return std::sqrt(square / static_cast<double>(space.K.size(n)));
}

template <int n>
void expect_convergence(Index cells) {
  for_each_degree<n>([cells]<int k>() {
    const double order = std::log2(interpolation_error<n, k>(cells) / interpolation_error<n, k>(2 * cells));
    EXPECT_GT(order, k == 0 ? 1.85 : 0.85) << "n = " << n << ", k = " << k;
  });
}

// Order 2 for functions, 1 for the other degrees.
TEST(Whitney, ConvergesOnSmoothForms) {
  expect_convergence<1>(20);
  expect_convergence<2>(12);
  expect_convergence<3>(5);
}

TYPED_TEST(Whitney, GivesFluxFieldsBack) {
  constexpr int n = TypeParam::value;
  const Space<n> space(test::random_mesh<n>(6));
  const auto field = [](std::span<const double>) {
    std::array<double, n> X{};
    for (std::size_t c = 0; c < n; ++c) X[c] = 1.0 + static_cast<double>(c * c);
    return X;
  };
  const auto flux = DeRhamMap<n>(space.K, space.g, 0).flux(field);
  const auto vectors = flux_vectors(WhitneyMap<n>(space.K, space.g).at_barycenters(flux), n);
  ASSERT_EQ(vectors.size(), static_cast<std::size_t>(space.K.size(n)) * n);
  for (std::size_t i = 0; i < vectors.size(); ++i) EXPECT_NEAR(vectors[i], field({})[i % n], 1e-12);
}

TEST(Whitney, OnSurfacesIsTangential) {
  const Space<2> space(meshes::icosphere(1));
  const WhitneyMap<2> W(space.K, space.g);
  const auto value = W.at_barycenters(test::random_values_on<2, 1>(space.K, 1));
  for (Index t = 0; t < space.K.size(2); ++t) {
    const Eigen::Matrix3d p = corners_of(space, t);
    const Eigen::Vector3d a = p.col(1) - p.col(0), b = p.col(2) - p.col(0);
    EXPECT_NEAR(Eigen::Map<const Eigen::Vector3d>(value.data() + 3 * t).dot(a.cross(b).normalized()), 0, 1e-13);
  }
}

TEST(Whitney, HasTheSameBitsOnAnyNumberOfThreadsAndNaNOutside) {
  const Space<3> space(meshes::box(3, 8, {.jitter = 0.2}));
  const WhitneyMap<3> W(space.K, space.g);
  const auto w = test::random_values_on<3, 2>(space.K, 1);
  const int before = thread_count();
  set_thread_count(1);
  const auto expected = W.at_barycenters(w);
  for (const int threads : {2, 4}) {
    set_thread_count(threads);
    EXPECT_EQ(W.at_barycenters(w), expected);
  }
  set_thread_count(before);
  const std::vector<BarycentricPoint<3>> points{{}, {5, {0.25, 0.25, 0.25, 0.25}}};
  const auto value = W.at(w, points);
  ASSERT_EQ(value.size(), 6U);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_TRUE(std::isnan(value[c]));
    EXPECT_EQ(value[3 + c], expected[15 + c]);
  }
}

TEST(Whitney, RefusesWhatDoesNotFit) {
  const Space<2> a(meshes::box(2, 2)), b(meshes::box(2, 2));
  const WhitneyMap<2> W(a.K, a.g);
  EXPECT_THROW((void)W.at_barycenters(PrimalForm<2, 1>(b.K)), InputError);
  EXPECT_THROW((void)W.at(PrimalForm<2, 1>(a.K), BarycentricPoint<2>{8, {}}), InputError);
  EXPECT_THROW((void)flux_vectors(std::vector<double>(4), 3), InputError);
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}});
  const auto flat = Geometry<2>::from_points(K, {0, 0, 1, 1, 2, 2}, 2);
  try {
    (void)WhitneyMap<2>(K, flat);
    FAIL();
  } catch (const GeometryError& error) {
    EXPECT_NE(std::string(error.what()).find("(0, 1, 2)"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace derham
