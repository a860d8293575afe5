#include "derham/geometry/quality.hpp"

#include "derham/geometry/predicates.hpp"
#include "derham/geometry/simplex_metric.hpp"

#include <algorithm>

namespace derham {

template <int n>
QualityReport quality(const SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  geometry.require_fits(K);
  QualityReport report;
  const int d = geometry.coordinate_dimension();
  const bool signs = geometry.has_signed_volume() && K.is_orientable();
  std::vector<double> scratch(static_cast<std::size_t>(n * d));
  for (Index t = 0; t < K.size(n); ++t) {
    const auto corners = geometry.corners(K, t);
    const SimplexMetric<n> metric(corners, d, geometry.relative_flatness(), geometry.roundoff(corners), scratch.data());
    const double volume = metric.volume[full_mask<n>];
    report.smallest_volume = t == 0 ? volume : std::min(report.smallest_volume, volume);
    report.largest_volume = std::max(report.largest_volume, volume);
    report.total_volume += volume;
    if (metric.degenerate) {
      report.degenerate.push_back(t);
    } else if (signs && orientation_sign<n>(corners) * K.sign(n, t) < 0) {
      report.inverted.push_back(t);
    }
  }
  return report;
}

template QualityReport quality<0>(const SimplicialComplex<0>&, const Geometry<0>&);
template QualityReport quality<1>(const SimplicialComplex<1>&, const Geometry<1>&);
template QualityReport quality<2>(const SimplicialComplex<2>&, const Geometry<2>&);
template QualityReport quality<3>(const SimplicialComplex<3>&, const Geometry<3>&);
template QualityReport quality<4>(const SimplicialComplex<4>&, const Geometry<4>&);

}  // namespace derham
