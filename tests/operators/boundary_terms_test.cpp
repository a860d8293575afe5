#include "derham/operators/boundary_terms.hpp"

#include "derham/complex/incidence.hpp"
#include "derham/geometry/circumcenter.hpp"
#include "derham/hodge/eigen.hpp"
#include "derham/operators/whitney_mass.hpp"
#include "operators/sided_box.hpp"
#include "support/random_forms.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace derham {
namespace {

using support::random_form;
using test::for_each_degree;
using test::KoszulForm;
using test::SidedBox;
using test::Space;

template <class T>
struct BoundaryTerms : testing::Test {};
TYPED_TEST_SUITE(BoundaryTerms, test::Dimensions);

/// A box with shuffled numbers whose sides stay plane.
template <int n>
MeshData plane_sided(Index cells = n < 4 ? 3 : 2) {
  return test::random_mesh<n>(1, cells);
}

struct Product {
  double sum = 0, scale = 0;
  void add(double x) {
    sum += x;
    scale += std::abs(x);
  }
};

template <int n, int k>
Product product(const PrimalForm<n, k>& a, const DualForm<n, n - k>& b) {
  Product result;
  for (Index i = 0; i < a.size(); ++i) result.add(a[i] * b[i]);
  return result;
}

/// ⟨da, w⟩ - ⟨a, δw⟩ = ∫ tr(a ∧ ⋆w).
TYPED_TEST(BoundaryTerms, IntegrateByParts) {
  constexpr int n = TypeParam::value;
  test::for_each_space_of<n>(test::generic_mesh<n>(1), [](const Space<n>& space) {
    const HodgeStar<n> star(space.K, space.g);
    const auto B = boundary_complex(space.K);
    for_each_degree<n - 1>([&]<int k>() {
      const auto a = random_form<n, k>(space.K, 1);
      const auto w = random_form<n, k + 1>(space.K, 2);
      const auto data = random_form<n - 1, n - 1 - k, Side::dual>(B.complex, 3);
      const Product left = product<n, k + 1>(d(a), star(w)),
                    right = product<n, k>(a, star(codifferential(star, w, B, data))),
                    boundary = product<n - 1, k>(trace(B, a), data);
      EXPECT_NEAR(left.sum - right.sum, boundary.sum, 1e-13 * (left.scale + right.scale + boundary.scale))
          << "degree " << k;
    });
  });
}

/// The boundary data of ⋆ of the constant form du, on every side with its own normal.
template <int n, int k, class Star>
DualForm<n, n - k> side_loads(const SidedBox<n>& box, const KoszulForm<n, k>& u, Star&& star) {
  DualForm<n, n - k> result(box.K);
  for (const auto& side : box.sides)
    result += boundary_load(box.K, box.B, star(boundary_material(box.B, {{side.facets, 1}})),
                            u.normal_derivative(box, side.normal));
  return result;
}

/// δ of a constant form is 0: what leaves a dual cell inside of K leaves it on ∂K. This fixes the sign of every degree.
TYPED_TEST(BoundaryTerms, CloseTheCellsForConstantForms) {
  constexpr int n = TypeParam::value;
  const SidedBox<n> box(plane_sided<n>());
  for_each_degree<n - 1>([&]<int k>() {
    const KoszulForm<n, k> u;
    const auto du = d(u.on(box.K, box.g));
    const auto diagonal = side_loads<n, k>(box, u, [&](const Material& part) {
      return HodgeStar<n - 1>(box.B.complex, box.metric, Circumcentric{}, part);
    });
    const auto whitney = side_loads<n, k>(
        box, u, [&](const Material& part) { return whitney_mass(box.B.complex, box.metric, k, part); });
    const HodgeStar<n> star(box.K, box.g);
    const SparseMatrix M = whitney_mass(box.K, box.g, k + 1), D = to_eigen(coboundary_matrix(box.K, k));
    const Eigen::Map<const Eigen::VectorXd> x(du.values().data(), du.size()),
        b(whitney.values().data(), whitney.size());
    EXPECT_LT((D.transpose() * (M * x) - b).norm(), 1e-12 * b.norm()) << "Whitney, degree " << k;

    double largest = 0;
    for (const double value : diagonal.values()) largest = std::max(largest, std::abs(value));
    DualForm<n - 1, n - 1 - k> data(box.B.complex);  // `diagonal` as a form on ∂K
    for (Index i = 0; i < data.size(); ++i)
      data[i] = box.B.complex.sign(k, i) * diagonal[box.B.inclusion[k][static_cast<std::size_t>(i)]];
    EXPECT_LT(support::distance(d(star(du), box.B, data), DualForm<n, n - k>(box.K)), 1e-12 * largest)
        << "degree " << k;
  });
}

/// Pressures at circumcentres and, on the boundary, at those of the facets: the gradient of affine ones is exact on every
/// facet. The flux through a facet and the step along its dual edge: (s, ⋆s) is positive, (⋆s, s) is as the flux counts.
TYPED_TEST(BoundaryTerms, GiveTheGradientOfDualFunctionsUpToTheBoundary) {
  constexpr int n = TypeParam::value;
  Space<n> space(test::generic_mesh<n>(2));
  orient_by_volume(space.K, space.g);
  const auto B = boundary_complex(space.K);
  const auto X = support::random_values(n, 1);
  const auto pressure = [&](const std::vector<double>& x) {
    double sum = 3;
    for (std::size_t c = 0; c < n; ++c) sum += X[c] * x[c];
    return sum;
  };
  DualForm<n, 0> p(space.K);
  DualForm<n - 1, 0> on_boundary(B.complex);
  for (Index t = 0; t < p.size(); ++t) p[t] = pressure(circumcenter(space.K, space.g, n, t).point);
  for (Index f = 0; f < on_boundary.size(); ++f)
    on_boundary[f] =
        pressure(circumcenter(space.K, space.g, n - 1, B.inclusion[n - 1][static_cast<std::size_t>(f)]).point);
  // In dimension 1 the points of ∂K are positive, whichever way is out; the boundary value counts in that direction.
  if constexpr (n == 1) {
    const auto ends =
        trace(B, PrimalForm<1, 0>(space.K, std::vector<double>(space.g.points().begin(), space.g.points().end())));
    for (Index f = 0; f < on_boundary.size(); ++f)
      if (ends[f] < 0.5) on_boundary[f] *= -1;
  }
  const auto flux = DeRhamMap<n>(space.K, space.g, 0).flux([&](std::span<const double>) { return std::vector(X); });
  const auto expected = (n % 2 == 1 ? 1.0 : -1.0) * HodgeStar<n>(space.K, space.g)(flux);
  EXPECT_LT(support::distance(d(p, B, on_boundary), expected), 1e-11);
}

/// ∂K has the volumes it has in K, from positions in any space and from lengths, and from corners.
TYPED_TEST(BoundaryTerms, KeepTheMetricOfTheBoundary) {
  constexpr int n = TypeParam::value;
  MeshData mesh = test::random_mesh<n>(3, 2), cornered = mesh;
  for (const Index v : mesh.simplices.vertices())
    for (std::size_t c = 0; c < n; ++c) cornered.corners.push_back(mesh.points[static_cast<std::size_t>(v) * n + c]);
  cornered.points.clear();
  const Space<n> corners(cornered);
  ASSERT_EQ(corners.g.source(), MetricSource::corners);
  const auto expect = [](const Space<n>& space) {
    const auto B = boundary_complex(space.K);
    const auto metric = boundary_geometry(space.K, space.g, B);
    EXPECT_EQ(metric.source(), space.g.source());
    const auto whole = primal_volumes(space.K, space.g);
    const auto part = primal_volumes(B.complex, metric);
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t i = 0; i < part[k].size(); ++i)
        EXPECT_NEAR(part[k][i], whole[k][static_cast<std::size_t>(B.inclusion[k][i])], 1e-14);
  };
  expect(corners);
  test::for_each_space_of<n>(mesh, expect);
}

TYPED_TEST(BoundaryTerms, RobinIsTheMassOfTheTrace) {
  constexpr int n = TypeParam::value;
  const SidedBox<n> box(plane_sided<n>(2));
  const auto h = boundary_material(box.B, {{box.sides[0].facets, 2}, {box.sides[1].facets, 5}});
  const HodgeStar<n - 1> star(box.B.complex, box.metric, Circumcentric{}, h);
  for_each_degree<n - 1>([&]<int k>() {
    const SparseMatrix M = whitney_mass(box.B.complex, box.metric, k, h), R = robin_matrix(box.K, box.B, k, M);
    const auto a = random_form<n, k>(box.K, 1), b = random_form<n, k>(box.K, 2);
    const Eigen::Map<const Eigen::VectorXd> x(a.values().data(), a.size());
    const Eigen::VectorXd Rx = R * x, tr = trace_matrix(box.K, box.B, k) * x;
    for (Index i = 0; i < tr.size(); ++i) EXPECT_EQ(tr[i], trace(box.B, a)[i]) << "degree " << k;
    const auto load = boundary_load(box.K, box.B, M, trace(box.B, a));
    for (Index i = 0; i < a.size(); ++i) EXPECT_NEAR(Rx[i], load[i], 1e-13);
    EXPECT_LT((R - SparseMatrix(R.transpose())).norm(), 1e-15 * R.norm());

    const Eigen::VectorXd diagonal = robin_matrix(box.K, box.B, k, star) * x;
    const double energy = product<n - 1, k>(trace(box.B, b), star(trace(box.B, a))).sum;
    const Eigen::Map<const Eigen::VectorXd> y(b.values().data(), b.size());
    EXPECT_NEAR(y.dot(diagonal), energy, 1e-12 * (1 + std::abs(energy)));
    if constexpr (k == 0) {
      const Eigen::VectorXd one = Eigen::VectorXd::Ones(box.K.size(0));
      EXPECT_NEAR(one.dot(R * one), 7, 1e-13) << "2 and 5 times the area of a side";
      EXPECT_NEAR(one.dot(robin_matrix(box.K, box.B, 0, star) * one), 7, 1e-13);
    }
  });
}

TEST(BoundaryTermErrors, AreNamed) {
  const SidedBox<2> box(plane_sided<2>());
  const SparseMatrix wrong(3, 3);
  EXPECT_THROW((void)robin_matrix(box.K, box.B, 0, wrong), InputError);
  EXPECT_THROW((void)robin_matrix(box.K, box.B, 2, wrong), InputError);
  EXPECT_THROW((void)trace_matrix(box.K, box.B, -1), InputError);
  EXPECT_THROW((void)boundary_load(box.K, box.B, wrong, PrimalForm<1, 0>(box.B.complex)), InputError);
  const SimplicialComplex<2> small(SimplexList{{0, 1, 2}});
  EXPECT_THROW((void)trace_matrix(small, box.B, 0), InputError);
}

TEST(BoundaryMaterial, RefusesPartsThatOverlapOrAreInside) {
  const SidedBox<2> box(plane_sided<2>());
  const auto& left = box.sides[0].facets;
  try {
    (void)boundary_material(box.B, {{left, 1}, {box.sides[1].facets, 2}, {{left.front()}, 3}});
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("is in part 0 and in part 2"), std::string::npos) << error.what();
  }
  const FacetCofaces cofaces = facet_cofaces(box.K);
  const auto inside = static_cast<Index>(std::ranges::find(cofaces.count, 2) - cofaces.count.begin());
  EXPECT_THROW((void)boundary_material(box.B, {{{inside}, 1}}), InputError);
  EXPECT_THROW((void)boundary_material(box.B, {{{box.K.size(1)}, 1}}), InputError);
}

}  // namespace
}  // namespace derham
