// The reference itself, proven by hand on tiny data.
#include "reference/reference_complex.hpp"
#include "reference/reference_geometry.hpp"

#include <gtest/gtest.h>

namespace derham::reference {
namespace {

using Matrix = Complex::Matrix;

TEST(ReferenceComplex, OneTetrahedronByHand) {
  const Complex K(3, {{2, 0, 1, 3}});  // an even permutation
  EXPECT_EQ(K.list[1], (std::vector<Tuple>{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}));
  EXPECT_EQ(K.list[2], (std::vector<Tuple>{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}));
  EXPECT_EQ(K.list[3], (std::vector<Tuple>{{0, 1, 2, 3}}));
  // §4: the faces of +(0,1,2,3) are -(0,1,2), +(0,1,3), -(0,2,3), +(1,2,3)
  EXPECT_EQ(K.boundary(3), (Matrix{{{0, 0}, -1}, {{1, 0}, 1}, {{2, 0}, -1}, {{3, 0}, 1}}));
  EXPECT_EQ(Complex(3, {{0, 2, 1, 3}}).boundary(3), (Matrix{{{0, 0}, 1}, {{1, 0}, -1}, {{2, 0}, 1}, {{3, 0}, -1}}));
}

TEST(ReferenceComplex, TwoTrianglesByHand) {
  const Complex K(2, {{3, 1, 2}, {0, 1, 2}});  // the first input tuple is even, so (1,2,3) is positive
  EXPECT_EQ(K.list[2], (std::vector<Tuple>{{1, 2, 3}, {0, 1, 2}}));  // in the order of the input
  EXPECT_EQ(K.list[1], (std::vector<Tuple>{{0, 1}, {0, 2}, {1, 2}, {1, 3}, {2, 3}}));
  // the common edge (1,2) is +(-1)^2 in (1,2,3) and +(-1)^0 in (0,1,2): coherence makes the second negative
  EXPECT_EQ(K.top_sign, (std::vector<int>{1, -1}));
  EXPECT_EQ(K.boundary(2), (Matrix{{{2, 0}, 1}, {{3, 0}, -1}, {{4, 0}, 1}, {{0, 1}, -1}, {{1, 1}, 1}, {{2, 1}, -1}}));
  EXPECT_EQ(K.boundary(1).at({0, 0}), -1);  // the faces of an edge +(e0,e1) are -(e0), +(e1)
  EXPECT_EQ(K.boundary(1).at({1, 0}), 1);
  EXPECT_EQ(K.find({2, 1, 0}), (std::pair<Index, int>{1, 1}));
  EXPECT_EQ(K.find({3, 0}), (std::pair<Index, int>{-1, 0}));
  EXPECT_EQ(K.incident(1, 2, 2), (std::vector<Index>{0, 1}));
  EXPECT_EQ(K.incident(2, 0, 0), (std::vector<Index>{1, 2, 3}));
}

TEST(ReferenceComplex, MobiusStripHasNoOrientation) {
  EXPECT_FALSE(Complex(2, {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 0}, {4, 0, 1}}).orientable);
}

TEST(ReferenceGeometry, RegularTriangleAndTetrahedron) {
  const Geometry g2(Complex(2, {{0, 1, 2}}), {{0, 0}, {1, 0}, {0.5, sqrt(Real(0.75))}});
  EXPECT_NEAR(g2.primal[2][0].get_d(), 0.43301270189, 1e-11);
  EXPECT_NEAR(g2.dual[0][1].get_d(), 0.14433756730, 1e-11);
  EXPECT_NEAR(g2.dual[1][2].get_d(), 0.28867513459, 1e-11);

  const Real r = sqrt(Real(0.5));
  const Geometry g3(Complex(3, {{0, 1, 2, 3}}), {{0, 0, 0}, {r, r, 0}, {r, 0, r}, {0, r, r}});
  EXPECT_NEAR(g3.primal[3][0].get_d(), 0.11785113020, 1e-11);
  EXPECT_NEAR(g3.dual[0][0].get_d(), 0.02946278255, 1e-11);
  EXPECT_NEAR(g3.dual[1][5].get_d(), 0.05892556510, 1e-11);
  EXPECT_NEAR(g3.dual[2][3].get_d(), 0.20412414523, 1e-11);
}

TEST(ReferenceGeometry, ObtuseTriangleHasANegativeDualEdge) {
  // circumcentre (1, -15/8), below the long edge (0,1); the sum over vertices is the area all the same
  const Geometry g(Complex(2, {{0, 1, 2}}), {{0, 0}, {2, 0}, {1, 0.25}});
  EXPECT_NEAR(g.dual[1][0].get_d(), -1.875, 1e-15);
  EXPECT_GE(g.dual_scale[0][0], abs(g.dual[0][0]));
  const Real sum = g.dual[0][0] + g.dual[0][1] + g.dual[0][2];
  EXPECT_NEAR(sum.get_d(), 0.25, 1e-15);
}

}  // namespace
}  // namespace derham::reference
