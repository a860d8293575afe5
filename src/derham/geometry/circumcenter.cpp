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

// No value if the points are flat by the rule of SimplexMetric.
template <int k>
std::optional<Circumcenter> solve(std::span<const double> points, int m, double relative_flatness) {
  const auto d = static_cast<std::size_t>(m);
  Circumcenter result{std::vector<double>(k + 1, 1.0), std::vector<double>(points.begin(), points.begin() + m), 0};
  if constexpr (k > 0) {
    std::vector<double> edges(points.begin() + m, points.end());
    for (std::size_t i = 0; i < k; ++i)
      for (std::size_t c = 0; c < d; ++c) edges[i * d + c] -= points[c];
    const double unit = normalize(edges);
    TriangularMatrix<k> r;
    triangularize<k>(edges.data(), m, r);
    double longest = 0;
    for (std::size_t i = 0; i < k; ++i)
      for (std::size_t j = 0; j <= i; ++j) {  // row i is the edge from point 0; the others are differences of rows
        double square = 0;
        for (std::size_t c = 0; c <= i; ++c) {
          const double x = r[i][c] - (j < i && c <= j ? r[j][c] : 0);
          square += x * x;
        }
        longest = std::max(longest, std::sqrt(square));
      }
    const double flat = std::max(relative_flatness * longest, coordinate_roundoff(points) / unit);
    for (std::size_t i = 0; i < k; ++i)
      if (!(r[i][i] > flat)) return std::nullopt;
    const auto simplex = circumcentric<k>(r);
    for (const double altitude : simplex.altitude)
      if (!(altitude > flat)) return std::nullopt;
    result.barycentric.assign(simplex.lambda.begin(), simplex.lambda.end());
    for (std::size_t c = 0; c < d; ++c)
      for (std::size_t i = 1; i <= k; ++i) result.point[c] += simplex.lambda[i] * (points[i * d + c] - points[c]);
    result.radius = simplex.radius * unit;
  }
  return result;
}

std::optional<Circumcenter> solve(std::span<const double> points, int k, int m, double relative_flatness) {
  switch (k) {
    case 0:
      return solve<0>(points, m, relative_flatness);
    case 1:
      return solve<1>(points, m, relative_flatness);
    case 2:
      return solve<2>(points, m, relative_flatness);
    case 3:
      return solve<3>(points, m, relative_flatness);
    case 4:
      return solve<4>(points, m, relative_flatness);
    default:
      throw InputError(text("circumcentre of a ", k, "-simplex; dimensions 0 to 4 are available"));
  }
}

}  // namespace

Circumcenter circumcenter(std::span<const double> points, int k, int m, double relative_flatness) {
  if (k < 0 || m < k || points.size() != static_cast<std::size_t>(k + 1) * static_cast<std::size_t>(m))
    throw InputError(text(points.size(), " coordinates for a ", k, "-simplex in dimension ", m, "; expected ",
                          (k + 1) * m, " in at least ", k, " dimensions"));
  auto result = solve(points, k, m, relative_flatness);
  if (!result)
    throw GeometryError(text("the ", k + 1, " points span no ", k, "-simplex, so they have no circumcentre"));
  return *std::move(result);
}

template <int n>
Circumcenter circumcenter(const SimplicialComplex<n>& K, const Geometry<n>& geometry, int k, Index i) {
  auto result =
      solve(geometry.simplex_corners(K, k, i), k, geometry.coordinate_dimension(), geometry.relative_flatness());
  if (!result) throw GeometryError(simplex_text(K, k, i) + " is flat, so it has no circumcentre");
  return *std::move(result);
}

template Circumcenter circumcenter<0>(const SimplicialComplex<0>&, const Geometry<0>&, int, Index);
template Circumcenter circumcenter<1>(const SimplicialComplex<1>&, const Geometry<1>&, int, Index);
template Circumcenter circumcenter<2>(const SimplicialComplex<2>&, const Geometry<2>&, int, Index);
template Circumcenter circumcenter<3>(const SimplicialComplex<3>&, const Geometry<3>&, int, Index);
template Circumcenter circumcenter<4>(const SimplicialComplex<4>&, const Geometry<4>&, int, Index);

}  // namespace derham
