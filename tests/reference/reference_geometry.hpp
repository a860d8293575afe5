#pragma once

#include "reference/reference_complex.hpp"

#include <gmpxx.h>

#include <map>
#include <utility>
#include <vector>

/// Circumcentres and signed circumcentric dual volumes as the chapter builds them, one simplex at a time, with 320-bit
/// numbers so that slivers cost the reference nothing. Two corrections: the step from degree k+1 to k carries 1/(n-k),
/// and the height is signed.
/// Source   Elcott & Schröder, "Building your own DEC at home", §6.2.1; Hirani, Kalyanaraman, VanderZee 2013 (signs)
namespace derham::reference {

class Real : public mpf_class {
 public:
  Real(double x = 0) : mpf_class(x, 320) {}  // NOLINT: numbers convert
  template <class Expression>
  Real(const __gmp_expr<mpf_t, Expression>& x) : mpf_class(x, 320) {}  // NOLINT: so do gmpxx's expressions
};

using Point = std::vector<Real>;

inline Point difference(const Point& a, const Point& b) {
  Point result;
  for (std::size_t i = 0; i < a.size(); ++i) result.emplace_back(a[i] - b[i]);
  return result;
}

inline Real dot(const Point& a, const Point& b) {
  Real result;
  for (std::size_t i = 0; i < a.size(); ++i) result += a[i] * b[i];
  return result;
}

inline Real norm(const Point& a) { return sqrt(dot(a, a)); }

/// Gauss elimination without pivoting, for the positive definite A of a simplex that is not degenerate: x = A^-1 b, and
/// det A.
inline std::pair<Point, Real> eliminate(std::vector<Point> A, Point b) {
  Real determinant = 1;
  for (std::size_t step = 0; step < b.size(); ++step) {
    determinant *= A[step][step];
    for (std::size_t i = step + 1; i < b.size(); ++i) {
      const Real factor = A[i][step] / A[step][step];
      for (std::size_t j = step; j < b.size(); ++j) A[i][j] -= factor * A[step][j];
      b[i] -= factor * b[step];
    }
  }
  Point x(b.size());
  for (std::size_t step = b.size(); step-- > 0;) {
    x[step] = b[step];
    for (std::size_t j = step + 1; j < b.size(); ++j) x[step] -= A[step][j] * x[j];
    x[step] /= A[step][step];
  }
  return {x, determinant};
}

/// One simplex in space, from the positions of its vertices.
struct SimplexGeometry {
  Real volume = 1;     // 1 for a point
  Point circumcenter;  // in space
  Point barycentric;   // its barycentric coordinates
  Real circumradius;
  Real condition = 1;  // longest edge^k / (k! volume): how much the shape magnifies rounding

  explicit SimplexGeometry(const std::vector<Point>& p) {
    const std::size_t k = p.size() - 1;
    std::vector<Point> edges, gram(k, Point(k));
    Point half_squares;
    for (std::size_t i = 1; i <= k; ++i) edges.push_back(difference(p[i], p[0]));
    for (std::size_t i = 0; i < k; ++i) {
      for (std::size_t j = 0; j < k; ++j) gram[i][j] = dot(edges[i], edges[j]);
      half_squares.emplace_back(gram[i][i] / 2);
    }
    const auto [x, determinant] = eliminate(gram, half_squares);
    barycentric.emplace_back(1);
    for (const Real& lambda : x) barycentric[0] -= lambda;
    barycentric.insert(barycentric.end(), x.begin(), x.end());

    circumcenter.resize(p[0].size());
    for (std::size_t i = 0; i <= k; ++i)
      for (std::size_t axis = 0; axis < circumcenter.size(); ++axis) circumcenter[axis] += barycentric[i] * p[i][axis];
    circumradius = norm(difference(circumcenter, p[0]));

    Real longest_edge;
    for (const Point& a : p)
      for (const Point& b : p)
        if (const Real length = norm(difference(a, b)); length > longest_edge) longest_edge = length;
    volume = sqrt(determinant);
    for (std::size_t i = 1; i <= k; ++i) {
      condition *= longest_edge;
      volume /= static_cast<double>(i);
    }
    condition /= sqrt(determinant);
  }
};

/// Primal and signed dual volumes of every simplex of a complex with positions in any R^m, m >= n.
struct Geometry {
  std::vector<std::vector<Real>> primal, dual;  // [k][i]
  std::vector<std::vector<Real>> dual_scale;  // [k][i]: the same with circumradii for heights: what errors compare with
  Real worst_condition = 1;

  Geometry(const Complex& K, const std::vector<Point>& positions)
      : primal(K.list.size()), dual(K.list.size()), dual_scale(K.list.size()) {
    const int n = K.n;
    std::vector<std::vector<SimplexGeometry>> shape(K.list.size());
    for (int k = 0; k <= n; ++k) {
      for (const Tuple& s : K.list[k]) {
        std::vector<Point> p;
        for (const Index v : s) p.push_back(positions[static_cast<std::size_t>(v)]);
        shape[k].emplace_back(p);
        primal[k].push_back(shape[k].back().volume);
        if (shape[k].back().condition > worst_condition) worst_condition = shape[k].back().condition;
      }
      dual[k].assign(K.list[k].size(), k == n ? 1 : 0);
      dual_scale[k] = dual[k];
    }
    for (int k = n - 1; k >= 0; --k) {
      for (std::size_t c = 0; c < K.list[k + 1].size(); ++c) {
        const Tuple& coface = K.list[k + 1][c];
        for (std::size_t i = 0; i < coface.size(); ++i) {
          const auto s = static_cast<std::size_t>(K.position[k].at(without(coface, i)));
          // |C(s) - C(coface)|, positive iff C(coface) lies on the side of s where vertex i is
          const Real height = (k + 1) * primal[k + 1][c] / primal[k][s];
          const Real h = shape[k + 1][c].barycentric[i] * height;
          dual[k][s] += h * dual[k + 1][c] / (n - k);
          dual_scale[k][s] += shape[k + 1][c].circumradius * dual_scale[k + 1][c] / (n - k);
        }
      }
    }
  }
};

}  // namespace derham::reference
