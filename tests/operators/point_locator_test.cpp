#include "derham/operators/point_locator.hpp"

#include "derham/complex/incidence.hpp"
#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/geometry/predicates.hpp"
#include "derham/meshes/balls.hpp"
#include "derham/meshes/tori.hpp"
#include "derham/operators/closest_point.hpp"
#include "derham/operators/de_rham_map.hpp"
#include "operators/spaces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace derham {
namespace {

using test::Space;
using Vector = std::vector<double>;

template <class T>
struct Locator : testing::Test {};
TYPED_TEST_SUITE(Locator, test::Dimensions);

/// Where the point is in space.
template <int n>
Vector position(const Space<n>& space, const BarycentricPoint<n>& point) {
  const auto corners = space.g.corners(space.K, point.simplex);
  Vector x(static_cast<std::size_t>(space.g.ambient_dimension()));
  for (std::size_t v = 0; v <= n; ++v)
    for (std::size_t c = 0; c < x.size(); ++c) x[c] += point.barycentric[v] * corners[v][c];
  return x;
}

double distance(std::span<const double> a, std::span<const double> b) {
  double square = 0;
  for (std::size_t c = 0; c < a.size(); ++c) square += (a[c] - b[c]) * (a[c] - b[c]);
  return std::sqrt(square);
}

template <int n>
void expect_sound(const BarycentricPoint<n>& point) {
  double sum = 0;
  for (const double x : point.barycentric) {
    EXPECT_GE(x, 0);
    sum += x;
  }
  EXPECT_NEAR(sum, 1, 1e-14);
}

/// The first top simplex that holds the point, of all, in exact arithmetic.
template <int n>
Index first_holding(const Space<n>& space, const double* x) {
  for (Index t = 0; t < space.K.size(n); ++t) {
    auto corners = space.g.corners(space.K, t);
    const Sign sign = orientation_sign<n>(corners);
    bool inside = true;
    for (std::size_t v = 0; v <= n && inside; ++v) {
      const double* const kept = corners[v];
      corners[v] = x;
      inside = orientation_sign<n>(corners) != -sign;
      corners[v] = kept;
    }
    if (inside) return t;
  }
  return -1;
}

TYPED_TEST(Locator, AgreesWithALookAtEverySimplexOnRandomPoints) {
  constexpr int n = TypeParam::value;
  const Space<n> space(test::random_mesh<n>(1));
  const PointLocator<n> locator(space.K, space.g);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-0.1, 1.1);
  Vector points(static_cast<std::size_t>(n) * (n < 4 ? 100000 : 5000));
  for (double& x : points) x = uniform(random);
  const auto found = locator.locate_all(points);
  Index outside = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double* const x = points.data() + i * n;
    ASSERT_EQ(found[i].simplex, first_holding(space, x)) << i;
    if (found[i].simplex < 0) {
      ++outside;
      continue;
    }
    expect_sound<n>(found[i]);
    EXPECT_LT(distance(position(space, found[i]), std::span(x, n)), 1e-13);
  }
  EXPECT_GT(outside, 0);
}

// Coordinates of this mesh are multiples of 1/4, so centres of edges are exactly on them.
TYPED_TEST(Locator, FindsVerticesAndMiddlesOfEdgesInTheirFirstSimplex) {
  constexpr int n = TypeParam::value;
  const Space<n> space(meshes::box(n, n < 4 ? 4 : 2));
  const PointLocator<n> locator(space.K, space.g);
  for (const int k : {0, 1}) {
    const auto cofaces = incidence(space.K, k, n);
    for (Index i = 0; i < space.K.size(k); ++i) {
      const auto corners = space.g.simplex_corners(space.K, k, i);
      Vector x(n);
      for (std::size_t c = 0; c < corners.size(); ++c) x[c % n] += corners[c] / (k + 1);
      const auto point = locator.locate(x);
      EXPECT_EQ(point.simplex, cofaces[i].front());
      EXPECT_EQ(position(space, point), x);
    }
  }
}

// Also where rounding puts the points outside, and far from the origin.
TYPED_TEST(Locator, FindsEveryPointOfEveryFace) {
  constexpr int n = TypeParam::value;
  std::mt19937 random(1);
  std::exponential_distribution<double> exponential;
  for (const double shift : {0.0, 1e5}) {
    const Space<n> space(test::moved(test::random_mesh<n>(2), n, 1, shift, 3));
    const PointLocator<n> locator(space.K, space.g);
    test::for_each_degree<n>([&]<int k>() {
      for (Index i = 0; i < space.K.size(k); ++i) {
        const auto corners = space.g.simplex_corners(space.K, k, i);
        std::array<double, static_cast<std::size_t>(k) + 1> lambda{};
        double sum = 0;
        for (double& x : lambda) sum += x = exponential(random);
        Vector x(n);
        for (std::size_t c = 0; c < corners.size(); ++c) x[c % n] += lambda[c / n] / sum * corners[c];
        const auto point = locator.locate(x);
        ASSERT_GE(point.simplex, 0) << "k = " << k << ", " << i;
        expect_sound<n>(point);
        EXPECT_LT(distance(position(space, point), x), 1e-13 * (1 + shift));
      }
    });
  }
}

TYPED_TEST(Locator, ReportsWhatIsOutsideAndFindsTheNearestPoint) {
  constexpr int n = TypeParam::value;
  const Space<n> space(test::random_mesh<n>(3));
  const PointLocator<n> locator(space.K, space.g);
  for (int c = 0; c < n; ++c)
    for (const double beyond : {1e-9, 0.5, 1e100}) {
      Vector x(n, 0.3);
      x[static_cast<std::size_t>(c)] = 1 + beyond;
      EXPECT_EQ(locator.locate(x).simplex, -1);
      const auto nearest = locator.nearest(x);
      EXPECT_NEAR(nearest.distance, beyond, 1e-15 * (1 + beyond));
      x[static_cast<std::size_t>(c)] = 1;
      if (beyond < 1) {
        EXPECT_LT(distance(position(space, nearest.point), x), 1e-13);
      }
    }
  for (const double x : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(locator.locate(Vector(n, x)).simplex, -1);
    EXPECT_THROW((void)locator.nearest(Vector(n, x)), InputError);
  }
}

// x - y makes no acute angle with the way from y to any corner: y is the closest point of a simplex; none is closer.
TYPED_TEST(Locator, FindsTheNearestPointInSpacesOfMoreDimensions) {
  constexpr int n = TypeParam::value;
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const Space<n> space(test::moved(test::random_mesh<n>(4, 2), n + 1, 1, 0.1, 3));
  const PointLocator<n> locator(space.K, space.g);
  Vector points(300 * (n + 1));
  for (double& x : points) x = normal(random);
  const auto found = locator.nearest_all(points);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::span<const double> x(points.data() + i * (n + 1), n + 1);
    const auto y = position(space, found[i].point);
    EXPECT_NEAR(distance(x, y), found[i].distance, 1e-13);
    for (const double* corner : space.g.corners(space.K, found[i].point.simplex)) {
      double dot = 0;
      for (std::size_t c = 0; c <= n; ++c) dot += (x[c] - y[c]) * (corner[c] - y[c]);
      EXPECT_LT(dot, 1e-12);
    }
    double least = std::numeric_limits<double>::infinity();
    for (Index t = 0; t < space.K.size(n); ++t)
      least = std::min(least, detail::ClosestPointSearch<n>(space.g.corners(space.K, t), x)().square);
    EXPECT_EQ(std::sqrt(least), found[i].distance);
  }
}

// Every simplex counts where its own corners are.
TYPED_TEST(Locator, FindsPointsOfPeriodicMeshes) {
  constexpr int n = TypeParam::value;
  const Space<n> space(meshes::periodic_box(n, 3, {.jitter = 0.3 / n}));
  const PointLocator<n> locator(space.K, space.g);
  BarycentricPoint<n> center;
  center.barycentric.fill(1.0 / (n + 1));
  for (center.simplex = 0; center.simplex < space.K.size(n); ++center.simplex) {
    const auto x = position(space, center);
    const auto found = locator.locate(x);
    EXPECT_EQ(found.simplex, center.simplex);
    EXPECT_LT(distance(position(space, found), x), 1e-14);
  }
}

TYPED_TEST(Locator, InterpolatesAtPoints) {
  constexpr int n = TypeParam::value;
  const Space<n> space(test::random_mesh<n>(5));
  const auto linear = [](std::span<const double> x) {
    double sum = 1;
    for (std::size_t c = 0; c < x.size(); ++c) sum += (static_cast<double>(c) - 1.3) * x[c];
    return sum;
  };
  const auto w = DeRhamMap<n>(space.K, space.g, 0).function(linear);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  Vector points(500 * n);
  for (double& x : points) x = uniform(random);
  const auto value = WhitneyMap<n>(space.K, space.g).at(w, PointLocator<n>(space.K, space.g).locate_all(points));
  for (std::size_t i = 0; i < value.size(); ++i)
    EXPECT_NEAR(value[i], linear(std::span<const double>(points).subspan(i * n, n)), 1e-13);
}

TEST(Locator, HasTheSameBitsOnAnyNumberOfThreads) {
  const Space<3> space(meshes::box(3, 8, {.jitter = 0.2}));
  const auto points = support::random_values(30000, 1);
  const int before = thread_count();
  set_thread_count(1);
  const PointLocator<3> alone(space.K, space.g);
  const auto inside = alone.locate_all(points);
  const auto nearest = alone.nearest_all(points);
  for (const int threads : {2, 4}) {
    set_thread_count(threads);
    const PointLocator<3> locator(space.K, space.g);
    const auto a = locator.locate_all(points);
    const auto b = locator.nearest_all(points);
    for (std::size_t i = 0; i < a.size(); ++i) {
      ASSERT_EQ(a[i].simplex, inside[i].simplex);
      ASSERT_EQ(a[i].barycentric, inside[i].barycentric);
      ASSERT_EQ(b[i].point.simplex, nearest[i].point.simplex);
      ASSERT_EQ(b[i].point.barycentric, nearest[i].point.barycentric);
    }
  }
  set_thread_count(before);
}

// Needles of all lengths: the tree is balanced by number, whatever the sizes.
TEST(Locator, FindsPointsInAGradedMesh) {
  MeshData mesh = meshes::box(2, 40);
  for (double& x : mesh.points) x = std::pow(x, 6);
  const Space<2> space(mesh);
  const PointLocator<2> locator(space.K, space.g);
  for (Index t = 0; t < space.K.size(2); ++t) {
    const auto x = position(space, {t, {0.4, 0.35, 0.25}});
    EXPECT_EQ(locator.locate(x).simplex, first_holding(space, x.data()));
  }
}

TEST(Locator, RefusesWhatDoesNotFit) {
  const Space<2> flat(meshes::box(2, 2)), curved(meshes::torus(5, 5));
  const PointLocator<2> in_plane(flat.K, flat.g), on_torus(curved.K, curved.g);
  EXPECT_THROW((void)in_plane.locate(Vector(3)), InputError);
  EXPECT_THROW((void)in_plane.locate(Vector(4)), InputError);
  EXPECT_THROW((void)in_plane.locate_all(Vector(3)), InputError);
  EXPECT_THROW((void)on_torus.locate(Vector(3)), GeometryError);
  EXPECT_NO_THROW((void)on_torus.nearest(Vector(3)));
  const auto lengths = Geometry<2>::from_squared_lengths(flat.K, squared_lengths(flat.K, flat.g));
  EXPECT_THROW(PointLocator<2>(flat.K, lengths), GeometryError);
  EXPECT_THROW(PointLocator<2>(curved.K, flat.g), InputError);
}

}  // namespace
}  // namespace derham
