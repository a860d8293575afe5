#include "derham/dual/circumcentric.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/geometry/naming.hpp"
#include "derham/geometry/simplex_metric.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace derham {

namespace {

// Relative to the circumradius for a height, to its own size for a height that is not zero.
constexpr double zero_tolerance = 1e-10;

template <int n>
ByDegree<n> zeros(const SimplicialComplex<n>& K) {
  ByDegree<n> result;
  for (int k = 0; k <= n; ++k) result[k].assign(static_cast<std::size_t>(K.size(k)), 0.0);
  return result;
}

// Calls body.template operator()<coface mask, vertex>() for every coface of one dimension more inside the simplex.
template <int n, unsigned mask, class Body>
constexpr void for_each_coface(Body&& body) {
  unrolled<n + 1>([&]<int v>() {
    if constexpr (((mask >> v) & 1U) == 0) body.template operator()<mask | (1U << v), v>();
  });
}

// x * unit^power, NaN where that is out of the range of doubles.
double in_range(double x, double unit, int power) {
  const double result = in_units(x, unit, power);
  return x == 0 || std::isnormal(result) ? result : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

template <int n>
CircumcentricDual<n> circumcentric_dual(const SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  geometry.require_fits(K);
  CircumcentricDual<n> result;
  result.primal = zeros(K);
  result.dual = zeros(K);
  ByDegree<n> uncertainty = zeros(K);
  const int d = geometry.coordinate_dimension();
  std::vector<double> scratch(static_cast<std::size_t>(n * d));
  for (Index t = 0; t < K.size(n); ++t) {
    const auto corners = geometry.corners(K, t);
    const double roundoff = geometry.roundoff(corners);
    const SimplexMetric<n> metric(corners, d, geometry.relative_flatness(), roundoff, scratch.data());
    const auto index = face_indices(K, t);
    for_each_mask<n>([&]<unsigned mask>() { result.primal[mask_degree(mask)][index[mask]] = metric.volume[mask]; });
    if (metric.degenerate) {
      result.degenerate.push_back(t);
      continue;
    }
    const double rounding = roundoff / metric.unit;
    FaceArray<n, double> share, error;  // in units
    share[full_mask<n>] = 1;
    error[full_mask<n>] = 0;
    for_each_mask<n>([&]<unsigned mask>() {
      constexpr int k = mask_degree(mask);
      if constexpr (k < n) {
        double sum = 0, sum_error = 0;
        for_each_coface<n, mask>([&]<unsigned coface, int v>() {
          const double smallest = zero_tolerance * metric.radius[coface] + rounding;
          double h = metric.height[coface][v];
          if (std::abs(h) <= smallest) h = 0;
          const double h_error = zero_tolerance * std::abs(h) + rounding;
          sum += h * share[coface];
          sum_error += h_error * (std::abs(share[coface]) + error[coface]) + std::abs(h) * error[coface];
          result.well_centered = result.well_centered && h > 0;
        });
        share[mask] = sum / (n - k);
        error[mask] = sum_error / (n - k);
        result.dual[k][index[mask]] += in_range(share[mask], metric.unit, n - k);
        uncertainty[k][index[mask]] += in_units(error[mask], metric.unit, n - k);
      } else {
        result.dual[n][t] = 1;
      }
    });
  }
  for (int k = 0; k < n; ++k)
    for (std::size_t i = 0; i < result.dual[k].size(); ++i)
      if (!std::isfinite(result.dual[k][i])) {
        result.dual[k][i] = std::numeric_limits<double>::quiet_NaN();
      } else if (std::abs(result.dual[k][i]) <= uncertainty[k][i]) {
        result.dual[k][i] = 0;
      }
  for (const Index t : result.degenerate) {
    const auto index = face_indices(K, t);
    for (unsigned mask = 1; mask <= full_mask<n>; ++mask)
      result.dual[mask_degree(mask)][index[mask]] = std::numeric_limits<double>::quiet_NaN();
  }
  result.well_centered = result.well_centered && result.degenerate.empty();
  return result;
}

template <int n>
ByDegree<n> dual_volumes(const SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  auto result = circumcentric_dual(K, geometry);
  if (!result.degenerate.empty())
    throw GeometryError(text("dual volumes do not exist: ", result.degenerate.size(), " flat top simplices: ",
                             simplices_text<n>(K, n, result.degenerate), "; move their vertices or remove them"));
  for (int k = 0; k <= n; ++k)
    for (Index i = 0; i < K.size(k); ++i)
      if (std::isnan(result.dual[k][i]))
        throw GeometryError(
            text("the dual volume of ", simplex_text(K, k, i),
                 " is out of the range of doubles; scale the mesh so that edge lengths are closer to 1"));
  return std::move(result.dual);
}

namespace {

template <int n>
using Point = std::array<double, static_cast<std::size_t>(n)>;

// Volume of the simplex with these corners, by orthogonalisation.
template <int n>
double simplex_volume(const std::vector<Point<n>>& corners) {
  std::vector<Point<n>> edges;
  double volume = 1;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    Point<n> e = corners[i];
    for (std::size_t c = 0; c < n; ++c) e[c] -= corners[0][c];
    for (const auto& q : edges) {
      double dot = 0;
      for (std::size_t c = 0; c < n; ++c) dot += q[c] * e[c];
      for (std::size_t c = 0; c < n; ++c) e[c] -= dot * q[c];
    }
    double square = 0;
    for (const double x : e) square += x * x;
    const double length = std::sqrt(square);
    if (length == 0) return 0;
    for (double& x : e) x /= length;
    volume *= length / static_cast<double>(i);
    edges.push_back(e);
  }
  return volume;
}

// The barycentric cell of a face inside one top simplex is cut into flags: chains of faces, each one vertex more.
// The volume of all flags that continue `chain`, the barycentres so far, with the face `mask`.
template <int n>
double barycentric_share(const std::array<Point<n>, n + 1>& corner, unsigned mask, std::vector<Point<n>>& chain) {
  Point<n> center{};
  for (std::size_t v = 0; v <= n; ++v)
    if ((mask >> v) & 1U)
      for (std::size_t c = 0; c < n; ++c) center[c] += corner[v][c] / (mask_degree(mask) + 1);
  chain.push_back(center);
  double sum = 0;
  if (mask == full_mask<n>) {
    sum = simplex_volume<n>(chain);
  } else {
    for (int v = 0; v <= n; ++v)
      if (((mask >> v) & 1U) == 0) sum += barycentric_share<n>(corner, mask | (1U << v), chain);
  }
  chain.pop_back();
  return sum;
}

}  // namespace

template <int n>
ByDegree<n> barycentric_dual_volumes(const SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  geometry.require_fits(K);
  ByDegree<n> result = zeros(K);
  const int d = geometry.coordinate_dimension();
  std::vector<double> scratch(static_cast<std::size_t>(n * d));
  std::vector<Point<n>> chain;
  for (Index t = 0; t < K.size(n); ++t) {
    const auto corners = geometry.corners(K, t);
    const SimplexMetric<n> metric(corners, d, geometry.relative_flatness(), geometry.roundoff(corners), scratch.data());
    const auto corner = metric.coordinates();
    const auto index = face_indices(K, t);
    for (unsigned mask = 1; mask <= full_mask<n>; ++mask)
      result[mask_degree(mask)][index[mask]] +=
          in_units(barycentric_share<n>(corner, mask, chain), metric.unit, n - mask_degree(mask));
  }
  return result;
}

#define DERHAM_INSTANTIATE(n)                                                                           \
  template CircumcentricDual<n> circumcentric_dual<n>(const SimplicialComplex<n>&, const Geometry<n>&); \
  template ByDegree<n> dual_volumes<n>(const SimplicialComplex<n>&, const Geometry<n>&);                \
  template ByDegree<n> barycentric_dual_volumes<n>(const SimplicialComplex<n>&, const Geometry<n>&);
DERHAM_INSTANTIATE(0)
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
#undef DERHAM_INSTANTIATE

}  // namespace derham
