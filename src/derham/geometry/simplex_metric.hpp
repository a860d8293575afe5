#pragma once

#include "derham/complex/local_faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace derham {

/// Divides the edges by a power of two near their largest component, so that no product of lengths leaves the range of
/// doubles, and returns it; being a power of two it changes no digit. 1 if there is no finite component but 0.
[[nodiscard]] inline double normalize(std::span<double> edges) noexcept {
  double largest = 0;
  for (const double x : edges) largest = std::max(largest, std::abs(x));
  if (!(largest > 0) || !std::isfinite(largest)) return 1;
  const int exponent = std::clamp(std::ilogb(largest), -1000, 1000);  // so that its reciprocal is finite, too
  const double reciprocal = std::ldexp(1.0, -exponent);
  for (double& x : edges) x *= reciprocal;
  return std::ldexp(1.0, exponent);
}

/// x * unit^power. A zero stays zero whatever the power.
[[nodiscard]] inline double in_units(double x, double unit, int power) noexcept {
  for (int i = 0; i < power; ++i) x *= unit;
  return x;
}

/// Lower triangular coordinates of k vectors: row i has its components along the orthonormalised vectors 0..i.
template <int k>
using TriangularMatrix = std::array<std::array<double, static_cast<std::size_t>(k)>, static_cast<std::size_t>(k)>;

/// Modified Gram–Schmidt. `edges` holds k rows of m numbers and is used up; m = 0 at compile time means `width`.
/// Coordinates have a backward error of a few ulp of the edge lengths (Björck 1967), however flat the simplex is.
template <int k, int m = 0>
inline void triangularize(double* edges, int width, TriangularMatrix<k>& r) noexcept {
  const int d = m > 0 ? m : width;
  for (int j = 0; j < k; ++j) {
    const double* q = edges + j * d;
    double square = 0;
    for (int c = 0; c < d; ++c) square += q[c] * q[c];
    const double length = std::sqrt(square), inverse = length > 0 ? 1 / length : 0;
    for (int i = 0; i < j; ++i) r[i][j] = 0;
    r[j][j] = length;
    for (int i = j + 1; i < k; ++i) {
      double* e = edges + i * d;
      double dot = 0;
      for (int c = 0; c < d; ++c) dot += q[c] * e[c];
      r[i][j] = dot * inverse;
      const double factor = r[i][j] * inverse;
      for (int c = 0; c < d; ++c) e[c] -= factor * q[c];
    }
  }
}

/// What the circumcentric dual needs from a k-simplex.
template <int k>
struct CircumcentricSimplex {
  double volume = 0, radius = 0;
  std::array<double, static_cast<std::size_t>(k) + 1> altitude{};  ///< of corner i above the facet opposite to it
  std::array<double, static_cast<std::size_t>(k) + 1> lambda{};    ///< barycentric coordinates of the circumcentre

  /// Signed distance of the circumcentre from the facet opposite to corner i, positive on the corner's side.
  [[nodiscard]] double height(int i) const noexcept {
    return lambda[static_cast<std::size_t>(i)] * altitude[static_cast<std::size_t>(i)];
  }
};

/// From triangular coordinates (corner 0 at the origin, corner i+1 at row i). Needs pivots r[i][i] > 0.
/// The circumcentre y solves r y = ½|r_i|²; the columns g_i of the inverse are the gradients of λ_i, and 1/|g_i|
/// the altitudes.
/// Source   Hirani, Kalyanaraman, VanderZee, "Delaunay Hodge star", 2013 (the signs)
template <int k>
[[nodiscard]] inline CircumcentricSimplex<k> circumcentric(const TriangularMatrix<k>& r) noexcept {
  CircumcentricSimplex<k> result;
  TriangularMatrix<k> inverse;
  std::array<double, static_cast<std::size_t>(k)> y{};
  double squared_radius = 0;
  result.volume = 1;
  for (int i = 0; i < k; ++i) {
    const double reciprocal = 1 / r[i][i];
    result.volume *= r[i][i] / (i + 1);
    double sum = 0;
    for (int j = 0; j < i; ++j) sum += r[i][j] * (r[i][j] - 2 * y[j]);
    y[i] = (r[i][i] + sum * reciprocal) / 2;
    squared_radius += y[i] * y[i];
    inverse[i][i] = reciprocal;
    for (int j = 0; j < i; ++j) {
      double s = 0;
      for (int l = j; l < i; ++l) s += r[i][l] * inverse[l][j];
      inverse[i][j] = -s * reciprocal;
    }
  }
  result.radius = std::sqrt(squared_radius);
  std::array<double, static_cast<std::size_t>(k)> g0{};
  double lambda0 = 1;
  for (int i = 0; i < k; ++i) {
    double lambda = 0, square = 0;
    for (int j = i; j < k; ++j) {
      lambda += inverse[j][i] * y[j];
      square += inverse[j][i] * inverse[j][i];
      g0[j] -= inverse[j][i];
    }
    result.lambda[i + 1] = lambda;
    result.altitude[i + 1] = 1 / std::sqrt(square);
    lambda0 -= lambda;
  }
  double square0 = 0;
  for (int j = 0; j < k; ++j) square0 += g0[j] * g0[j];
  result.lambda[0] = lambda0;
  result.altitude[0] = 1 / std::sqrt(square0);
  return result;
}

/// Metric of one top simplex and all its faces, from the coordinates of its corners: no heap, no runtime dimension. With
/// faces = false only of the simplex itself, in the entries at full_mask<n>.
template <int n, bool faces = true>
class SimplexMetric {
 public:
  FaceArray<n, double> volume;  ///< 1 for vertices; 0 or infinite where doubles end
  double unit = 1;              ///< a power of two near the longest edge: what radius, height, coordinates() count in
  FaceArray<n, double> radius;  ///< circumradius, 0 for vertices; in `unit`s
  /// height[mask][v] for v in mask, in `unit`s: signed distance of the circumcentre of the face from its facet without v.
  FaceArray<n, std::array<double, n + 1>> height;
  bool degenerate = false;  ///< then radius and height are not set

  /// `corners` (n+1, d); a simplex is degenerate when its smallest altitude is at most
  /// max(relative_flatness * longest edge, roundoff).
  /// `scratch` holds n*d numbers and is used only when d > n+1.
  SimplexMetric(const std::array<const double*, n + 1>& corners, int d, double relative_flatness, double roundoff,
                double* scratch) noexcept {
    if constexpr (n > 0) {
      if (d == n) {
        load<n>(corners);
      } else if (d == n + 1) {
        load<n + 1>(corners);
      } else {
        for (int i = 0; i < n; ++i)
          for (int c = 0; c < d; ++c) scratch[i * d + c] = corners[static_cast<std::size_t>(i) + 1][c] - corners[0][c];
        unit = normalize({scratch, static_cast<std::size_t>(n * d)});
        triangularize<n>(scratch, d, frame_);
      }
    }
    for_each_mask<n>([&]<unsigned mask>() {
      if constexpr (wanted<mask> || mask_degree(mask) == 1) measure<mask>();
    });
    if constexpr (n > 0) {
      const double threshold = std::max(relative_flatness * longest_, roundoff / unit);
      bool flat = false;
      for (int i = 0; i < n; ++i) flat = flat || !(frame_[i][i] > threshold);
      degenerate = flat || circumcentres(threshold);
      for_each_mask<n>([&]<unsigned mask>() {
        if constexpr (wanted<mask>) volume[mask] = in_units(volume[mask], unit, mask_degree(mask));
      });
    }
  }

  /// Coordinates of the corners in an orthonormal frame of the simplex's own n-plane, in `unit`s.
  [[nodiscard]] std::array<std::array<double, n>, n + 1> coordinates() const noexcept {
    std::array<std::array<double, n>, n + 1> x{};
    for (int i = 0; i < n; ++i) x[i + 1] = frame_[i];
    return x;
  }

 private:
  template <unsigned mask>
  static constexpr bool wanted = faces || mask == full_mask<n>;

  template <int m>
  void load(const std::array<const double*, n + 1>& corners) noexcept {
    std::array<double, static_cast<std::size_t>(n * m)> edges{};
    for (int i = 0; i < n; ++i)
      for (int c = 0; c < m; ++c)
        edges[static_cast<std::size_t>(i * m + c)] = corners[static_cast<std::size_t>(i) + 1][c] - corners[0][c];
    unit = normalize(edges);
    triangularize<n, m>(edges.data(), m, frame_);
  }

  // Coordinate c of local corner v.
  template <int v>
  [[nodiscard]] double coordinate(int c) const noexcept {
    if constexpr (v == 0) {
      return 0;
    } else {
      return c < v ? frame_[v - 1][c] : 0;
    }
  }

  template <int from, int to>
  [[nodiscard]] std::array<double, n> edge() const noexcept {
    std::array<double, n> e{};
    for (int c = 0; c < n; ++c) e[c] = coordinate<to>(c) - coordinate<from>(c);
    return e;
  }

  [[nodiscard]] static double dot(const std::array<double, n>& a, const std::array<double, n>& b) noexcept {
    double sum = 0;
    for (int c = 0; c < n; ++c) sum += a[c] * b[c];
    return sum;
  }

  // |a ∧ b|, twice the area: the root of the sum of squared minors does not cancel as |a|²|b|² - (a·b)² does.
  [[nodiscard]] static double wedge(const std::array<double, n>& a, const std::array<double, n>& b) noexcept {
    double sum = 0;
    for (int c = 0; c < n; ++c)
      for (int e = c + 1; e < n; ++e) {
        const double minor = a[c] * b[e] - a[e] * b[c];
        sum += minor * minor;
      }
    return std::sqrt(sum);
  }

  template <unsigned mask>
  [[nodiscard]] TriangularMatrix<mask_degree(mask)> face_frame() const noexcept {
    constexpr int k = mask_degree(mask);
    if constexpr (k == n) {
      return frame_;
    } else {
      constexpr auto v = mask_vertices<mask>();
      std::array<double, static_cast<std::size_t>(k * n)> edges{};
      unrolled<k>([&]<int i>() {
        const auto e = edge<v[0], v[i + 1]>();
        for (int c = 0; c < n; ++c) edges[static_cast<std::size_t>(i * n + c)] = e[c];
      });
      TriangularMatrix<k> r;
      triangularize<k, n>(edges.data(), n, r);
      return r;
    }
  }

  template <unsigned mask>
  void measure() noexcept {
    constexpr int k = mask_degree(mask);
    constexpr auto v = mask_vertices<mask>();
    if constexpr (k == 0) {
      volume[mask] = 1;
    } else if constexpr (k == 1) {
      const auto e = edge<v[0], v[1]>();
      volume[mask] = std::sqrt(dot(e, e));
      longest_ = std::max(longest_, volume[mask]);
    } else if constexpr (k == 2) {
      volume[mask] = wedge(edge<v[0], v[1]>(), edge<v[0], v[2]>()) / 2;
    } else {
      const auto r = face_frame<mask>();
      volume[mask] = 1;
      for (int i = 0; i < k; ++i) volume[mask] *= r[i][i] / (i + 1);
    }
  }

  // Fills radius and height; whether an altitude of the whole simplex is at most `threshold`.
  bool circumcentres(double threshold) noexcept {
    bool flat = false;
    for_each_mask<n>([&]<unsigned mask>() {
      constexpr int k = mask_degree(mask);
      constexpr auto v = mask_vertices<mask>();
      if constexpr (!wanted<mask>) {
        return;
      } else if constexpr (k == 0) {
        radius[mask] = 0;
      } else if constexpr (k == 1) {
        radius[mask] = height[mask][v[0]] = height[mask][v[1]] = volume[mask] / 2;
      } else if constexpr (k == 2) {
        // h = ½ |edge| cot(opposite angle): no equation to solve.
        constexpr unsigned a = 1U << v[0], b = 1U << v[1], c = 1U << v[2];
        const auto ab = edge<v[0], v[1]>(), ac = edge<v[0], v[2]>(), bc = edge<v[1], v[2]>();
        const double inverse = 1 / (4 * volume[mask]);
        radius[mask] = volume[a | b] * volume[a | c] * volume[b | c] * inverse;
        height[mask][v[0]] = volume[b | c] * dot(ab, ac) * inverse;
        height[mask][v[1]] = -volume[a | c] * dot(ab, bc) * inverse;
        height[mask][v[2]] = volume[a | b] * dot(ac, bc) * inverse;
        if constexpr (n == 2) flat = !(2 * volume[mask] > threshold * longest_);
      } else {
        const auto simplex = circumcentric<k>(face_frame<mask>());
        radius[mask] = simplex.radius;
        for (int i = 0; i <= k; ++i) {
          height[mask][v[static_cast<std::size_t>(i)]] = simplex.height(i);
          if constexpr (k == n) flat = flat || !(simplex.altitude[static_cast<std::size_t>(i)] > threshold);
        }
      }
    });
    return flat;
  }

  TriangularMatrix<n> frame_;
  double longest_ = 0;  // edge, in `unit`s
};

}  // namespace derham
