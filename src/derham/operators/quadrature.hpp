#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace derham {

/// A rule for the mean of a function over a k-simplex: Σ weights[q] f(points[q]), points in barycentric coordinates.
template <int k>
struct SimplexRule {
  using Point = std::array<double, static_cast<std::size_t>(k) + 1>;
  std::vector<Point> points;    ///< all inside the simplex
  std::vector<double> weights;  ///< positive, with sum 1
};

/// The conical product of Gauss–Jacobi rules: the simplex is a cube blown down to a corner, and the powers of the distance
/// from the corner are the weights of the rules along the axes. Computed, not tabulated, for any order.
///
/// Exact on polynomials of degree <= order, to round-off. k = 0 to 4.
/// Shape    (order/2 + 1)^k points
/// Throws   InputError if order < 0; LimitError if there are more than 10^7 points
/// Source   Stroud, "Approximate calculation of multiple integrals", 1971, §2.4
template <int k>
[[nodiscard]] SimplexRule<k> simplex_rule(int order);

/// Gauss's rule on [0, 1] for the weight (a+1)(1-x)^a.
struct GaussRule {
  std::vector<double> nodes;    ///< increasing, inside (0, 1)
  std::vector<double> weights;  ///< positive, with sum 1
};

/// Nodes are eigenvalues of the matrix of the recurrence of Jacobi polynomials, weights reciprocal sums of squares of the
/// orthonormal polynomials there. Exact up to degree 2 count - 1.
/// Throws   InputError unless count >= 1 and a >= 0
/// Source   Golub & Welsch, "Calculation of Gauss quadrature rules", 1969
[[nodiscard]] GaussRule gauss_jacobi(int count, int a);

}  // namespace derham
