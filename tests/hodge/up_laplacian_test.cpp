#include "derham/hodge/up_laplacian.hpp"

#include "derham/boundary/matrix_free.hpp"
#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/hodge/eigen.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/lattices.hpp"
#include "reference/reference_complex.hpp"
#include "support/random_rows.hpp"
#include "support/random_values.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace derham {
namespace {

using support::random_integers;
using support::random_values;
using Values = std::vector<double>;

/// d_kᵀ W d_k x by its three factors, one after the other: the specification, bit for bit.
template <int n>
Values three_steps(const SimplicialComplex<n>& K, int k, const Values& weights, const Values& x) {
  Values flux(weights.size()), y(x.size());
  apply_coboundary(K, k, x, flux);
  for (std::size_t i = 0; i < flux.size(); ++i) flux[i] *= weights[i];
  apply_boundary(K, k + 1, flux, y);
  return y;
}

template <int n>
Values up_laplacian(const SimplicialComplex<n>& K, int k, const Values& weights, const Values& x, Index columns = 1) {
  Values y(x.size(), -1);
  UpLaplacian<n>(K, k, weights).apply(x, y, columns);
  return y;
}

double dot(const Values& x, const Values& y) { return std::inner_product(x.begin(), x.end(), y.begin(), 0.0); }

template <int n>
void expect_laws_of(const SimplicialComplex<n>& K) {
  for (int k = 0; k < n; ++k) {
    SCOPED_TRACE("n = " + std::to_string(n) + ", k = " + std::to_string(k));
    const Values weights = random_values(K.size(k + 1), 1), x = random_values(K.size(k), 2);
    EXPECT_EQ(up_laplacian(K, k, weights, x), three_steps(K, k, weights, x));

    const Values W = random_integers(K.size(k + 1), 3);  // sums are exact
    const Values a = random_integers(K.size(k), 4), b = random_integers(K.size(k), 5);
    EXPECT_EQ(dot(up_laplacian(K, k, W, a), b), dot(a, up_laplacian(K, k, W, b))) << "symmetric";
    if (k >= 1) {
      const Values u = random_integers(K.size(k - 1), 6);
      Values du(a.size());
      apply_coboundary(K, k - 1, u, du);
      EXPECT_EQ(up_laplacian(K, k, W, du), Values(a.size())) << "d_{k-1} in its kernel";
    }
  }
}

TEST(UpLaplacian, IsTheProductOfItsFactorsOnRandomComplexes) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE(seed);
    support::Random random(seed);
    const auto of = [](const support::Rows& rows) { return support::simplex_list(rows); };
    expect_laws_of(SimplicialComplex<1>(of(support::random_pure(1, random))));
    expect_laws_of(SimplicialComplex<2>(of(support::random_pure(2, random))));
    expect_laws_of(SimplicialComplex<3>(of(support::random_pure(3, random))));
    expect_laws_of(SimplicialComplex<4>(of(support::random_pure(4, random))));
    expect_laws_of(SimplicialComplex<5>(of(support::random_pure(5, random))));
    expect_laws_of(SimplicialComplex<6>(of(support::random_pure(6, random))));
    expect_laws_of(SimplicialComplex<3>(of(support::random_mixed(3, random))));
  }
  expect_laws_of(SimplicialComplex<3>(meshes::box(3, 3).simplices));
}

TEST(UpLaplacian, OfTheStarIsTheWeakLaplacian) {
  const MeshData mesh = meshes::a_star_lattice(3, 3);
  const SimplicialComplex<3> K(mesh.simplices);
  const auto geometry = Geometry<3>::from_mesh(K, mesh);
  const HodgeStar<3> star(K, geometry);
  const Values x = random_values(K.size(0), 1);
  Values y(x.size());
  UpLaplacian<3>(star, 0).apply(x, y);
  const Eigen::VectorXd expected = weak_laplacian(star) * Eigen::Map<const Eigen::VectorXd>(x.data(), K.size(0));
  for (Index v = 0; v < K.size(0); ++v)
    EXPECT_NEAR(y[static_cast<std::size_t>(v)], expected[v], 1e-12 * expected.cwiseAbs().maxCoeff());
  EXPECT_GT(dot(x, y), 0) << "a lattice has positive dual volumes";
}

TEST(UpLaplacian, SeveralVectorsGetTheBitsOfEachAlone) {
  const SimplicialComplex<3> K(meshes::box(3, 4).simplices);
  for (const std::size_t columns : {1u, 2u, 3u, 4u, 5u, 8u, 11u})
    for (int k = 0; k < 3; ++k) {
      const Values weights = random_values(K.size(k + 1), 1);
      const auto size = static_cast<std::size_t>(K.size(k));
      const Values all = random_values(K.size(k) * static_cast<Offset>(columns), 2);
      const Values together = up_laplacian(K, k, weights, all, static_cast<Index>(columns));
      for (std::size_t c = 0; c < columns; ++c) {
        Values x(size), y(size);
        for (std::size_t i = 0; i < size; ++i) {
          x[i] = all[i * columns + c];
          y[i] = together[i * columns + c];
        }
        EXPECT_EQ(y, up_laplacian(K, k, weights, x)) << "column " << c << " of " << columns << ", k = " << k;
      }
    }
}

/// Natural and shuffled: few simplices are shared by pieces, or most.
TEST(UpLaplacian, ThreadsDoNotChangeTheBits) {
  const int before = thread_count();
  support::Random random(1);
  const SimplexList natural = meshes::box(3, 26).simplices;
  const SimplexList shuffled = support::simplex_list(support::shuffled(reference::tuples(natural), random));
  for (const SimplexList& rows : {natural, shuffled}) {
    const SimplicialComplex<3> K(rows);
    for (int k = 0; k < 3; ++k) {
      ASSERT_GE(K.size(k), 1 << 14) << "large enough for several threads";
      const Values weights = random_values(K.size(k + 1), 1), x = random_values(K.size(k), 2);
      const Values expected = three_steps(K, k, weights, x);
      for (const int threads : {1, 2, 4}) {
        set_thread_count(threads);
        const UpLaplacian<3> prepared(K, k, weights);
        for (const int at_work : {1, 4}) {
          set_thread_count(at_work);
          Values y(x.size(), -1);
          prepared.apply(x, y);
          EXPECT_EQ(y, expected) << threads << " threads, k = " << k;
        }
      }
    }
  }
  set_thread_count(before);
}

TEST(UpLaplacian, RefusesWrongDegreesAndShapes) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}});
  const Values one(1), three(3);
  Values y(3), six(6);
  EXPECT_THROW(UpLaplacian<2>(K, 2, one), InputError);
  EXPECT_THROW(UpLaplacian<2>(K, -1, three), InputError);
  EXPECT_THROW(UpLaplacian<2>(K, 1, three), InputError);
  const UpLaplacian<2> L(K, 1, one);
  EXPECT_EQ(L.degree(), 1);
  EXPECT_THROW(L.apply(one, y), InputError);
  EXPECT_THROW(L.apply(three, six), InputError);
  EXPECT_THROW(L.apply(three, y, 0), InputError);
  EXPECT_THROW(L.apply(six, y, 2), InputError);
  EXPECT_NO_THROW(L.apply(three, y));
}

}  // namespace
}  // namespace derham
