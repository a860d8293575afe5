#include "derham/dual/dual_report.hpp"

#include "derham/complex/incidence.hpp"

#include <cmath>
#include <limits>

namespace derham {

template <int n>
DualReport dual_report(const SimplicialComplex<n>& K, const CircumcentricDual<n>& dual) {
  DualReport report;
  report.well_centered = dual.well_centered;
  report.degenerate = dual.degenerate;
  for (int k = 0; k <= n; ++k) {
    StarVerdict verdict;
    verdict.min = std::numeric_limits<double>::quiet_NaN();
    for (Index i = 0; i < K.size(k); ++i) {
      const double volume = dual.dual[k][i];
      const double star = star_entry(volume, dual.primal[k][i]);
      if (std::isnan(star)) {
        ++verdict.undefined;
        continue;
      }
      verdict.min = std::fmin(verdict.min, star);
      if (volume == 0) verdict.zero.push_back(i);
      if (volume < 0) verdict.negative.push_back(i);
    }
    report.star.push_back(std::move(verdict));
  }
  if constexpr (n > 0) {
    const auto cofaces = facet_cofaces(K);
    for (Index f = 0; f < K.size(n - 1); ++f) {
      bool& verdict = cofaces.count[f] == 1 ? report.one_sided : report.pairwise_delaunay;
      verdict = verdict && dual.dual[n - 1][f] >= 0;
    }
  }
  return report;
}

template DualReport dual_report<0>(const SimplicialComplex<0>&, const CircumcentricDual<0>&);
template DualReport dual_report<1>(const SimplicialComplex<1>&, const CircumcentricDual<1>&);
template DualReport dual_report<2>(const SimplicialComplex<2>&, const CircumcentricDual<2>&);
template DualReport dual_report<3>(const SimplicialComplex<3>&, const CircumcentricDual<3>&);
template DualReport dual_report<4>(const SimplicialComplex<4>&, const CircumcentricDual<4>&);

}  // namespace derham
