#include "derham/geometry/circumcenter.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/geometry/naming.hpp"
#include "derham/geometry/simplex_metric.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace derham {

namespace {

template <int k>
std::optional<Circumcenter> solve(std::span<const double> points, int m) {
  const auto d = static_cast<std::size_t>(m);
  Circumcenter result{std::vector<double>(k + 1, 1.0), std::vector<double>(points.begin(), points.begin() + m), 0};
  if constexpr (k > 0) {
    std::vector<double> edges(points.begin() + m, points.end());
    for (std::size_t i = 0; i < k; ++i)
      for (std::size_t c = 0; c < d; ++c) edges[i * d + c] -= points[c];
    TriangularMatrix<k> r;
    triangularize<k>(edges.data(), m, r);
    double longest = 0;
    for (const auto& row : r) {
      double square = 0;
      for (const double x : row) square += x * x;
      longest = std::max(longest, std::sqrt(square));
    }
    const double flat = 1e-12 * longest;
    for (std::size_t i = 0; i < k; ++i)
      if (!(r[i][i] > flat)) return std::nullopt;
    const auto simplex = circumcentric<k>(r);
    for (const double altitude : simplex.altitude)
      if (!(altitude > flat)) return std::nullopt;
    result.barycentric.assign(simplex.lambda.begin(), simplex.lambda.end());
    for (std::size_t c = 0; c < d; ++c)
      for (std::size_t i = 1; i <= k; ++i) result.point[c] += simplex.lambda[i] * (points[i * d + c] - points[c]);
    result.radius = simplex.radius;
  }
  return result;
}

std::optional<Circumcenter> solve(std::span<const double> points, int k, int m) {
  switch (k) {
    case 0:
      return solve<0>(points, m);
    case 1:
      return solve<1>(points, m);
    case 2:
      return solve<2>(points, m);
    case 3:
      return solve<3>(points, m);
    case 4:
      return solve<4>(points, m);
    default:
      throw InputError(text("circumcentre of a ", k, "-simplex; dimensions 0 to 4 are available"));
  }
}

}  // namespace

Circumcenter circumcenter(std::span<const double> points, int k, int m) {
  if (k < 0 || m < k || points.size() != static_cast<std::size_t>(k + 1) * static_cast<std::size_t>(m))
    throw InputError(text(points.size(), " coordinates for a ", k, "-simplex in dimension ", m, "; expected ",
                          (k + 1) * m, " in at least ", k, " dimensions"));
  auto result = solve(points, k, m);
  if (!result)
    throw GeometryError(text("the ", k + 1, " points span no ", k, "-simplex, so they have no circumcentre"));
  return *std::move(result);
}

template <int n>
Circumcenter circumcenter(const SimplicialComplex<n>& K, const Geometry<n>& geometry, int k, Index i) {
  auto result = solve(geometry.simplex_corners(K, k, i), k, geometry.coordinate_dimension());
  if (!result) throw GeometryError(simplex_text(K, k, i) + " is flat, so it has no circumcentre");
  return *std::move(result);
}

template Circumcenter circumcenter<0>(const SimplicialComplex<0>&, const Geometry<0>&, int, Index);
template Circumcenter circumcenter<1>(const SimplicialComplex<1>&, const Geometry<1>&, int, Index);
template Circumcenter circumcenter<2>(const SimplicialComplex<2>&, const Geometry<2>&, int, Index);
template Circumcenter circumcenter<3>(const SimplicialComplex<3>&, const Geometry<3>&, int, Index);
template Circumcenter circumcenter<4>(const SimplicialComplex<4>&, const Geometry<4>&, int, Index);

}  // namespace derham
