#include "derham/dual/circumcentric.hpp"
#include "derham/dual/power.hpp"
#include "derham/geometry/simplex_metric.hpp"

#include <array>
#include <cmath>

namespace derham {

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
ByDegree<n> barycentric_dual_volumes(const SimplicialComplex<n>& K, const Geometry<n>& geometry,
                                     const Material& material) {
  geometry.require_fits(K);
  require_numbers(material, K, geometry);
  ByDegree<n> result;
  for (int k = 0; k <= n; ++k) result[k].assign(static_cast<std::size_t>(K.size(k)), 0.0);
  const int d = geometry.coordinate_dimension();
  std::vector<double> scratch(static_cast<std::size_t>(n * d));
  std::vector<Point<n>> chain;
  for (Index t = 0, tops = K.size(n); t < tops; ++t) {
    const auto corners = geometry.corners(K, t);
    const SimplexMetric<n> metric(corners, d, geometry.relative_flatness(), geometry.roundoff(corners), scratch.data());
    const auto corner = metric.coordinates();
    const auto index = face_indices(K, t);
    for (unsigned mask = 1; mask <= full_mask<n>; ++mask)
      result[mask_degree(mask)][index[mask]] +=
          *material.of(t) * in_units(barycentric_share<n>(corner, mask, chain), metric.unit, n - mask_degree(mask));
  }
  return result;
}

#define DERHAM_INSTANTIATE(n) \
  template ByDegree<n> barycentric_dual_volumes<n>(const SimplicialComplex<n>&, const Geometry<n>&, const Material&);
DERHAM_INSTANTIATE(0)
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
#undef DERHAM_INSTANTIATE

}  // namespace derham
