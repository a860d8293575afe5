// Every sign of docs/operators/conventions.md against smooth forms, whose own operators are written here by their
// definitions: plane waves β sin(q·x) with constant β on lattices whose dual cells are all good.
#include "derham/meshes/lattices.hpp"
#include "derham/operators/de_rham_map.hpp"
#include "derham/operators/interior_product.hpp"
#include "derham/operators/laplace_de_rham.hpp"
#include "derham/operators/minors.hpp"
#include "derham/operators/sharp_and_flat.hpp"
#include "derham/operators/vector_calculus.hpp"
#include "operators/spaces.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <vector>

namespace derham {
namespace {

using test::for_each_degree;
using test::Space;
using Vector = std::vector<double>;
using Point = std::span<const double>;

/// A constant form: the coefficients of dx^i ∧ … ∧ dx^j with i < … < j, by the set {i, …, j}.
using Constant = std::map<unsigned, double>;

/// The sign that sorts the members of a followed by those of b; 0 if they share one.
int merge_sign(unsigned a, unsigned b) {
  if ((a & b) != 0) return 0;
  int inversions = 0;
  for (int j = 0; j < 8; ++j)
    if ((b >> j & 1U) != 0) inversions += std::popcount(a >> j);
  return inversions % 2 == 0 ? 1 : -1;
}

Constant wedge(const Constant& a, const Constant& b) {
  Constant result;
  for (const auto& [s, x] : a)
    for (const auto& [t, y] : b)
      if (merge_sign(s, t) != 0) result[s | t] += merge_sign(s, t) * x * y;
  return result;
}

/// dx^I ∧ ⋆dx^I is the volume form.
Constant star(const Constant& a, int n) {
  Constant result;
  const unsigned all = (1U << n) - 1;
  for (const auto& [s, x] : a) result[all & ~s] += merge_sign(s, all & ~s) * x;
  return result;
}

/// X in the first place: i_X (dx^i ∧ rest) = X^i rest for the first of the factors.
Constant contracted(const Vector& X, const Constant& a) {
  Constant result;
  for (const auto& [s, x] : a)
    for (unsigned i = 0; i < X.size(); ++i)
      if ((s >> i & 1U) != 0) result[s & ~(1U << i)] += merge_sign(1U << i, s & ~(1U << i)) * X[i] * x;
  return result;
}

Constant covector(const Vector& q) {
  Constant result;
  for (unsigned i = 0; i < q.size(); ++i) result[1U << i] = q[i];
  return result;
}

Constant scaled(double factor, Constant a) {
  for (auto& [set, x] : a) x *= factor;
  return a;
}

template <int n, int k>
Constant generic() {
  Constant result;
  double next = 1;
  for (unsigned set = 0; set < (1U << n); ++set)
    if (std::popcount(set) == k) result[set] = next = 1.7 - 0.8 * next;
  return result;
}

/// a f(x) as a discrete form.
template <int n, int k, class F>
PrimalForm<n, k> discrete(const Space<n>& space, const Constant& a, F&& f) {
  const auto columns = subsets<k>(n);
  return DeRhamMap<n>(space.K, space.g, 4).template components<k>([&](Point x) {
    Vector value;
    for (const auto& column : columns) {
      unsigned set = 0;
      for (const int c : column) set |= 1U << c;
      value.push_back(a.contains(set) ? a.at(set) * f(x) : 0);
    }
    return value;
  });
}

template <int n>
Space<n> oriented(const MeshData& mesh) {
  Space<n> space(mesh);
  orient_by_volume(space.K, space.g);
  return space;
}

/// A lattice, shuffled, with a wave that fits: A_n* is Z^n times C = 1 - (1 - 1/√(n+1)) (1…1)ᵀ(1…1)/n.
template <int n>
struct Waves {
  static constexpr Index cells = n < 4 ? 8 : 4;
  std::vector<Index> id;
  Space<n> space = oriented<n>(test::shuffled(meshes::a_star_lattice(n, cells), 3, id));
  HodgeStar<n> star{space.K, space.g};
  Vector q = Vector(n, 2 * std::numbers::pi / cells * (std::sqrt(n + 1.0) - 1) / n);
  Waves() { q[0] += 2 * std::numbers::pi / cells; }

  [[nodiscard]] double phase(Point x) const {
    double sum = 0;
    for (std::size_t c = 0; c < n; ++c) sum += q[c] * x[c];
    return sum;
  }
  template <int k>
  [[nodiscard]] PrimalForm<n, k> sine(const Constant& a) const {
    return discrete<n, k>(space, a, [this](Point x) { return std::sin(phase(x)); });
  }
  template <int k>
  [[nodiscard]] PrimalForm<n, k> cosine(const Constant& a) const {
    return discrete<n, k>(space, a, [this](Point x) { return std::cos(phase(x)); });
  }
  /// |a - b| / |b|: of a wrong sign about 2.
  template <int k>
  [[nodiscard]] double relative_error(const PrimalForm<n, k>& a, const PrimalForm<n, k>& b) const {
    const auto difference = a - b;
    return std::sqrt(pair(difference, star(difference)) / pair(b, star(b)));
  }
};

template <class T>
struct Conventions : testing::Test {};
TYPED_TEST_SUITE(Conventions, test::Dimensions);

constexpr double close = 0.4;  // the lattices are coarse; a wrong sign makes it 2

TYPED_TEST(Conventions, TheDualDerivativeIsThatOfSmoothForms) {
  constexpr int n = TypeParam::value;
  const Waves<n> waves;
  for_each_degree<n - 1>([&]<int j>() {
    constexpr int k = j + 1;
    const Constant a = generic<n, k>();
    const auto computed = waves.star.inverse(d(waves.star(waves.template sine<k>(a))));
    // ⋆γ = d ⋆ω: with ⋆⋆ = (-1)^(m(n-m)) on m-forms, γ = (-1)^(m(n-m)) ⋆(q ∧ ⋆a) cos, m = n-k+1
    constexpr int m = n - k + 1;
    const Constant expected = scaled(m * (n - m) % 2 == 0 ? 1 : -1, star(wedge(covector(waves.q), star(a, n)), n));
    EXPECT_LT(waves.relative_error(computed, waves.template cosine<k - 1>(expected)), close) << "degree " << k;
  });
}

TYPED_TEST(Conventions, TheCodifferentialIsMinusTheDivergence) {
  constexpr int n = TypeParam::value;
  const Waves<n> waves;
  for_each_degree<n - 1>([&]<int j>() {
    constexpr int k = j + 1;
    const Constant a = generic<n, k>();
    const auto expected = waves.template cosine<k - 1>(scaled(-1, contracted(waves.q, a)));
    EXPECT_LT(waves.relative_error(codifferential(waves.star, waves.template sine<k>(a)), expected), close) << k;
  });
}

TYPED_TEST(Conventions, TheLaplacianIsPositive) {
  constexpr int n = TypeParam::value;
  const Waves<n> waves;
  double square = 0;
  for (const double x : waves.q) square += x * x;
  for_each_degree<n>([&]<int k>() {
    const auto w = waves.template sine<k>(generic<n, k>());
    const double quotient = pair(w, waves.star(laplace_de_rham(waves.star, w))) / pair(w, waves.star(w));
    EXPECT_NEAR(quotient / square, 1, close) << k;
  });
}

TYPED_TEST(Conventions, TheLieDerivativeIsAlongX) {
  constexpr int n = TypeParam::value;
  const Waves<n> waves;
  Vector X(n);
  for (std::size_t i = 0; i < n; ++i) X[i] = 1 - 0.6 * static_cast<double>(i);
  double along = 0;
  for (std::size_t i = 0; i < n; ++i) along += X[i] * waves.q[i];
  const InteriorProduct i_X(
      waves.space.K, waves.space.g, [&X](Point) -> const Vector& { return X; }, Trace::mean, 2);
  for_each_degree<n>([&]<int k>() {
    const Constant a = generic<n, k>();
    const auto L = lie_derivative(i_X, waves.template sine<k>(a));
    EXPECT_LT(waves.relative_error(L, waves.template cosine<k>(scaled(along, a))), close) << k;
  });
}

/// i_X ⋆a, for every a, against the definition.
TYPED_TEST(Conventions, TheAlgebraicInteriorProductIsExactOnDualConstants) {
  constexpr int n = TypeParam::value;
  const auto space = oriented<n>(test::generic_mesh<n>(1));
  const HodgeStar<n> hodge(space.K, space.g);
  const Vector X(static_cast<std::size_t>(n), 0.5);
  const auto one = [](Point) { return 1.0; };
  const auto X_flat = discrete<n, 1>(space, covector(X), one);
  for_each_degree<n - 1>([&]<int j>() {
    constexpr int k = j + 1, m = k - 1;  // of dual k-forms
    const Constant a = generic<n, n - k>();
    const auto computed = hodge.inverse(interior_product(hodge, X_flat, hodge(discrete<n, n - k>(space, a, one))));
    const Constant expected = scaled(m * (n - m) % 2 == 0 ? 1 : -1, star(contracted(X, star(a, n)), n));
    const auto difference = computed - discrete<n, n - m>(space, expected, one);
    for (const double x : difference.values()) EXPECT_NEAR(x, 0, 1e-10) << k;
  });
}

/// The circulation of X, and the flux of X: X♭ and i_X of the volume form, which is ⋆X♭.
TYPED_TEST(Conventions, CirculationsAndFluxes) {
  constexpr int n = TypeParam::value;
  const auto space = oriented<n>(test::generic_mesh<n>(2));
  Vector X(n);
  for (std::size_t i = 0; i < n; ++i) X[i] = 1 + static_cast<double>(i);
  const DeRhamMap<n> R(space.K, space.g, 0);
  const auto one = [](Point) { return 1.0; };
  const auto field = [&X](Point) { return Vector(X); };
  const Constant volume{{(1U << n) - 1, 1.0}};
  EXPECT_EQ(star(covector(X), n), contracted(X, volume));
  const auto circulation = R.circulation(field) - discrete<n, 1>(space, covector(X), one);
  const auto flux = R.flux(field) - discrete<n, n - 1>(space, contracted(X, volume), one);
  for (const double x : circulation.values()) EXPECT_NEAR(x, 0, 1e-14);
  for (const double x : flux.values()) EXPECT_NEAR(x, 0, 1e-14);
}

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Fields b sin(q·x): grad u = q cos, curl b = q × b cos, div b = q·b cos.
TEST(VectorCalculusConventions, InSpace) {
  const Waves<3> waves;
  const DeRhamMap<3> R(waves.space.K, waves.space.g, 4);
  const auto wave = [&](const Vector& b, bool sine) {
    return [&waves, b, sine](Point x) {
      const double f = sine ? std::sin(waves.phase(x)) : std::cos(waves.phase(x));
      return Vector{b[0] * f, b[1] * f, b[2] * f};
    };
  };
  const Vector b{1, 2, -1};
  const double along = waves.q[0] * b[0] + waves.q[1] * b[1] + waves.q[2] * b[2];
  const auto sine = [&](Point x) { return std::sin(waves.phase(x)); };
  const auto divergence = [&](Point x) { return along * std::cos(waves.phase(x)); };
  constexpr double quadrature = 1e-3;
  EXPECT_LT(waves.relative_error(grad(R.function(sine)), R.circulation(wave(waves.q, false))), quadrature);
  EXPECT_LT(waves.relative_error(curl(R.circulation(wave(b, true))), R.flux(wave(cross(waves.q, b), false))),
            quadrature);
  EXPECT_LT(waves.relative_error(div(R.flux(wave(b, true))), R.density(divergence)), quadrature);
  EXPECT_LT(waves.relative_error(div(waves.star, R.circulation(wave(b, true))), R.function(divergence)), close);
  EXPECT_LT(
      waves.relative_error(curl(waves.star, R.flux(wave(b, true))), R.circulation(wave(cross(waves.q, b), false))),
      close);
  EXPECT_LT(waves.relative_error(grad(waves.star, R.density(sine)), R.flux(wave(waves.q, false))), close);
}

/// In the plane: the curl of a vector is ∂_x Y - ∂_y X, that of a scalar (∂_y u, -∂_x u): as a flux du, as a circulation δ.
TEST(VectorCalculusConventions, InThePlane) {
  const Waves<2> waves;
  const DeRhamMap<2> R(waves.space.K, waves.space.g, 4);
  const auto wave = [&](const Vector& b, bool sine) {
    return [&waves, b, sine](Point x) {
      const double f = sine ? std::sin(waves.phase(x)) : std::cos(waves.phase(x));
      return Vector{b[0] * f, b[1] * f};
    };
  };
  const Vector b{1, 2}, &q = waves.q, turned{q[1], -q[0]};
  const auto sine = [&](Point x) { return std::sin(waves.phase(x)); };
  const auto cosine = [&](double factor) {
    return [&waves, factor](Point x) { return factor * std::cos(waves.phase(x)); };
  };
  const double rotation = q[0] * b[1] - q[1] * b[0], divergence = q[0] * b[0] + q[1] * b[1];
  constexpr double quadrature = 1e-3;
  EXPECT_LT(waves.relative_error(grad(R.function(sine)), R.circulation(wave(q, false))), quadrature);
  EXPECT_LT(waves.relative_error(grad(R.function(sine)), R.flux(wave(turned, false))), quadrature);
  EXPECT_LT(waves.relative_error(curl(R.circulation(wave(b, true))), R.density(cosine(rotation))), quadrature);
  EXPECT_LT(waves.relative_error(div(R.flux(wave(b, true))), R.density(cosine(divergence))), quadrature);
  EXPECT_LT(waves.relative_error(div(waves.star, R.circulation(wave(b, true))), R.function(cosine(divergence))), close);
  EXPECT_LT(waves.relative_error(grad(waves.star, R.density(sine)), R.flux(wave(q, false))), close);
  EXPECT_LT(waves.relative_error(codifferential(waves.star, R.density(sine)), R.circulation(wave(turned, false))),
            close);
  // A flux is a circulation of the field turned by +90°: ⋆(X dx + Y dy) = X dy - Y dx.
  EXPECT_LT(waves.relative_error(R.flux(wave(b, true)), R.circulation(wave({-b[1], b[0]}, true))), 1e-13);
}

}  // namespace
}  // namespace derham
