#include "derham/geometry/quality.hpp"

#include "derham/geometry/top_volumes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace derham {

namespace {

template <int n>
QualityReport judged(const SimplicialComplex<n>& K, const Geometry<n>& geometry, TopVolumes&& tops) {
  QualityReport report;
  report.degenerate = std::move(tops.degenerate);
  const bool signs = geometry.has_signed_volume() && K.is_orientable();
  auto degenerate = report.degenerate.begin();
  Index t = 0;
  for (const double signed_volume : tops.volume) {
    const double volume = std::abs(signed_volume);
    report.smallest_volume = t == 0 ? volume : std::min(report.smallest_volume, volume);
    report.largest_volume = std::max(report.largest_volume, volume);
    report.total_volume += volume;
    if (degenerate != report.degenerate.end() && *degenerate == t) {
      ++degenerate;
    } else if (signs && std::signbit(signed_volume) != (K.sign(n, t) < 0)) {
      report.inverted.push_back(t);
    }
    ++t;
  }
  return report;
}

}  // namespace

template <int n>
QualityReport quality(const SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  return judged(K, geometry, top_volumes(K, geometry));
}

template <int n>
QualityReport oriented_quality(SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  auto tops = top_volumes(K, geometry);
  if (geometry.has_signed_volume()) K.orient_by(tops.volume);
  return judged(K, geometry, std::move(tops));
}

#define DERHAM_INSTANTIATE(n)                                                         \
  template QualityReport quality<n>(const SimplicialComplex<n>&, const Geometry<n>&); \
  template QualityReport oriented_quality<n>(SimplicialComplex<n>&, const Geometry<n>&);
DERHAM_INSTANTIATE(0)
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
#undef DERHAM_INSTANTIATE

}  // namespace derham
