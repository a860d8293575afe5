#pragma once

#include "derham/complex/local_faces.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <span>

// Internal to this room.
namespace derham::detail {

template <int n>
struct ClosestPoint {
  std::array<double, static_cast<std::size_t>(n) + 1> barycentric{};
  double square = std::numeric_limits<double>::infinity();
};

/// The point of the n-simplex with the given corners that is closest to x: the foot of the perpendicular to its plane if that
/// is inside, else the closest point of the facets that x is beyond.
template <int n>
class ClosestPointSearch {
 public:
  using Corners = std::array<const double*, static_cast<std::size_t>(n) + 1>;

  ClosestPointSearch(const Corners& corners, std::span<const double> x) : corners_(corners), x_(x) {}

  [[nodiscard]] ClosestPoint<n> operator()() const { return on_face(full_mask<n>); }

 private:
  [[nodiscard]] ClosestPoint<n> on_face(unsigned mask) const {
    ClosestPoint<n> foot = foot_on(mask), best;
    bool inside = true;
    for (std::size_t v = 0; v <= n; ++v) {
      if (!((mask >> v) & 1U) || foot.barycentric[v] >= 0) continue;
      inside = false;
      const auto other = on_face(mask & ~(1U << v));
      if (other.square < best.square) best = other;
    }
    return inside ? foot : best;
  }

  /// The foot of the perpendicular to the plane of a face: Gᵀλ = E(x - p) with G the Gram matrix of its edges E from p.
  [[nodiscard]] ClosestPoint<n> foot_on(unsigned mask) const {
    std::array<std::size_t, static_cast<std::size_t>(n) + 1> vertex{};
    std::size_t count = 0;
    for (std::size_t v = 0; v <= n; ++v)
      if ((mask >> v) & 1U) vertex[count++] = v;
    const double* const origin = corners_[vertex[0]];
    const std::size_t k = count - 1;
    std::array<std::array<double, static_cast<std::size_t>(n) + 1>, static_cast<std::size_t>(n)> a{};
    for (std::size_t i = 0; i < k; ++i) {
      const double* const p = corners_[vertex[i + 1]];
      for (std::size_t c = 0; c < x_.size(); ++c) {
        a[i][k] += (p[c] - origin[c]) * (x_[c] - origin[c]);
        for (std::size_t j = 0; j < k; ++j) a[i][j] += (p[c] - origin[c]) * (corners_[vertex[j + 1]][c] - origin[c]);
      }
    }
    eliminate(a, k);
    ClosestPoint<n> foot;
    double rest = 1;
    for (std::size_t i = 0; i < k; ++i) rest -= foot.barycentric[vertex[i + 1]] = a[i][k];
    foot.barycentric[vertex[0]] = rest;
    foot.square = 0;
    for (std::size_t c = 0; c < x_.size(); ++c) {
      double y = x_[c] - origin[c];
      for (std::size_t i = 0; i < k; ++i) y -= a[i][k] * (corners_[vertex[i + 1]][c] - origin[c]);
      foot.square += y * y;
    }
    return foot;
  }

  /// Solves the symmetric system in place, its right side in column k; an edge that depends on others is not used.
  static void eliminate(auto& a, std::size_t k) {
    for (std::size_t p = 0; p < k; ++p) {
      const double inverse = a[p][p] > 0 ? 1 / a[p][p] : 0;
      for (std::size_t j = p; j <= k; ++j) a[p][j] *= inverse;
      for (std::size_t i = 0; i < k; ++i) {
        if (i == p) continue;
        const double factor = a[i][p];
        for (std::size_t j = p; j <= k; ++j) a[i][j] -= factor * a[p][j];
      }
    }
  }

  const Corners& corners_;
  std::span<const double> x_;
};

}  // namespace derham::detail
