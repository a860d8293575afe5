#include "derham/geometry/volumes.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/geometry/predicates.hpp"
#include "derham/geometry/simplex_metric.hpp"

#include <cmath>

namespace derham {

namespace {

// Calls body(t, metric) for every top simplex in order.
template <int n, class Body>
void for_each_metric(const SimplicialComplex<n>& K, const Geometry<n>& geometry, Body&& body) {
  geometry.require_fits(K);
  const int d = geometry.coordinate_dimension();
  std::vector<double> scratch(static_cast<std::size_t>(n * d));
  for (Index t = 0; t < K.size(n); ++t) {
    const auto corners = geometry.corners(K, t);
    body(t, SimplexMetric<n>(corners, d, geometry.relative_flatness(), geometry.roundoff(corners), scratch.data()));
  }
}

}  // namespace

template <int n>
ByDegree<n> primal_volumes(const SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  ByDegree<n> volume;
  for (int k = 0; k <= n; ++k) volume[static_cast<std::size_t>(k)].resize(static_cast<std::size_t>(K.size(k)));
  for_each_metric(K, geometry, [&](Index t, const SimplexMetric<n>& metric) {
    const auto index = face_indices(K, t);
    for_each_mask<n>([&]<unsigned mask>() {
      volume[mask_degree(mask)][static_cast<std::size_t>(index[mask])] = metric.volume[mask];
    });
  });
  return volume;
}

template <int n>
  requires(n >= 1)
std::vector<double> squared_lengths(const SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  geometry.require_fits(K);
  std::vector<double> squares(static_cast<std::size_t>(K.size(1)));
  for (Index t = 0; t < K.size(n); ++t) {
    const auto index = face_indices(K, t);
    const auto corners = geometry.corners(K, t);
    for_each_mask<n>([&]<unsigned mask>() {
      if constexpr (mask_degree(mask) == 1) {
        constexpr auto ends = mask_vertices<mask>();
        const double *a = corners[static_cast<std::size_t>(ends[0])], *b = corners[static_cast<std::size_t>(ends[1])];
        double sum = 0;
        for (int axis = 0; axis < geometry.coordinate_dimension(); ++axis)
          sum += (b[axis] - a[axis]) * (b[axis] - a[axis]);
        squares[static_cast<std::size_t>(index[mask])] = sum;
      }
    });
  }
  return squares;
}

template <int n>
double total_volume(const SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  double sum = 0;
  for_each_metric(K, geometry, [&](Index, const SimplexMetric<n>& metric) { sum += metric.volume[full_mask<n>]; });
  return sum;
}

template <int n>
std::vector<double> signed_volumes(const SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  if (!geometry.has_signed_volume())
    throw GeometryError(text("simplices of dimension ", n, " have no signed volume in dimension ",
                             geometry.ambient_dimension(), "; that needs positions in dimension ", n));
  std::vector<double> volume(static_cast<std::size_t>(K.size(n)));
  for_each_metric(K, geometry, [&](Index t, const SimplexMetric<n>& metric) {
    volume[static_cast<std::size_t>(t)] = orientation_sign<n>(geometry.corners(K, t)) * metric.volume[full_mask<n>];
  });
  return volume;
}

template <int n>
void orient_by_volume(SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  if (geometry.has_signed_volume()) K.orient_by(signed_volumes(K, geometry));
}

#define DERHAM_INSTANTIATE(n)                                                                      \
  template ByDegree<n> primal_volumes<n>(const SimplicialComplex<n>&, const Geometry<n>&);         \
  template double total_volume<n>(const SimplicialComplex<n>&, const Geometry<n>&);                \
  template std::vector<double> signed_volumes<n>(const SimplicialComplex<n>&, const Geometry<n>&); \
  template void orient_by_volume<n>(SimplicialComplex<n>&, const Geometry<n>&);
DERHAM_INSTANTIATE(0)
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
#undef DERHAM_INSTANTIATE
template std::vector<double> squared_lengths<1>(const SimplicialComplex<1>&, const Geometry<1>&);
template std::vector<double> squared_lengths<2>(const SimplicialComplex<2>&, const Geometry<2>&);
template std::vector<double> squared_lengths<3>(const SimplicialComplex<3>&, const Geometry<3>&);
template std::vector<double> squared_lengths<4>(const SimplicialComplex<4>&, const Geometry<4>&);

}  // namespace derham
