#include "derham/operators/sharp_and_flat.hpp"

#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/dual/dual_cell.hpp"
#include "derham/hodge/hodge_star.hpp"
#include "derham/operators/de_rham_map.hpp"
#include "derham/operators/dual_shares.hpp"
#include "derham/operators/whitney_map.hpp"
#include "operators/spaces.hpp"
#include "support/random_forms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

namespace derham {
namespace {

using support::distance;
using test::for_each_degree;
using test::for_each_space_of;
using test::Space;
using Vector = std::vector<double>;

template <class T>
struct SharpAndFlat : testing::Test {};
TYPED_TEST_SUITE(SharpAndFlat, test::Dimensions);

Vector constant(int d) {
  Vector X;
  for (int c = 0; c < d; ++c) X.push_back(1.5 - 0.7 * c);
  return X;
}

Vector repeated(const Vector& X, Index times) {
  Vector result;
  for (Index i = 0; i < times; ++i) result.insert(result.end(), X.begin(), X.end());
  return result;
}

double distance(const Vector& a, const Vector& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

/// X in the plane of the mesh, which is flat.
template <int n>
Vector tangential(const Space<n>& space, const Vector& X) {
  SimplexFrame<n> frame(static_cast<int>(X.size()));
  frame.set(space.g.corners(space.K, 0));
  Vector result(X.size());
  for (std::size_t i = 0; i < n; ++i) {
    const double* const axis = frame.axes().data() + i * X.size();
    double along = 0;
    for (std::size_t c = 0; c < X.size(); ++c) along += axis[c] * X[c];
    for (std::size_t c = 0; c < X.size(); ++c) result[c] += along * axis[c];
  }
  return result;
}

template <int n, class Body>
void for_each_mesh(Body&& body) {  // generic, and with right angles: zeros among dual volumes
  for_each_space_of<n>(test::generic_mesh<n>(1), body);
  for_each_space_of<n>(meshes::box(n, 2), body);
}

TYPED_TEST(SharpAndFlat, AreExactOnConstants) {
  constexpr int n = TypeParam::value;
  for_each_mesh<n>([](const Space<n>& space) {
    if (space.g.source() == MetricSource::lengths) return;
    const Vector X = constant(space.g.ambient_dimension()), shadow = tangential(space, X);
    const auto form = DeRhamMap<n>(space.K, space.g, 1).circulation([&](auto) -> const Vector& { return X; });
    const Vector on_tops = repeated(X, space.K.size(n)), on_vertices = repeated(X, space.K.size(0));
    EXPECT_LT(distance(whitney_sharp(space.g, form), repeated(shadow, space.K.size(n))), 1e-10);
    EXPECT_LT(distance(pd_sharp(space.g, form), repeated(shadow, space.K.size(n))), 1e-9);
    EXPECT_LT(distance(pp_sharp(space.g, form), repeated(shadow, space.K.size(0))), 1e-9);
    EXPECT_LT(distance(dpp_flat(space.K, space.g, on_tops), form), 1e-9);
    EXPECT_LT(distance(ppp_flat(space.K, space.g, on_vertices), form), 1e-13);
  });
}

TYPED_TEST(SharpAndFlat, DualFlatOfConstantsIsTheStarOfTheFlux) {
  constexpr int n = TypeParam::value;
  for_each_mesh<n>([](Space<n> space) {
    if (!space.g.has_signed_volume()) return;
    orient_by_volume(space.K, space.g);
    const Vector X = constant(n);
    const auto flux = DeRhamMap<n>(space.K, space.g, 1).flux([&](auto) -> const Vector& { return X; });
    std::vector<double> volume = signed_volumes(space.K, space.g);
    for (const double turn : {1.0, -1.0}) {  // the dual edges turn with K, the flux through facets does not
      for (double& x : volume) x *= turn;
      space.K.orient_by(volume);
      const auto flat = dpd_flat(space.K, space.g, repeated(X, space.K.size(n)));
      const double sign = n % 2 == 0 ? -turn : turn;
      EXPECT_LT(distance(flat, sign * HodgeStar<n>(space.K, space.g)(flux)), 1e-10) << turn;
    }
  });
}

TYPED_TEST(SharpAndFlat, WorkWithoutCoordinates) {
  constexpr int n = TypeParam::value;
  const Space<n> flat(test::generic_mesh<n>(1));
  const Space<n> intrinsic(test::generic_mesh<n>(1), squared_lengths(flat.K, flat.g));
  const Vector X = constant(n);
  const auto form = DeRhamMap<n>(flat.K, flat.g, 1).circulation([&](auto) -> const Vector& { return X; });
  const PrimalForm<n, 1> same(intrinsic.K, {form.values().begin(), form.values().end()});
  for (const Vector& sharp : {whitney_sharp(intrinsic.g, same), pd_sharp(intrinsic.g, same)}) {
    EXPECT_LT(distance(dpp_flat(intrinsic.K, intrinsic.g, sharp), same), 1e-8);
    const auto dual = dpd_flat(intrinsic.K, intrinsic.g, sharp);
    const auto expected = dpd_flat(flat.K, flat.g, repeated(X, flat.K.size(n)));
    for (Index i = 0; i < dual.size(); ++i) EXPECT_NEAR(dual[i], expected[i], 1e-8);
  }
  EXPECT_THROW((void)pp_sharp(intrinsic.g, same), GeometryError);
  EXPECT_THROW((void)ppp_flat(intrinsic.K, intrinsic.g, repeated(X, intrinsic.K.size(0))), GeometryError);
}

/// x_0 dx_1 - x_1 dx_0 is a Whitney form, so that its sharps are exact at the points they belong to.
TYPED_TEST(SharpAndFlat, OfRotationsAreExactAtTheirPoints) {
  constexpr int n = TypeParam::value;
  if constexpr (n >= 2) {
    const Space<n> space(test::generic_mesh<n>(4));
    const auto form = DeRhamMap<n>(space.K, space.g, 2).circulation([](auto x) {
      Vector X(n);
      X[0] = -x[1];
      X[1] = x[0];
      return X;
    });
    const Vector mean = whitney_sharp(space.g, form), dual = pd_sharp(space.g, form);
    const DualCells<n> cells(space.K, space.g, n);
    for (Index t = 0; t < space.K.size(n); ++t) {
      const auto corners = space.g.corners(space.K, t);
      const Vector center = cells.flags(t).at(0).points;
      const auto* const X = mean.data() + t * n;
      const auto* const Y = dual.data() + t * n;
      double x = 0, y = 0, size = 1;
      for (const double* corner : corners) {
        x += corner[0] / (n + 1);
        y += corner[1] / (n + 1);
      }
      for (const double c : center) size += std::abs(c);
      EXPECT_NEAR(X[0], -y, 1e-10);
      EXPECT_NEAR(X[1], x, 1e-10);
      EXPECT_NEAR(Y[0], -center[1], 1e-9 * size);
      EXPECT_NEAR(Y[1], center[0], 1e-9 * size);
    }
  }
}

/// The shares are sums over the pieces of explicit dual cells.
TYPED_TEST(SharpAndFlat, WeighWithThePiecesOfDualCells) {
  constexpr int n = TypeParam::value;
  const Space<n> space(test::generic_mesh<n>(2, 2));
  detail::DualShares<n> shares(space.g);
  for_each_degree<n>([&]<int k>() {
    const DualCells<n> cells(space.K, space.g, k);
    for (Index t = 0; t < space.K.size(n); t += 3) {
      shares.set(space.K, t);
      const auto index = face_indices(space.K, t);
      for (unsigned mask = 1; mask <= full_mask<n>; ++mask) {
        if (mask_degree(mask) != k) continue;
        double expected = 0;
        for (const DualFlag& flag : cells.flags(index[mask]))
          if (flag.top == t) expected += flag.signed_volume;
        EXPECT_NEAR(shares[mask], expected, 1e-9 * (1 + std::abs(expected)));
      }
    }
  });
}

/// The mean over the top simplices around a vertex, by hand.
TEST(PPSharp, IsTheWeightedMeanOfConstantForms) {
  const Space<2> space(test::generic_mesh<2>(3));
  const auto w = support::random_form<2, 1>(space.K, 5);
  const Vector sharp = pp_sharp(space.g, w);
  Vector sum(sharp.size()), weight(sharp.size() / 2);
  detail::DualShares<2> shares(space.g);
  SimplexFrame<2> frame(2);
  for (Index t = 0; t < space.K.size(2); ++t) {
    shares.set(space.K, t);
    frame.set(space.g.corners(space.K, t));
    const auto tuple = space.K.simplex(2, t);
    for (std::size_t v = 0; v < 3; ++v) {
      const auto vertex = static_cast<std::size_t>(tuple[v]);
      weight[vertex] += shares[1U << v];
      for (std::size_t u = 0; u < 3; ++u)
        if (u != v)
          for (std::size_t c = 0; c < 2; ++c)
            sum[vertex * 2 + c] += shares[1U << v] * w({tuple[v], tuple[u]}) * frame.gradient(u, c);
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i)
    EXPECT_NEAR(sharp[i], sum[i] / weight[i / 2], 1e-9 * (1 + std::abs(sharp[i])));
}

TYPED_TEST(SharpAndFlat, PPPFlatIsExactOnLinearFieldsAndOfSecondOrder) {
  constexpr int n = TypeParam::value;
  const auto error = [](Index cells, auto&& field, int order) {
    const Space<n> space(meshes::box(n, cells));
    const auto form = DeRhamMap<n>(space.K, space.g, order).circulation(field);
    Vector vectors;
    for (Index v = 0; v < space.K.size(0); ++v) {
      const Vector X = field(space.g.points().subspan(static_cast<std::size_t>(v) * n, n));
      vectors.insert(vectors.end(), X.begin(), X.end());
    }
    return distance(ppp_flat(space.K, space.g, vectors), form) * static_cast<double>(cells);
  };
  const auto linear = [](std::span<const double> x) {
    Vector X(n, 1);
    for (std::size_t i = 0; i < n; ++i) X[(i + 1) % n] += 2 * x[i];
    return X;
  };
  EXPECT_LT(error(2, linear, 1), 1e-13);
  const auto wave = [](std::span<const double> x) {
    Vector X(n);
    for (std::size_t i = 0; i < n; ++i) X[i] = std::sin(2 * x[i] + x[0]);
    return X;
  };
  const double coarse = error(4, wave, 9), fine = error(8, wave, 9);
  EXPECT_GT(coarse / fine, 3.6);
}

TYPED_TEST(SharpAndFlat, HaveTheSameBitsOnAnyNumberOfThreads) {
  constexpr int n = TypeParam::value;
  const Space<n> space(test::generic_mesh<n>(1, n == 1 ? 3000 : n == 2 ? 30 : n == 3 ? 8 : 3));
  const auto w = support::random_form<n, 1>(space.K, 3);
  const int before = thread_count();
  const auto all = [&](int threads) {
    set_thread_count(threads);
    const Vector X = pd_sharp(space.g, w), Y = pp_sharp(space.g, w);
    return std::tuple(X, Y, dpp_flat(space.K, space.g, X), dpd_flat(space.K, space.g, X),
                      ppp_flat(space.K, space.g, Y));
  };
  const auto one = all(1);
  EXPECT_EQ(all(2), one);
  EXPECT_EQ(all(4), one);
  set_thread_count(before);
}

TEST(SharpAndFlatErrors, WrongShapes) {
  const Space<2> space(test::generic_mesh<2>(1));
  EXPECT_THROW((void)dpp_flat(space.K, space.g, Vector(3)), InputError);
  EXPECT_THROW((void)dpd_flat(space.K, space.g, Vector(3)), InputError);
  EXPECT_THROW((void)ppp_flat(space.K, space.g, Vector(3)), InputError);
}

// Two triangles of a flat square, the second in a chart that is turned by a right angle.
TEST(SharpAndFlatErrors, VectorsOfChartsThatAreTurned) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}, {1, 2, 3}});
  const auto g = Geometry<2>::from_corners(K, {0, 0, 1, 0, 0, 1, 0, 0, 1, 1, 0, 1}, 2);
  ASSERT_FALSE(g.has_common_frame());
  EXPECT_THROW((void)pp_sharp(g, PrimalForm<2, 1>(K)), GeometryError);
  EXPECT_THROW((void)ppp_flat(K, g, Vector(8)), GeometryError);
  EXPECT_EQ(pd_sharp(g, PrimalForm<2, 1>(K)).size(), 4U);
}

}  // namespace
}  // namespace derham
