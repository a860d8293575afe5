#pragma once

#include "derham/geometry/pack.hpp"

#include <array>
#include <cstddef>

/// Closed formulas for edges, triangles and tetrahedra, two simplices side by side. Errors of volumes and heights are a few
/// roundings of longest edge^k, so they are small where k! volume / longest^k is not.
namespace derham::kernels {

/// Two points or vectors of R^d.
template <int d>
using Vector = std::array<Pack, static_cast<std::size_t>(d)>;

/// Two k-simplices with corners in R^d.
template <int k, int d>
using Corners = std::array<Vector<d>, static_cast<std::size_t>(k) + 1>;

/// There are formulas for these.
template <int k, int d>
inline constexpr bool available = (k == 1 && 1 <= d && d <= 3) || (k == 2 && (d == 2 || d == 3)) || (k == 3 && d == 3);

template <int k>
struct Measured {
  Pack content;  ///< k! volume, signed when d = k
  Pack longest;  ///< longest edge, squared
  Pack radius;   ///< circumradius
  /// [v]: signed distance of the circumcentre from the facet opposite to corner v, positive on the corner's side
  std::array<Pack, static_cast<std::size_t>(k) + 1> height;
};

template <int d>
[[nodiscard, gnu::always_inline]] inline Vector<d> difference(const Vector<d>& a, const Vector<d>& b) noexcept {
  Vector<d> result;
  for (std::size_t c = 0; c < d; ++c) result[c] = a[c] - b[c];
  return result;
}

template <std::size_t d>
[[nodiscard, gnu::always_inline]] inline Pack dot(const std::array<Pack, d>& a, const std::array<Pack, d>& b) noexcept {
  Pack sum = a[0] * b[0];
  for (std::size_t c = 1; c < d; ++c) sum = sum + a[c] * b[c];
  return sum;
}

[[nodiscard, gnu::always_inline]] inline Vector<3> cross(const Vector<3>& a, const Vector<3>& b) noexcept {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <int d>
[[nodiscard, gnu::always_inline]] inline Measured<1> measure(const Corners<1, d>& p) noexcept {
  const auto e = difference<d>(p[1], p[0]);
  const Pack square = dot(e, e), length = sqrt(square), half = length * 0.5;
  Pack content = length;
  if constexpr (d == 1) content = e[0];
  return {content, square, half, {half, half}};
}

/// h = ½ |edge| cot(opposite angle).
template <int d>
[[nodiscard, gnu::always_inline]] inline Measured<2> measure(const Corners<2, d>& p) noexcept {
  const auto ab = difference<d>(p[1], p[0]), ac = difference<d>(p[2], p[0]), bc = difference<d>(p[2], p[1]);
  const Pack ab2 = dot(ab, ab), ac2 = dot(ac, ac), bc2 = dot(bc, bc);
  Pack content, area;  // both times 2
  if constexpr (d == 2) {
    content = ab[0] * ac[1] - ab[1] * ac[0];
    area = abs(content);
  } else {
    const auto normal = cross(ab, ac);
    content = area = sqrt(dot(normal, normal));
  }
  const Pack c = sqrt(ab2), b = sqrt(ac2), a = sqrt(bc2), inverse = 0.5 / area;
  return {content,
          max(max(ab2, ac2), bc2),
          a * b * c * inverse,
          {a * dot(ab, ac) * inverse, -(b * dot(ab, bc) * inverse), c * dot(ac, bc) * inverse}};
}

/// The circumcentre is (|a|² b×c + |b|² c×a + |c|² a×b) / (2 a·b×c) from corner 0, with a, b, c the edges from it.
template <int d>
[[nodiscard, gnu::always_inline]] inline Measured<3> measure(const Corners<3, d>& p) noexcept {
  const auto a = difference<3>(p[1], p[0]), b = difference<3>(p[2], p[0]), c = difference<3>(p[3], p[0]);
  const auto ab = difference<3>(p[2], p[1]), ac = difference<3>(p[3], p[1]), bc = difference<3>(p[3], p[2]);
  const Pack a2 = dot(a, a), b2 = dot(b, b), c2 = dot(c, c);
  // Normals of the facets: of 0 outwards, of the others inwards, if the simplex is positive.
  const auto n0 = cross(ab, ac), n1 = cross(b, c), n2 = cross(c, a), n3 = cross(a, b);
  const Pack content = dot(a, n1), inverse = 0.5 / content;
  Vector<3> center, from1;
  for (std::size_t i = 0; i < 3; ++i) {
    center[i] = (a2 * n1[i] + b2 * n2[i] + c2 * n3[i]) * inverse;
    from1[i] = a[i] - center[i];
  }
  const Pack sign = select(content < 0, Pack(-1), Pack(1));
  const auto height = [&](const Vector<3>& x, const Vector<3>& normal) {
    return sign * dot(x, normal) / sqrt(dot(normal, normal));
  };
  return {content,
          max(max(max(a2, b2), max(c2, dot(ab, ab))), max(dot(ac, ac), dot(bc, bc))),
          sqrt(dot(center, center)),
          {height(from1, n0), height(center, n1), height(center, n2), height(center, n3)}};
}

/// The largest coordinate in magnitude.
template <std::size_t corners, std::size_t d>
[[nodiscard, gnu::always_inline]] inline Pack largest_coordinate(
    const std::array<std::array<Pack, d>, corners>& p) noexcept {
  Pack largest = 0;
  for (const auto& point : p)
    for (const Pack x : point) largest = max(largest, abs(x));
  return largest;
}

}  // namespace derham::kernels
