// This follows Golub & Welsch, "Calculation of Gauss quadrature rules", 1969, and Stroud, 1971, §2.4.
#include "derham/operators/quadrature.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace derham {
namespace {

/// Recurrence of the orthonormal polynomials of (1-x)^a on [-1, 1]: x p_j = b_j p_{j-1} + d_j p_j + b_{j+1} p_{j+1}.
struct Recurrence {
  Eigen::VectorXd diagonal;  // d_0 …
  Eigen::VectorXd beside;    // b_1 …
};

Recurrence jacobi_recurrence(int count, int a) {
  Recurrence result{Eigen::VectorXd(count), Eigen::VectorXd(count - 1)};
  for (int j = 0; j < count; ++j) {
    const double s = 2.0 * j + a;
    result.diagonal[j] = a == 0 ? 0 : -static_cast<double>(a) * a / (s * (s + 2));
    if (j > 0) result.beside[j - 1] = 2 * j * (j + static_cast<double>(a)) / (s * std::sqrt((s - 1) * (s + 1)));
  }
  return result;
}

/// 1 / Σ p_j(x)² with p_0 = 1: the weight of the node x when all of them sum to 1.
double christoffel_number(const Recurrence& r, double x) {
  double before = 0, p = 1, sum = 1;
  for (Eigen::Index j = 0; j + 1 < r.diagonal.size(); ++j) {
    const double next = ((x - r.diagonal[j]) * p - (j > 0 ? r.beside[j - 1] * before : 0)) / r.beside[j];
    before = p;
    p = next;
    sum += p * p;
  }
  return 1 / sum;
}

}  // namespace

GaussRule gauss_jacobi(int count, int a) {
  if (count < 1 || a < 0)
    throw InputError(text("a Gauss rule of ", count, " points for the exponent ", a, "; needs count >= 1 and a >= 0"));
  const Recurrence r = jacobi_recurrence(count, a);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(r.diagonal, r.beside, Eigen::EigenvaluesOnly);
  GaussRule rule;
  for (const double x : solver.eigenvalues()) {
    rule.nodes.push_back((1 + x) / 2);
    rule.weights.push_back(christoffel_number(r, x));
  }
  return rule;
}

template <int k>
SimplexRule<k> simplex_rule(int order) {
  constexpr double most_points = 1e7;
  if (order < 0) throw InputError(text("a quadrature rule of order ", order, "; orders are 0 and above"));
  const int count = order / 2 + 1;
  if (std::pow(count, k) > most_points)
    throw LimitError(text("a rule of order ", order, " on ", k, "-simplices has ", count, "^", k,
                          " points, more than 10^7; ask for a lower order"));
  SimplexRule<k> rule{{typename SimplexRule<k>::Point{1}}, {1}};
  // A point of a simplex of one dimension less moves towards a new corner, by a node of the rule for (1-x)^dimension.
  for (std::size_t dimension = 1; dimension <= k; ++dimension) {
    const GaussRule axis = gauss_jacobi(count, static_cast<int>(dimension) - 1);
    SimplexRule<k> cone;
    for (std::size_t q = 0; q < rule.points.size(); ++q)
      for (std::size_t i = 0; i < axis.nodes.size(); ++i) {
        auto point = rule.points[q];
        for (std::size_t v = 0; v < dimension; ++v) point[v] *= 1 - axis.nodes[i];
        point[dimension] = axis.nodes[i];
        cone.points.push_back(point);
        cone.weights.push_back(rule.weights[q] * axis.weights[i]);
      }
    rule = std::move(cone);
  }
  return rule;
}

template SimplexRule<0> simplex_rule<0>(int);
template SimplexRule<1> simplex_rule<1>(int);
template SimplexRule<2> simplex_rule<2>(int);
template SimplexRule<3> simplex_rule<3>(int);
template SimplexRule<4> simplex_rule<4>(int);

}  // namespace derham
