#include "derham/operators/boundary_metric.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/forms/trace.hpp"
#include "derham/geometry/volumes.hpp"

#include <algorithm>
#include <utility>

namespace derham {
namespace {

template <int n>
std::vector<double> boundary_points(const Geometry<n>& geometry, const BoundaryComplex<n>& B) {
  const auto m = geometry.ambient_dimension();
  std::vector<double> points;
  for (const Index v : B.inclusion[0]) {
    const auto x = geometry.points().subspan(static_cast<std::size_t>(v) * static_cast<std::size_t>(m),
                                             static_cast<std::size_t>(m));
    points.insert(points.end(), x.begin(), x.end());
  }
  return points;
}

template <int n>
std::vector<double> boundary_corners(const SimplicialComplex<n>& K, const Geometry<n>& geometry,
                                     const BoundaryComplex<n>& B) {
  std::vector<double> corners;
  for (const Index f : B.inclusion[n - 1])
    for (const double* x : geometry.template corners<n - 1>(K, f))
      corners.insert(corners.end(), x, x + geometry.ambient_dimension());
  return corners;
}

template <int n>
std::vector<double> boundary_squares(const SimplicialComplex<n>& K, const Geometry<n>& geometry,
                                     const BoundaryComplex<n>& B) {
  std::vector<double> squares;
  if constexpr (n >= 2) {
    const auto all = squared_lengths(K, geometry);
    for (const Index e : B.inclusion[1]) squares.push_back(all[static_cast<std::size_t>(e)]);
  }
  return squares;
}

}  // namespace

template <int n>
  requires(n >= 1)
Geometry<n - 1> boundary_geometry(const SimplicialComplex<n>& K, const Geometry<n>& geometry,
                                  const BoundaryComplex<n>& B) {
  geometry.require_fits(K);
  for (int k = 0; k < n; ++k) detail::require_boundary_of(K, B, k);
  const int m = geometry.ambient_dimension();
  switch (geometry.source()) {
    case MetricSource::points:
      return Geometry<n - 1>::from_points(B.complex, boundary_points(geometry, B), m);
    case MetricSource::corners:
      return Geometry<n - 1>::from_corners(B.complex, boundary_corners(K, geometry, B), m);
    default:
      return Geometry<n - 1>::from_squared_lengths(B.complex, boundary_squares(K, geometry, B));
  }
}

template <int n>
  requires(n >= 1)
Material boundary_material(const BoundaryComplex<n>& B, std::initializer_list<FacetValue> parts) {
  const auto& facets = B.inclusion[n - 1];  // increasing
  Material result;
  result.values.assign(1, 0.0);
  result.row_of.assign(facets.size(), 0);
  for (const auto& part : parts) {
    const auto row = static_cast<Index>(result.values.size());
    result.values.push_back(part.value);
    for (const Index f : part.facets) {
      const auto place = std::ranges::lower_bound(facets, f);
      if (place == facets.end() || *place != f) throw InputError(text("facet ", f, " is not on the boundary"), f);
      Index& taken = result.row_of[static_cast<std::size_t>(place - facets.begin())];
      if (taken != 0 && taken != row)
        throw InputError(
            text("facet ", f, " is in part ", taken - 1, " and in part ", row - 1, "; one number is allowed on it"), f);
      taken = row;
    }
  }
  return result;
}

#define DERHAM_INSTANTIATE(n)                                                                 \
  template Geometry<n - 1> boundary_geometry(const SimplicialComplex<n>&, const Geometry<n>&, \
                                             const BoundaryComplex<n>&);                      \
  template Material boundary_material(const BoundaryComplex<n>&, std::initializer_list<FacetValue>);
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
#undef DERHAM_INSTANTIATE

}  // namespace derham
