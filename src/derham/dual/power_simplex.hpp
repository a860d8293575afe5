#pragma once

#include "derham/geometry/simplex_metric.hpp"

#include <array>
#include <cmath>
#include <cstddef>

// Internal to dual and operators.
namespace derham::detail {

/// The power centres of a k-simplex for all weights of its corners: the point with |x - p_i|² - w_i the same for every corner
/// i. Its barycentric coordinates are linear in the weights.
template <int k>
struct PowerSimplex {
  using Row = std::array<double, static_cast<std::size_t>(k) + 1>;

  CircumcentricSimplex<k> zero{};                               ///< for weights 0
  double off_center = 0;                                        ///< |circumcentre - barycentre|²
  std::array<Row, static_cast<std::size_t>(k) + 1> products{};  ///< ⟨∇λ_i, ∇λ_j⟩

  /// From triangular coordinates (corner 0 at the origin, corner i+1 at row i).
  explicit PowerSimplex(const TriangularMatrix<k>& r) noexcept : zero(circumcentric<k>(r)) {
    std::array<std::array<double, static_cast<std::size_t>(k)>, static_cast<std::size_t>(k) + 1> gradient{};
    for (std::size_t j = 0; j < k; ++j)  // column j of the inverse of r
      for (std::size_t i = j; i < k; ++i) {
        double sum = i == j ? 1 : 0;
        for (std::size_t l = j; l < i; ++l) sum -= r[i][l] * gradient[j + 1][l];
        gradient[j + 1][i] = sum / r[i][i];
        gradient[0][i] -= gradient[j + 1][i];
      }
    for (std::size_t i = 0; i <= k; ++i)
      for (std::size_t j = 0; j <= k; ++j)
        for (std::size_t c = 0; c < k; ++c) products[i][j] += gradient[i][c] * gradient[j][c];
    for (std::size_t c = 0; c < k; ++c) {
      double offset = 0;
      for (std::size_t i = c; i < k; ++i) offset += (zero.lambda[i + 1] - 1.0 / (k + 1)) * r[i][c];
      off_center += offset * offset;
    }
  }

  /// How far the weights move the centre towards the facet opposite to corner v.
  [[nodiscard]] double shift(std::size_t v, const Row& weight) const noexcept {
    double sum = 0;
    for (std::size_t i = 1; i <= k; ++i) sum += (weight[i] - weight[0]) * products[i][v];
    return sum * zero.altitude[v] / 2;
  }
};

/// Triangular coordinates of a simplex, in `unit`s. `edges` is a place for k*d numbers.
template <int k>
[[nodiscard]] inline TriangularMatrix<k> frame_of(
    const std::array<const double*, static_cast<std::size_t>(k) + 1>& corners, int d, double unit,
    double* edges) noexcept {
  TriangularMatrix<k> r{};
  for (std::size_t i = 0; i < k; ++i)
    for (int c = 0; c < d; ++c) edges[static_cast<int>(i) * d + c] = (corners[i + 1][c] - corners[0][c]) / unit;
  triangularize<k>(edges, d, r);
  return r;
}

}  // namespace derham::detail
