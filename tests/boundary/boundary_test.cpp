#include "derham/boundary/boundary_complex.hpp"
#include "derham/boundary/chain.hpp"
#include "derham/boundary/eigen.hpp"
#include "derham/boundary/matrix.hpp"
#include "derham/boundary/matrix_free.hpp"
#include "derham/core/error.hpp"

#include <gtest/gtest.h>

namespace derham {
namespace {

/// The facets of the cross polytope: the simplicial (n-1)-sphere on 2n vertices.
SimplexList cross_polytope(int n) {
  SimplexList rows;
  for (unsigned signs = 0; signs < (1u << n); ++signs) {
    std::vector<Index> row;
    for (int i = 0; i < n; ++i) row.push_back(2 * i + static_cast<Index>(signs >> i & 1u));
    rows.push_back(row);
  }
  return rows;
}

template <int n>
void expect_matrices_of(const SimplicialComplex<n>& K) {
  for (int k = 1; k <= n; ++k) {
    const auto boundary = to_eigen<int>(boundary_matrix(K, k)), coboundary = to_eigen<int>(coboundary_matrix(K, k - 1));
    EXPECT_EQ(boundary.rows(), K.size(k - 1));
    EXPECT_EQ(boundary.cols(), K.size(k));
    EXPECT_EQ(boundary.nonZeros(), static_cast<Offset>(K.size(k)) * (k + 1));
    EXPECT_EQ((Eigen::MatrixXi(boundary) - Eigen::MatrixXi(coboundary).transpose()).cwiseAbs().sum(), 0);
    if (k >= 2) {
      const Eigen::SparseMatrix<int, Eigen::RowMajor> zero = to_eigen<int>(boundary_matrix(K, k - 1)) * boundary;
      EXPECT_EQ(Eigen::MatrixXi(zero).cwiseAbs().sum(), 0) << "n = " << n << ", k = " << k;
    }
    std::vector<double> x(static_cast<std::size_t>(K.size(k)), 0), y(static_cast<std::size_t>(K.size(k - 1)));
    for (std::size_t i = 0; i < x.size(); ++i) {  // the matrix-free product gives the matrix, column by column
      x[i] = 1;
      apply_boundary(K, k, x, y);
      for (std::size_t j = 0; j < y.size(); ++j)
        EXPECT_EQ(y[j], boundary.coeff(static_cast<Index>(j), static_cast<Index>(i)));
      x[i] = 0;
    }
  }
  EXPECT_EQ(boundary_matrix(K, 0).rows, 0);
  EXPECT_EQ(coboundary_matrix(K, n).rows, 0);
  EXPECT_THROW((void)boundary_matrix(K, n + 1), InputError);
  EXPECT_THROW((void)coboundary_matrix(K, -1), InputError);
}

TEST(BoundaryMatrix, IsTheTransposedCoboundaryAndSquaresToZero) {
  expect_matrices_of(SimplicialComplex<0>(SimplexList{{1}, {0}}));
  expect_matrices_of(SimplicialComplex<1>(cross_polytope(2)));
  expect_matrices_of(SimplicialComplex<2>(cross_polytope(3)));
  expect_matrices_of(SimplicialComplex<3>(cross_polytope(4)));
  expect_matrices_of(SimplicialComplex<4>(cross_polytope(5)));
  expect_matrices_of(SimplicialComplex<2>(SimplexList{{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}));  // not a manifold
  expect_matrices_of(SimplicialComplex<2>(SimplexList{{0, 1, 2}, {2, 3}, {4}}));           // not pure
}

TEST(BoundaryMatrix, EntriesOfTheChaptersTetrahedron) {
  const SimplicialComplex<3> K(SimplexList{{0, 1, 2, 3}});
  const auto boundary = to_eigen<int>(boundary_matrix(K, 3));
  EXPECT_EQ(boundary.coeff(K.at({0, 1, 2}).index, 0), -1);
  EXPECT_EQ(boundary.coeff(K.at({0, 1, 3}).index, 0), 1);
  EXPECT_EQ(boundary.coeff(K.at({0, 2, 3}).index, 0), -1);
  EXPECT_EQ(boundary.coeff(K.at({1, 2, 3}).index, 0), 1);
  const SimplicialComplex<3> reversed(SimplexList{{1, 0, 2, 3}});  // the representative is negative
  EXPECT_EQ(to_eigen<int>(boundary_matrix(reversed, 3)).coeff(reversed.at({0, 1, 2}).index, 0), 1);
}

TEST(BoundaryMatrix, EveryInteriorFacetOfAnOrientedManifoldCancels) {
  const SimplicialComplex<3> K(cross_polytope(4));
  const auto boundary = to_eigen<int>(boundary_matrix(K, 3));
  for (Index f = 0; f < K.size(2); ++f) EXPECT_EQ(Eigen::VectorXi(boundary.row(f).transpose()).sum(), 0);
  EXPECT_TRUE(derham::boundary(fundamental_chain(K)).is_zero());
}

TEST(Chain, CollectsTermsAndSigns) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}, {1, 2, 3}});
  Chain<2, 1> c(K);
  c.add({2, 1}, 3);
  c.add({1, 2});
  EXPECT_EQ(c({1, 2}), -2);
  EXPECT_EQ(c({2, 1}), 2);
  c.add({1, 2}, 2);
  EXPECT_TRUE(c.is_zero());
  EXPECT_THROW(c.add({0, 3}), InputError);
  EXPECT_THROW((Chain<2, 1>(K, {{99, 1}})), InputError);
  Chain<2, 2> triangle(K);
  triangle.add({0, 1, 2});
  EXPECT_EQ(boundary(triangle)({2, 0}), 1);
  EXPECT_EQ((2 * boundary(triangle) - boundary(triangle))({0, 1}), 1);
}

TEST(Chain, AddsItselfAndRefusesToOverflow) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}});
  Chain<2, 1> c(K, {{0, 3}, {2, -1}});
  const auto& same = c;
  c += same;
  EXPECT_EQ(c, (Chain<2, 1>(K, {{0, 6}, {2, -2}})));
  c -= same;
  EXPECT_TRUE(c.is_zero());
  Chain<2, 1> large(K, {{1, std::int64_t{1} << 62}});
  EXPECT_THROW((void)(large += 1 * large), LimitError);
  EXPECT_THROW((void)(large + large), LimitError);
  EXPECT_THROW((void)(4 * large), LimitError);
  EXPECT_EQ(large, (Chain<2, 1>(K, {{1, std::int64_t{1} << 62}})));
}

TEST(FundamentalChain, NeedsAnOrientation) {
  const SimplicialComplex<2> moebius(SimplexList{{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 0}, {4, 0, 1}});
  EXPECT_FALSE(moebius.is_orientable());
  EXPECT_THROW((void)fundamental_chain(moebius), TopologyError);
}

template <int n>
void expect_boundary_of(const SimplicialComplex<n>& K) {
  const auto rim = boundary_complex(K);
  const auto in_K = boundary(fundamental_chain(K));
  ASSERT_EQ(in_K.terms().size(), static_cast<std::size_t>(rim.complex.size(n - 1)));
  for (int k = 0; k < n; ++k) {
    for (Index i = 0; i < rim.complex.size(k); ++i) {
      const auto outer = K.simplex(k, rim.inclusion[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)]);
      for (std::size_t j = 0; j < outer.size(); ++j)
        EXPECT_EQ(outer[j], rim.inclusion[0][static_cast<std::size_t>(rim.complex.simplex(k, i)[j])]);
    }
  }
  std::vector<typename Chain<n, n - 1>::Term> image;
  for (Index i = 0; i < rim.complex.size(n - 1); ++i)
    image.push_back({rim.inclusion[n - 1][static_cast<std::size_t>(i)], rim.complex.sign(n - 1, i)});
  EXPECT_EQ((Chain<n, n - 1>(K, image)), in_K);
  EXPECT_EQ(boundary_complex(rim.complex).complex.size(0), 0) << "a boundary has no boundary";
}

TEST(BoundaryComplex, CarriesTheInducedOrientation) {
  expect_boundary_of(SimplicialComplex<2>(SimplexList{{0, 1, 4}, {4, 2, 1}, {2, 3, 4}, {4, 0, 3}}));
  expect_boundary_of(SimplicialComplex<3>(SimplexList{{0, 1, 2, 3}, {4, 1, 2, 3}, {4, 5, 2, 3}}));
  expect_boundary_of(SimplicialComplex<4>(SimplexList{{0, 1, 2, 3, 4}, {5, 1, 2, 3, 4}}));
  expect_boundary_of(SimplicialComplex<5>(SimplexList{{0, 1, 2, 3, 4, 5}, {6, 1, 2, 3, 4, 5}, {6, 1, 2, 3, 7, 5}}));
  expect_boundary_of(
      SimplicialComplex<6>(SimplexList{{0, 1, 2, 3, 4, 5, 6}, {7, 1, 2, 3, 4, 5, 6}, {9, 8, 10, 11, 12, 13, 14}}));
  const SimplicialComplex<1> path(SimplexList{{0, 1}, {1, 2}});
  EXPECT_EQ(boundary_complex(path).inclusion[0], (std::vector<Index>{0, 2}));
  EXPECT_THROW((void)boundary_complex(SimplicialComplex<2>(SimplexList{{0, 1, 2}, {2, 3}})), TopologyError);
}

TEST(BoundaryComplex, OfSimplicesIsASphereInDimensionsFiveAndSix) {
  const auto rim5 = boundary_complex(SimplicialComplex<5>(SimplexList{{0, 1, 2, 3, 4, 5}})).complex;
  EXPECT_EQ((std::vector<Index>{rim5.size(0), rim5.size(1), rim5.size(2), rim5.size(3), rim5.size(4)}),
            (std::vector<Index>{6, 15, 20, 15, 6}));
  const auto rim6 = boundary_complex(SimplicialComplex<6>(SimplexList{{6, 5, 4, 3, 2, 1, 0}})).complex;
  EXPECT_EQ((std::vector<Index>{rim6.size(0), rim6.size(1), rim6.size(2), rim6.size(3), rim6.size(4), rim6.size(5)}),
            (std::vector<Index>{7, 21, 35, 35, 21, 7}));
  const auto two = boundary_complex(SimplicialComplex<6>(SimplexList{{0, 1, 2, 3, 4, 5, 6}, {7, 1, 2, 3, 4, 5, 6}}));
  EXPECT_EQ(two.complex.size(5), 12);
  EXPECT_EQ(two.complex.find(std::array<Index, 6>{1, 2, 3, 4, 5, 6}).index, -1) << "the shared facet is inside";
}

/// The Möbius strip induces no orientation; its rim is one circle, oriented coherently by itself.
TEST(BoundaryComplex, OfTheMoebiusStripIsOneCoherentCircle) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 0}, {4, 0, 1}});
  const auto rim = boundary_complex(K);
  EXPECT_EQ(rim.complex.size(0), 5);
  EXPECT_EQ(rim.complex.size(1), 5);
  EXPECT_TRUE(rim.complex.is_orientable());
  EXPECT_EQ(facet_components(rim.complex).count, 1);
  const auto circle = fundamental_chain(rim.complex);
  EXPECT_EQ(circle.terms().size(), 5U);
  EXPECT_TRUE(boundary(circle).is_zero());
  for (const Index e : rim.inclusion[1]) {  // the rim joins i to i + 2
    const Index across = K.simplex(1, e)[1] - K.simplex(1, e)[0];
    EXPECT_TRUE(across == 2 || across == 3);
  }
}

}  // namespace
}  // namespace derham
