#include "derham/core/error.hpp"
#include "derham/hodge/hodge_star.hpp"
#include "derham/meshes/boxes.hpp"
#include "geometry/mesh_kit.hpp"
#include "support/random_values.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace derham {
namespace {

template <int n>
struct Mesh {
  explicit Mesh(const MeshData& mesh) : K(mesh.simplices), g(Geometry<n>::from_mesh(K, mesh)) {}
  SimplicialComplex<n> K;
  Geometry<n> g;
};

std::vector<double> list(std::span<const double> values) { return {values.begin(), values.end()}; }

template <class T>
struct StarKinds : testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                                  std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(StarKinds, Dimensions);

TYPED_TEST(StarKinds, TheCircumcentricStarIsTheStar) {
  constexpr int n = TypeParam::value;
  const Mesh<n> mesh(meshes::box(n, 3, {.jitter = 0.5 / n}));
  const HodgeStar<n> star(mesh.K, mesh.g), same(mesh.K, mesh.g, Circumcentric{}),
      power(mesh.K, mesh.g, PowerCircumcentric{}), twice(mesh.K, mesh.g, Circumcentric{}, Material{.values = {2}});
  for (int k = 0; k <= n; ++k) {
    EXPECT_EQ(list(same.diagonal(k)), list(star.diagonal(k)));
    for (Index i = 0; i < mesh.K.size(k); ++i) {
      const double scale = 1e-12 * std::abs(star.diagonal(k)[i]) + 1e-13;
      EXPECT_NEAR(power.diagonal(k)[i], star.diagonal(k)[i], scale);
      EXPECT_NEAR(twice.diagonal(k)[i], 2 * star.diagonal(k)[i], 2 * scale);
    }
  }
  EXPECT_TRUE(std::holds_alternative<Circumcentric>(star.kind()));
  EXPECT_TRUE(std::holds_alternative<PowerCircumcentric>(power.kind()));
}

TYPED_TEST(StarKinds, TheStarTwiceIsASign) {
  constexpr int n = TypeParam::value;
  const Mesh<n> mesh(meshes::box(n, 2, {.jitter = 0.3 / n}));
  auto weights = support::random_values(mesh.K.size(0), 3);
  for (double& w : weights) w *= 1e-2;
  const HodgeStar<n> star(mesh.K, mesh.g, PowerCircumcentric{weights},
                          Material{.values = {2, 3}, .row_of = [&] {
                                     std::vector<Index> rows(static_cast<std::size_t>(mesh.K.size(n)));
                                     for (std::size_t t = 0; t < rows.size(); ++t) rows[t] = static_cast<Index>(t % 2);
                                     return rows;
                                   }()});
  constexpr int k = n - 1;
  const PrimalForm<n, k> w(mesh.K, support::random_values(mesh.K.size(k), 1));
  const auto back = star(star(w));
  for (Index i = 0; i < w.size(); ++i) EXPECT_NEAR(back[i], (k * (n - k) % 2 == 0 ? 1 : -1) * w[i], 1e-13);
  for (Index t = 0; t < mesh.K.size(n); ++t)
    EXPECT_NEAR(star.diagonal(n)[t] * std::abs(signed_volumes(mesh.K, mesh.g)[t]), t % 2 == 0 ? 2 : 3, 1e-13);
}

// Series and parallel: what the parts of a dual cell in two layers add up to.
TEST(StarKind, MaterialsJoinAsConductancesAndResistances) {
  const Mesh<2> square(meshes::box(2, 2));
  std::vector<Index> layer;
  for (Index t = 0; t < square.K.size(2); ++t) {
    double y = 0;
    for (const Index v : square.K.simplex(2, t)) y += square.g.points()[static_cast<std::size_t>(v) * 2 + 1] / 3;
    layer.push_back(y < 0.5 ? 0 : 1);
  }
  const HodgeStar<2> star(square.K, square.g, Circumcentric{}, {.values = {1, 10}, .row_of = layer});
  const std::vector<Index> edge{3, 4};  // from (0, 1/2) to (1/2, 1/2)
  EXPECT_NEAR(star.diagonal(1)[square.K.at(edge).index], (1 + 10) / 2.0, 1e-13);
  EXPECT_NEAR(star.diagonal(0)[4], 0.25 * (1 + 10) / 2.0, 1e-14);
}

TYPED_TEST(StarKinds, TheLumpedStarIsBarycentricAndOfTheEndsOnly) {
  constexpr int n = TypeParam::value;
  const Mesh<n> mesh(meshes::box(n, 3, {.jitter = 0.5 / n}));
  const Material material{.values = support::random_values(mesh.K.size(n), 2)};
  const HodgeStar<n> lumped(mesh.K, mesh.g, Lumped{}, material), barycentric(mesh.K, mesh.g, Barycentric{}, material);
  std::vector<double> shares(static_cast<std::size_t>(mesh.K.size(0)));
  const auto volume = primal_volumes(mesh.K, mesh.g)[n];
  for (Index t = 0; t < mesh.K.size(n); ++t) {
    for (const Index v : mesh.K.simplex(n, t)) shares[v] += *material.of(t) * volume[t] / (n + 1);
    EXPECT_NEAR(lumped.diagonal(n)[t] * volume[t], *material.of(t), 1e-13);
  }
  for (Index v = 0; v < mesh.K.size(0); ++v) EXPECT_NEAR(lumped.diagonal(0)[v], shares[v], 1e-14);
  for (const int k : {0, n}) EXPECT_EQ(list(lumped.diagonal(k)), list(barycentric.diagonal(k)));
  for (int k = 1; k < n; ++k) {
    EXPECT_THROW((void)lumped.diagonal(k), InputError);
    std::vector<double> x(static_cast<std::size_t>(mesh.K.size(k)));
    EXPECT_THROW(lumped.apply(k, x, x), InputError);
    EXPECT_THROW(lumped.apply_inverse(k, x, x), InputError);
    EXPECT_EQ(barycentric.diagonal(k).size(), x.size());
  }
}

TEST(StarKind, NameTheSimplicesThatHaveNoInverse) {
  const Mesh<2> kuhn(meshes::box(2, 2));
  const auto message = [](const HodgeStar<2>& star, int k) {
    try {
      (void)star.inverse_diagonal(k);
    } catch (const GeometryError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message(HodgeStar<2>(kuhn.K, kuhn.g, PowerCircumcentric{}), 1).find("1-simplex"), std::string::npos);
  std::vector<double> numbers(8, 1.0);
  numbers[5] = 0;
  const HodgeStar<2> hole(kuhn.K, kuhn.g, Barycentric{}, {.values = numbers});
  EXPECT_NE(message(hole, 2).find("2-simplex 5"), std::string::npos) << message(hole, 2);
  EXPECT_EQ(message(HodgeStar<2>(kuhn.K, kuhn.g, Barycentric{}), 1), "");
}

TEST(StarKind, RefuseWhatDoesNotFit) {
  const Mesh<2> mesh(meshes::box(2, 2));
  EXPECT_THROW(HodgeStar<2>(mesh.K, mesh.g, PowerCircumcentric{{1, 2, 3}}), InputError);
  const std::vector<double> huge{0, 0, 0, 0, 1e200, 0, 0, 0, 0};
  EXPECT_THROW(HodgeStar<2>(mesh.K, mesh.g, PowerCircumcentric{huge}), GeometryError);
  EXPECT_THROW(HodgeStar<2>(mesh.K, mesh.g, Lumped{}, Material{.values = {1, 0, 0, 1}, .width = 2}), InputError);
  EXPECT_THROW(HodgeStar<2>(mesh.K, mesh.g, Circumcentric{}, Material{.values = {1, 2}}), InputError);
  const SimplicialComplex<2> flat(SimplexList{{0, 1, 2}});
  const auto line = Geometry<2>::from_points(flat, {0, 0, 1, 0, 2, 0}, 2);
  for (const StarKind& kind : {StarKind(PowerCircumcentric{}), StarKind(Barycentric{}), StarKind(Lumped{})})
    EXPECT_THROW(HodgeStar<2>(flat, line, kind), GeometryError);
  const SimplicialComplex<2> band(SimplexList{{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 0}, {4, 0, 1}});
  const std::vector<double> squares(10, 1.0);
  EXPECT_THROW(HodgeStar<2>(band, Geometry<2>::from_squared_lengths(band, squares), Lumped{}), TopologyError);
}

}  // namespace
}  // namespace derham
