// Operators do not see the labels of vertices, the order of tuples, or isometries of space: on a mesh that was shuffled and moved they
// give the forms that were carried there.
#include "derham/forms/dual_wedge.hpp"
#include "derham/forms/exterior_derivative.hpp"
#include "derham/forms/wedge.hpp"
#include "derham/operators/de_rham_map.hpp"
#include "derham/operators/interior_product.hpp"
#include "derham/operators/laplace_de_rham.hpp"
#include "derham/operators/sharp_and_flat.hpp"
#include "derham/operators/whitney_mass.hpp"
#include "operators/spaces.hpp"
#include "support/random_forms.hpp"

#include <gtest/gtest.h>
#include <Eigen/SparseCore>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace derham {
namespace {

using support::random_form;
using test::for_each_degree;
using test::Space;

/// A mesh, and the same one shuffled, in R^m.
template <int n>
struct Pair {
  Pair(const MeshData& mesh, int m) : a(mesh), b(test::shuffled(test::moved(mesh, m, 1, 0.5, 5), 6, id)) {
    orient_by_volume(a.K, a.g);
    orient_by_volume(b.K, b.g);
  }
  explicit Pair(const MeshData& mesh) : a(mesh), b(test::shuffled(mesh, 6, id)) {
    orient_by_volume(a.K, a.g);
    orient_by_volume(b.K, b.g);
  }

  /// The form on b whose value on the image of a simplex is that of w: values on tuples, not on representatives.
  template <int k>
  [[nodiscard]] PrimalForm<n, k> carried(const PrimalForm<n, k>& w) const {
    PrimalForm<n, k> result(b.K);
    for (Index i = 0; i < w.size(); ++i) {
      std::array<Index, static_cast<std::size_t>(k) + 1> image{};
      const auto vertices = a.K.template simplex<k>(i);
      for (std::size_t v = 0; v <= k; ++v) image[v] = id[static_cast<std::size_t>(vertices[v])];
      const SignedIndex found = b.K.at(std::span<const Index>(image));
      result[found.index] = found.sign * a.K.sign(k, i) * w[i];
    }
    return result;
  }

  std::vector<Index> id;
  Space<n> a, b;
};

template <int n, int k>
double norm(const HodgeStar<n>& star, const PrimalForm<n, k>& w) {
  double sum = 0;
  for (Index i = 0; i < w.size(); ++i) sum += std::abs(star.diagonal(k)[static_cast<std::size_t>(i)]) * w[i] * w[i];
  return std::sqrt(sum);
}

template <class T>
struct Relabelling : testing::Test {};
TYPED_TEST_SUITE(Relabelling, test::Dimensions);

TYPED_TEST(Relabelling, AndIsometriesAreNotSeenByDAndStar) {
  constexpr int n = TypeParam::value;
  for (const int m : {n, n + 2}) {
    const Pair<n> pairs(test::generic_mesh<n>(1), m);
    const HodgeStar<n> before(pairs.a.K, pairs.a.g), after(pairs.b.K, pairs.b.g);
    const auto expect_same = [&]<int k>(const char* what, const PrimalForm<n, k>& x, const PrimalForm<n, k>& y) {
      EXPECT_LE(norm(after, y - pairs.carried(x)), 1e-7 * norm(after, y)) << what << ", degree " << k << ", m = " << m;
    };
    for_each_degree<n>([&]<int k>() {
      const auto w = random_form<n, k>(pairs.a.K, 1);
      const auto v = pairs.carried(w);
      EXPECT_NEAR(pair(w, before(w)), pair(v, after(v)), 1e-9 * norm(after, v) * norm(after, v)) << "⋆, degree " << k;
      if constexpr (k < n) expect_same("d", d(w), d(v));
      if constexpr (k > 0) expect_same("δ", codifferential(before, w), codifferential(after, v));
      expect_same("Δ", laplace_de_rham(before, w), laplace_de_rham(after, v));
      expect_same("⋆⋆", before(before(w)), after(after(v)));
    });
  }
}

TYPED_TEST(Relabelling, AndIsometriesAreNotSeenByWhitneyMassesAndWedges) {
  constexpr int n = TypeParam::value;
  const Pair<n> pairs(test::generic_mesh<n>(2), n + 1);
  for_each_degree<n>([&]<int k>() {
    const auto w = random_form<n, k>(pairs.a.K, 1);
    const auto energy = [](const Space<n>& space, const PrimalForm<n, k>& x) {
      const Eigen::Map<const Eigen::VectorXd> values(x.values().data(), x.size());
      return values.dot(whitney_mass(space.K, space.g, k) * values);
    };
    const double expected = energy(pairs.a, w);
    EXPECT_NEAR(energy(pairs.b, pairs.carried(w)), expected, 1e-9 * expected) << "degree " << k;
    for_each_degree<n - k>([&]<int q>() {
      const auto u = random_form<n, q>(pairs.a.K, 2);
      EXPECT_LT(support::distance(wedge(pairs.carried(w), pairs.carried(u)), pairs.carried(wedge(w, u))), 1e-13);
    });
  });
}

/// Fields belong to space, so only labels change. They are linear, or constant where X decides which side is upwind: nodes of quadrature
/// are in the order of the vertices.
TYPED_TEST(Relabelling, IsNotSeenByFields) {
  constexpr int n = TypeParam::value;
  using Point = std::span<const double>;
  const Pair<n> pairs(test::generic_mesh<n>(3));
  const auto field = [](double slope) {
    return [slope](Point x) {
      std::vector<double> value(x.size());
      for (std::size_t c = 0; c < x.size(); ++c) value[c] = 1 - 0.3 * static_cast<double>(c) + slope * x[(c + 1) % n];
      return value;
    };
  };
  const auto X = field(1);
  const DeRhamMap<n> before(pairs.a.K, pairs.a.g, 3), after(pairs.b.K, pairs.b.g, 3);
  EXPECT_LT(support::distance(after.circulation(X), pairs.carried(before.circulation(X))), 1e-14);
  EXPECT_LT(support::distance(after.flux(X), pairs.carried(before.flux(X))), 1e-14);
  EXPECT_LT(support::distance(after.density([](Point x) { return x[0]; }),
                              pairs.carried(before.density([](Point x) { return x[0]; }))),
            1e-14);

  const auto w = random_form<n, 1>(pairs.a.K, 1);
  const auto sharp = whitney_sharp(pairs.a.g, w), same = whitney_sharp(pairs.b.g, pairs.carried(w));
  ASSERT_EQ(sharp.size(), same.size());  // top simplices are in the order of the rows
  for (std::size_t i = 0; i < sharp.size(); ++i) EXPECT_NEAR(sharp[i], same[i], 1e-9 * (1 + std::abs(sharp[i])));
  EXPECT_LT(
      support::distance(dpp_flat(pairs.b.K, pairs.b.g, same), pairs.carried(dpp_flat(pairs.a.K, pairs.a.g, sharp))),
      1e-7);

  for (const Trace trace : {Trace::mean, Trace::upwind}) {
    const auto Y = field(trace == Trace::mean ? 1 : 0);
    const InteriorProduct i_a(pairs.a.K, pairs.a.g, Y, trace, 2), i_b(pairs.b.K, pairs.b.g, Y, trace, 2);
    for_each_degree<n>([&]<int k>() {
      const auto u = random_form<n, k>(pairs.a.K, 2);
      const auto L = pairs.carried(lie_derivative(i_a, u));
      EXPECT_LT(support::distance(lie_derivative(i_b, pairs.carried(u)), L), 1e-9) << "degree " << k;
    });
  }
}

}  // namespace
}  // namespace derham
