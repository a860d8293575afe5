#include "derham/boundary/matrix_free.hpp"

#include "derham/boundary/matrix.hpp"
#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/meshes/boxes.hpp"
#include "reference/reference_complex.hpp"
#include "support/random_rows.hpp"
#include "support/random_values.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace derham {
namespace {

using support::random_integers;
using support::random_values;
using Values = std::vector<double>;

/// The product with a stored matrix, row by row: what every operator must equal bit for bit.
Values product(const SignMatrix& A, const Values& x) {
  Values y(static_cast<std::size_t>(A.rows));
  for (std::size_t i = 0; i < y.size(); ++i)
    for (auto p = static_cast<std::size_t>(A.offsets[i]); p < static_cast<std::size_t>(A.offsets[i + 1]); ++p)
      y[i] += A.values[p] * x[static_cast<std::size_t>(A.columns[p])];
  return y;
}

template <int n>
Values coboundary(const SimplicialComplex<n>& K, int k, const Values& x, Index columns = 1) {
  Values y(static_cast<std::size_t>(K.size(k + 1)) * static_cast<std::size_t>(columns), -1);
  apply_coboundary(K, k, x, y, columns);
  return y;
}

template <int n>
Values boundary(const SimplicialComplex<n>& K, int k, const Values& x, Index columns = 1) {
  Values y(static_cast<std::size_t>(K.size(k - 1)) * static_cast<std::size_t>(columns), -1);
  apply_boundary(K, k, x, y, columns);
  return y;
}

template <int n>
Values boundary(const SimplicialComplex<n>& K, const Cofaces& cofaces, const Values& x, Index columns = 1) {
  Values y(static_cast<std::size_t>(cofaces.rows()) * static_cast<std::size_t>(columns), -1);
  apply_boundary(K, cofaces, x, y, columns);
  return y;
}

/// The several vectors that are columns of one array.
Values interleaved(const std::vector<Values>& vectors) {
  Values result;
  for (std::size_t i = 0; i < vectors.front().size(); ++i)
    for (const Values& v : vectors) result.push_back(v[i]);
  return result;
}

double dot(const Values& x, const Values& y) { return std::inner_product(x.begin(), x.end(), y.begin(), 0.0); }

template <int n>
void expect_laws_of(const SimplicialComplex<n>& K) {
  for (int k = 0; k < n; ++k) {
    SCOPED_TRACE("n = " + std::to_string(n) + ", k = " + std::to_string(k));
    const Cofaces cofaces(K, k);
    const Values x = random_values(K.size(k), 1), y = random_values(K.size(k + 1), 2);
    EXPECT_EQ(coboundary(K, k, x), product(coboundary_matrix(K, k), x));
    EXPECT_EQ(boundary(K, k + 1, y), product(boundary_matrix(K, k + 1), y));
    EXPECT_EQ(boundary(K, cofaces, y), boundary(K, k + 1, y));

    const Values a = random_integers(K.size(k), 3), b = random_integers(K.size(k + 1), 4);  // sums are exact
    EXPECT_EQ(dot(coboundary(K, k, a), b), dot(a, boundary(K, k + 1, b))) << "adjoint";
    if (k + 2 <= n) {
      EXPECT_EQ(coboundary(K, k + 1, coboundary(K, k, a)), Values(static_cast<std::size_t>(K.size(k + 2)))) << "dd = 0";
    }
    if (k >= 1) {
      EXPECT_EQ(boundary(K, k, boundary(K, cofaces, b)), Values(static_cast<std::size_t>(K.size(k - 1)))) << "∂∂ = 0";
    }
  }
}

TEST(MatrixFree, AgreesWithTheMatricesAndTheLawsOnRandomComplexes) {
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
}

TEST(MatrixFree, OrientedMeshesHaveTopSimplicesOfBothSigns) {
  const SimplicialComplex<3> K(meshes::box(3, 3).simplices);
  EXPECT_GT(std::ranges::count(K.orientation().sign, -1), 0);
  EXPECT_GT(std::ranges::count(K.orientation().sign, 1), 0);
  expect_laws_of(K);
  expect_laws_of(SimplicialComplex<2>(meshes::periodic_box(2, 4).simplices));
}

TEST(MatrixFree, SeveralVectorsGetTheBitsOfEachAlone) {
  const SimplicialComplex<3> K(meshes::box(3, 4).simplices);
  for (const std::size_t columns : {1u, 2u, 3u, 4u, 5u, 8u, 11u})
    for (int k = 0; k < 3; ++k) {
      SCOPED_TRACE(std::to_string(columns) + " columns, k = " + std::to_string(k));
      const Cofaces cofaces(K, k);
      std::vector<Values> x, dx, y, boundary_y;
      for (std::size_t c = 0; c < columns; ++c) {
        x.push_back(random_values(K.size(k), c));
        dx.push_back(coboundary(K, k, x.back()));
        y.push_back(random_values(K.size(k + 1), c));
        boundary_y.push_back(boundary(K, k + 1, y.back()));
      }
      const auto r = static_cast<Index>(columns);
      EXPECT_EQ(coboundary(K, k, interleaved(x), r), interleaved(dx));
      EXPECT_EQ(boundary(K, k + 1, interleaved(y), r), interleaved(boundary_y));
      EXPECT_EQ(boundary(K, cofaces, interleaved(y), r), interleaved(boundary_y));
    }
}

TEST(MatrixFree, ThreadsDoNotChangeTheBits) {
  const int before = thread_count();
  support::Random random(1);
  const SimplicialComplex<3> K(
      support::simplex_list(support::shuffled(reference::tuples(meshes::box(3, 18).simplices), random)));
  for (int k = 0; k < 3; ++k) {
    const Values x = random_values(K.size(k), 1), y = random_values(K.size(k + 1), 2);
    const Cofaces cofaces(K, k);
    for (const int threads : {1, 2, 4}) {
      set_thread_count(threads);
      EXPECT_EQ(coboundary(K, k, x), product(coboundary_matrix(K, k), x));
      EXPECT_EQ(boundary(K, cofaces, y), product(boundary_matrix(K, k + 1), y));
      EXPECT_EQ(boundary(K, k + 1, y), product(boundary_matrix(K, k + 1), y));
    }
  }
  set_thread_count(before);
}

TEST(MatrixFree, RefusesWrongDegreesAndShapes) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}}), L(SimplexList{{0, 1, 2}, {1, 2, 3}});
  Values three(3), one(1), six(6);
  EXPECT_THROW(apply_coboundary(K, 2, one, one), InputError);
  EXPECT_THROW(apply_coboundary(K, -1, one, one), InputError);
  EXPECT_THROW(apply_coboundary(K, 1, one, one), InputError);
  EXPECT_THROW(apply_coboundary(K, 1, three, three), InputError);
  EXPECT_THROW(apply_coboundary(K, 0, six, three, 2), InputError);
  EXPECT_THROW(apply_coboundary(K, 0, three, three, 0), InputError);
  EXPECT_NO_THROW(apply_coboundary(K, 0, three, three));
  EXPECT_THROW(apply_boundary(K, 0, three, three), InputError);
  EXPECT_THROW(apply_boundary(K, 3, three, three), InputError);
  EXPECT_THROW(apply_boundary(K, 2, one, one), InputError);
  EXPECT_THROW(apply_boundary(K, Cofaces(L, 1), one, three), InputError) << "of another complex";
  EXPECT_NO_THROW(apply_boundary(K, Cofaces(K, 1), one, three));
}

}  // namespace
}  // namespace derham
