#pragma once

#include "derham/core/types.hpp"
#include "derham/geometry/simplex_metric.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace derham {

/// An orthonormal frame of the n-plane of one n-simplex in R^d, with the gradients of its barycentric coordinates.
template <int n>
class SimplexFrame {
 public:
  using Gradients = std::array<std::array<double, static_cast<std::size_t>(n)>, static_cast<std::size_t>(n) + 1>;

  /// For simplices in R^d, d >= n.
  explicit SimplexFrame(int d) : axes_(static_cast<std::size_t>(n * d)), d_(static_cast<std::size_t>(d)) {}

  /// The frame of the simplex with these corners (n+1, d); it must not be flat.
  void set(const std::array<const double*, n + 1>& corners) noexcept {
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t c = 0; c < d_; ++c) axes_[i * d_ + c] = corners[i + 1][c] - corners[0][c];
    const double unit = normalize(axes_), inverse = 1 / unit;
    TriangularMatrix<n> r;
    if (d_ == n) {
      triangularize<n, n>(axes_.data(), n, r);
    } else {
      triangularize<n>(axes_.data(), static_cast<int>(d_), r);
    }
    volume_ = 1;
    gradient_[0].fill(0);
    for (std::size_t j = 0; j < n; ++j) {
      volume_ *= r[j][j] * unit / static_cast<double>(j + 1);
      for (std::size_t c = 0; c < d_; ++c) axes_[j * d_ + c] /= r[j][j];
      // Row j of the inverse of r, column i: component j of the gradient of λ_{i+1}.
      for (std::size_t i = 0; i < n; ++i) {
        double& x = gradient_[i + 1][j];
        x = i == j ? inverse : 0;
        for (std::size_t l = i; l < j; ++l) x -= r[j][l] * gradient_[i + 1][l];
        x = i > j ? 0 : x / r[j][j];
        gradient_[0][j] -= x;
      }
    }
  }

  /// Units    length^n
  [[nodiscard]] double volume() const noexcept { return volume_; }

  /// Of λ_v in the frame, shape (n+1, n). Units 1/length.
  [[nodiscard]] const Gradients& gradients() const noexcept { return gradient_; }

  /// The vectors of the frame, shape (n, d) row-major.
  [[nodiscard]] const std::vector<double>& axes() const noexcept { return axes_; }

  /// Component c in R^d of the gradient of λ_v.
  [[nodiscard]] double gradient(std::size_t v, std::size_t c) const noexcept {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j) sum += gradient_[v][j] * axes_[j * d_ + c];
    return sum;
  }

 private:
  std::vector<double> axes_;
  std::size_t d_;
  Gradients gradient_{};
  double volume_ = 1;
};

}  // namespace derham
